"""
Acceptance against D
====================

Five thousand random sheets, each judged on its full path, on 4 × 4 and on 6 × 6 panels. The more holes, the more
diagonals must be monotone. Bands are Wilson's 95 % intervals.
"""

import matplotlib.pyplot as plt
import misalign
import numpy as np

plt.style.use(misalign.style)
DRAWS, Z = 5000, 1.96
angles_deg = np.arange(0, 181)
figure, axes = plt.subplots()
for name, color in (("miura-4x4", "C0"), ("miura-6x6", "C1")):
    campaign = misalign.read(f"search/campaigns/{name}.json")
    reached_deg = misalign.judge(campaign, campaign.shifts(range(DRAWS))).deploys_from_deg
    hits = (reached_deg >= angles_deg[:, np.newaxis]).sum(axis=1)
    middle, width = hits + Z * Z / 2, Z * np.sqrt(hits * (DRAWS - hits) / DRAWS + Z * Z / 4)
    axes.fill_between(angles_deg, (middle - width) / (DRAWS + Z * Z), (middle + width) / (DRAWS + Z * Z), color=color,
                      alpha=0.2, linewidth=0)
    axes.plot(angles_deg[hits > 0], hits[hits > 0] / DRAWS, color=color, label=name)
axes.set(yscale="log", ylim=(1e-4, 1.3), xlim=(0, 180), xlabel="least D (°)", ylabel="share of draws")
axes.grid()
axes.legend()
plt.show()
