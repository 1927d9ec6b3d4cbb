"""
Correlations of metrics
=======================

Spearman's rank correlations of the metrics of some eight hundred candidates of 4 × 4 panels. Miscut margin, least slope
and least stroke are correlated, as are the largest stroke, the extreme elongations and the spring energy. D correlates
little with either.
"""

import subprocess
import tempfile

import matplotlib.pyplot as plt
import misalign
import numpy as np

plt.style.use(misalign.style)
with tempfile.TemporaryDirectory() as folder:
    file = f"{folder}/small.db"
    subprocess.run(["misalign", "search", "search/campaigns/miura-4x4.json", "--draws", "2000", "--catalogue", file,
                    "--progress", "none", "--log-level", "error"], check=True, stdout=subprocess.DEVNULL)
    with misalign.Catalogue(file) as catalogue:
        candidates = catalogue.candidates()

METRICS = ["deploys_from_deg", "fold_limit_deg", "miscut_margin_mm", "slope_min_mm_per_deg",
           "slope_between_min_mm_per_deg", "stroke_min", "stroke_max", "elongation_min", "elongation_max",
           "stretch_sq_mm2", "kawasaki_defect_deg", "singular_value_min"]
correlation = candidates[METRICS].astype(float).corr(method="spearman")

figure, axes = plt.subplots(figsize=(6.3, 5.2))
axes.imshow(correlation, vmin=-1, vmax=1, cmap="RdBu")
axes.set_xticks(range(len(METRICS)), METRICS, rotation=40, ha="right", rotation_mode="anchor")
axes.set_yticks(range(len(METRICS)), METRICS)
for (row, column), value in np.ndenumerate(correlation.to_numpy()):
    axes.text(column, row, f"{value:.2f}", ha="center", va="center", fontsize=6,
              color="white" if abs(value) > 0.6 else "black")
plt.show()
