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
figure = plt.figure(figsize=(6.3, 4))
for place, angle_deg in enumerate((10, 40, 70, 100, 130, 156)):
    axes = figure.add_subplot(2, 3, place + 1, projection="3d")
    table1.plot(angle_deg, axes)
    axes.set_title(f"{angle_deg}°")
plt.show()
