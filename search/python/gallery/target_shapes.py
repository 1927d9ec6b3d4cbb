"""
Six target shapes
=================

Sheets of 6 × 6 panels that `misalign shape` makes, at the pilot angle of their shape, with the target as a faint surface
between their two levels. Colours are distances of vertices from their places, in thousandths of a millimetre.
"""

import json
import subprocess
import tempfile

import matplotlib.pyplot as plt
import misalign
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

plt.style.use(misalign.style)
R, WAVE = 960, 480 / (2 * np.pi)
FILE = "search/patterns/dome-6x6.json"
at = np.arange(-320, 321, 40.0)
heights = {
    "dome": lambda x, y: np.sqrt(R**2 - x**2 - y**2) - R,
    "arch": lambda x, y: np.sqrt(R**2 - y**2) - R,
    "saddle": lambda x, y: (x**2 - y**2) / (2 * R),
    "twist": lambda x, y: x * np.tan(y / R),
    "wave": lambda x, y: WAVE**2 / R * np.cos(x / WAVE) * np.cos(y / WAVE),
    "blade": lambda x, y: x * np.tan(y / 1200) - x**2 / 1920,
}


def shaped(height):
    """The sheet whose target is a grid of these heights, and the JSON of `misalign shape`."""
    grid = {"surface": "grid", "spacing_mm": 40, "heights_mm": height(*np.meshgrid(at, at)).tolist()}
    said = json.loads(subprocess.run(["misalign", "shape", FILE, "--target", json.dumps(grid), "--from", "93", "--json"],
                                     check=True, capture_output=True).stdout)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(said["pattern"], file)
        file.flush()
        return misalign.read(file.name), said


def distances_mm(points_mm, height):
    """Distances of points above the surface, along its normals."""
    foot = points_mm[:, :2].copy()
    for _ in range(30):  # to the nearest point of the tangent plane, and again
        z, step = height(*foot.T), 1e-3
        slope = np.array([height(foot[:, 0] + dx, foot[:, 1] + dy) - z for dx, dy in ((step, 0), (0, step))]).T / step
        along = (((points_mm[:, :2] - foot) * slope).sum(axis=1) - (points_mm[:, 2] - z)) / (1 + (slope**2).sum(axis=1))
        foot = points_mm[:, :2] - along[:, np.newaxis] * slope
    return -along * np.sqrt(1 + (slope**2).sum(axis=1))


# Heights of the folded base's vertices in half depths: a rim that cuts panels has some beyond the two levels.
sides = np.tile([1.0, -1] * 3 + [1], (7, 1))
sides[1::2, 0] = sides[0::2, -1] = 2
x, y = np.meshgrid(np.linspace(-230, 230, 24), np.linspace(-230, 230, 24))

figure, grid = plt.subplots(2, 3, figsize=(6.3, 3.8), subplot_kw={"projection": "3d"})
colours = plt.cm.ScalarMappable(plt.Normalize(0, 30))
for axes, (name, height) in zip(grid.flat, heights.items()):
    sheet, said = shaped(height)
    points_mm = sheet.fold([90]).vertices_mm[0] @ np.transpose(said["pose"]["turn"]) + said["pose"]["move_mm"]
    away_mm = abs(distances_mm(points_mm, height) - sides.ravel() * said["half_depth_mm"])
    axes.plot_surface(x, y, height(x, y), color="#88aadd", alpha=0.25, linewidth=0)
    axes.add_collection3d(Poly3DCollection(points_mm[sheet.panels], edgecolor="#444444", linewidth=0.5, alpha=0.9,
                                           facecolor=colours.to_rgba(1000 * away_mm[sheet.panels].mean(axis=1))))
    axes.set(xlim=(-240, 240), ylim=(-240, 240), zlim=(-120, 120))
    axes.set_box_aspect((2, 2, 1), zoom=1.15)
    axes.view_init(elev=20, azim=-60)
    axes.axis("off")
    axes.set_title(f"{name}: up to {1000 * away_mm.max():.0f} µm", y=0.95)
figure.colorbar(colours, ax=grid, shrink=0.6, label="distance of a panel's vertices (µm)")
plt.show()
