"""
Lengths of all diagonals
========================

The paper's figure 13: the length of each diagonal of Table 1, relative to flat, with a plot for each hole. Each is
monotone. Curves end at the fold limit, 156.35°.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
table1 = misalign.read("search/patterns/table1.json")
folding = table1.fold()
relative = folding.length_mm / folding.flat_mm

figure, grid = plt.subplots(2, 4, figsize=(6.3, 3.8), sharex=True, sharey=True)
for hole, axes in enumerate(grid.flat):
    for number in (2 * hole, 2 * hole + 1):
        axes.plot(folding.pilot_deg, relative[:, number], color="C0" if relative[-1, number] > 1 else "C1",
                  label=table1.diagonal_labels[number])
    axes.axhline(1, color="#bbbbbb", linewidth=0.5, zorder=0)
    axes.legend(fontsize=6, loc="lower left")
    row, column = table1.places[table1.holes[hole]]
    axes.set_title(f"hole [{row}, {column}]")
figure.supxlabel("pilot angle (°)")
figure.supylabel("length relative to flat")
plt.show()
