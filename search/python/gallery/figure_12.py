"""
The sheet of Table 1
====================

The paper's figure 12: the flat sheet with its holes, and two diagonals in each. Blue ones lengthen while the sheet
folds, red ones shorten. Arrows are the shifts of the vertices, magnified fifty times.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
misalign.read("search/patterns/table1.json").plot(magnified=50).figure.set_size_inches(6.3, 5.6)
plt.show()
