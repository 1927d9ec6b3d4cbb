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
        axes = catalogue.plot(y="critical_friction_n_mm_per_mm", limit=500)
axes.set(yscale="log", xlabel="largest stroke up to D (share)", ylabel="critical friction from 36° (N mm/mm)")
plt.show()
