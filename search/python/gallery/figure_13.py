"""
Lengths of all diagonals
========================

The paper's figure 13: the length of each diagonal of Table 1, relative to flat, with a plot for each hole. Each is
monotone. Curves end at the fold limit, 156.35°.
"""

import matplotlib.pyplot as plt
import misalign

table1 = misalign.read("search/patterns/table1.json")
folding = table1.fold()
relative = folding.length_mm / folding.flat_mm

figure, grid = plt.subplots(2, 4, figsize=(9, 5), sharex=True, sharey=True, layout="constrained")
for hole, axes in enumerate(grid.flat):
    for number in (2 * hole, 2 * hole + 1):
        axes.plot(folding.pilot_deg, relative[:, number], color="C0" if relative[-1, number] > 1 else "C3",
                  label=table1.diagonal_labels[number])
    axes.axhline(1, color="#bbbbbb", linewidth=0.5, zorder=0)
    axes.legend(fontsize=7, loc="lower left")
    row, column = table1.places[table1.holes[hole]]
    axes.set_title(f"hole [{row}, {column}]", fontsize=9)
figure.supxlabel("pilot angle (°)")
figure.supylabel("length relative to flat")
plt.show()
