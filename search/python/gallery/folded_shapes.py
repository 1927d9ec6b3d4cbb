"""
The sheet at six angles
=======================

Every folding has the vertices of the folded sheet (`vertices_mm`), so that any plotting library can draw it; a pattern
draws itself at an angle.
"""

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
table1 = misalign.read("search/patterns/table1.json")
figure, grid = plt.subplots(2, 3, figsize=(6.3, 4), subplot_kw={"projection": "3d"})
for axes, angle_deg in zip(grid.flat, (10, 40, 70, 100, 130, 156)):
    table1.plot(angle_deg, axes)
    axes.set_title(f"{angle_deg}°")
plt.show()
