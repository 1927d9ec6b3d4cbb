"""
The sheet of Table 1
====================

The paper's figure 12: the flat sheet with its holes, and two diagonals in each. Blue ones lengthen while the sheet
folds, red ones shorten. Arrows are the shifts of the vertices, magnified fifty times.
"""

import matplotlib.pyplot as plt
import misalign
import numpy as np

table1 = misalign.read("search/patterns/table1.json")
folding = table1.fold()
grows = folding.length_mm[-1] > folding.flat_mm
flat_mm = table1.vertices_mm + table1.shifts_mm

figure, axes = plt.subplots(figsize=(7, 6), layout="constrained")
for number, facet in enumerate(table1.facets):
    hole = number in table1.holes
    axes.fill(*flat_mm[facet].T, facecolor="#dddddd" if hole else "white", edgecolor="#999999", linewidth=0.5)
for crease, valley in zip(table1.creases, table1.valley):
    axes.plot(*flat_mm[crease].T, color="black", linewidth=0.8, dashes=(4, 2) if valley else (6, 2, 1, 2))
for diagonal, blue in zip(table1.diagonals, grows):
    axes.plot(*flat_mm[diagonal].T, color="C0" if blue else "C3")
shifted = np.flatnonzero(np.abs(table1.shifts_mm).max(axis=1) > 0)
axes.quiver(*flat_mm[shifted].T, *(50 * table1.shifts_mm[shifted]).T, angles="xy", scale_units="xy", scale=1,
            width=0.004, zorder=3)
axes.plot(*flat_mm[table1.creases[table1.pilot]].T, color="C1", linewidth=5, alpha=0.6)
axes.set_aspect("equal")
axes.axis("off")
axes.set_title("Table 1: mountains dash-dotted, valleys dashed, the pilot crease orange")
plt.show()
