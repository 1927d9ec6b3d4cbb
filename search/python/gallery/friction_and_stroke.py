"""
Friction against stroke
=======================

Each point is a sheet of 4 × 4 panels that deploys from 150°: its critical friction against the largest stroke of its
springs. Strong sheets need large strokes, but of two sheets with the same stroke one may overcome ten times the
friction of the other.
"""

import subprocess
import tempfile

import matplotlib.pyplot as plt
import misalign

plt.style.use(misalign.style)
with tempfile.TemporaryDirectory() as folder:
    file = f"{folder}/small.db"
    subprocess.run(["misalign", "search", "search/campaigns/miura-4x4.json", "--draws", "2000", "--catalogue", file,
                    "--progress", "none", "--log-level", "error"], check=True, stdout=subprocess.DEVNULL)
    with misalign.Catalogue(file) as catalogue:
        found = catalogue.query("SELECT stroke_max, deploys_from_deg, critical_friction_n_mm_per_mm(draw) AS friction "
                                "FROM candidates LIMIT 500")

figure, axes = plt.subplots()
points = axes.scatter(100 * found.stroke_max, found.friction.astype(float), c=found.deploys_from_deg, s=10)
axes.set(yscale="log", xlabel="largest stroke up to D (%)", ylabel="critical friction from 36° (N mm/mm)")
figure.colorbar(points, label="D (°)")
plt.show()
