"""
First faults
============

The first fault of five thousand draws of 6 × 6 panels. Nearly always a diagonal reverses. Sheets with
a large D have other faults: a fold limit, or a crease that is folded past 180°.
"""

import matplotlib.pyplot as plt
import misalign
import numpy as np

plt.style.use(misalign.style)
campaign = misalign.read("search/campaigns/miura-6x6.json")
verdicts = misalign.judge(campaign, campaign.shifts(range(5000)))

figure, axes = plt.subplots()
seen = [fault for fault in range(len(misalign.faults)) if (verdicts.first_fault == fault).any()]
axes.hist([verdicts.deploys_from_deg[verdicts.first_fault == fault] for fault in seen], bins=np.arange(0, 185, 5),
          stacked=True, label=[misalign.faults[fault] for fault in seen])
axes.set(yscale="log", xlabel="D (°)", ylabel="draws (of 5000)", xlim=(0, 180))
axes.legend()
plt.show()
