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
folding = campaign.pattern.fold(shifts_mm=shifts_mm[best])

figure, (left, right) = plt.subplots(1, 2, figsize=(6.3, 3))
pattern = campaign.pattern
for number, facet in enumerate(pattern.facets):
    left.fill(*pattern.vertices_mm[facet].T, facecolor="#dddddd" if number in pattern.holes else "white",
              edgecolor="black", linewidth=0.6)
for number, diagonal in enumerate(pattern.diagonals):
    left.plot(*pattern.vertices_mm[diagonal].T, color=f"C{number % 7}", linewidth=1)
left.set_aspect("equal")
left.axis("off")
elongation = 100 * (folding.length_mm / folding.flat_mm - 1)
for number, label in enumerate(pattern.diagonal_labels):
    right.plot(folding.pilot_deg, elongation[:, number], color=f"C{number % 7}", linewidth=1)
right.axvline(folding.deploys_from_deg, color="black", linestyle=":",
              label=f"draw {best} deploys from {folding.deploys_from_deg:g}°")
right.set(xlabel="pilot angle (°)", ylabel="elongation (%)")
right.legend()
plt.show()
