"""
The diagonals of Table 1
========================

Elongation of every diagonal against the pilot angle.
"""

import matplotlib.pyplot as plt
import misalign

folding = misalign.read("search/patterns/table1.json").fold()
plt.plot(folding.pilot_deg, 100 * (folding.length_mm / folding.flat_mm - 1))
plt.xlabel("pilot angle, degrees")
plt.ylabel("elongation, %")
