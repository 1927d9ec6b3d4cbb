"""
Diagonals of a FOLD mesh
========================

Turned quadrilaterals, a mesh from a FOLD file that is not flat-foldable. Without shifts its diagonals hardly change.
The figure shows the elongations of the sheet with the largest D among two thousand random draws.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
campaign = misalign.read("search/campaigns/turned-quads-6x6.json")
shifts_mm = campaign.shifts(range(2000))
verdicts = misalign.judge(campaign, shifts_mm)
best = verdicts.deploys_from_deg.argmax()
sheet = campaign.pattern.with_shifts(shifts_mm[best])

figure, (left, right) = plt.subplots(1, 2, figsize=(6.3, 3))
sheet.plot(axes=left)
left.get_legend().remove()
sheet.fold().plot(right)
right.set_title(f"draw {best}")
plt.show()
