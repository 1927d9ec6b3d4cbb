"""
The sheet at six angles
=======================

Every folding has the vertices of the folded sheet, so that any plotting library can draw it.
"""

import matplotlib.pyplot as plt
import misalign
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

table1 = misalign.read("search/patterns/table1.json")
angles_deg = (10, 40, 70, 100, 130, 156)
folding = table1.fold(angles_deg)

figure = plt.figure(figsize=(9, 6), layout="constrained")
for place, (angle_deg, shape_mm) in enumerate(zip(angles_deg, folding.vertices_mm)):
    axes = figure.add_subplot(2, 3, place + 1, projection="3d")
    axes.add_collection3d(Poly3DCollection(shape_mm[table1.panels], facecolor="#f4e3bd", edgecolor="#444444", linewidth=0.5,
                                           alpha=0.95))
    middle_mm = (shape_mm.max(axis=0) + shape_mm.min(axis=0)) / 2
    axes.set(**{f"{axis}lim": (middle_mm[k] - 240, middle_mm[k] + 240) for k, axis in enumerate("xyz")})
    axes.set_box_aspect((1, 1, 1), zoom=1.2)
    axes.view_init(elev=35, azim=-60)
    axes.axis("off")
    axes.set_title(f"{angle_deg}°", y=0.9)
plt.show()
