#!/usr/bin/env python3
"""Draws the motions of `rubber release`: release.py MOTIONS.csv FIGURE.svg. Needs matplotlib."""
import csv
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

motions = {}
with open(sys.argv[1]) as file:
    for row in csv.DictReader(file):
        motions.setdefault(row["filling"], []).append((float(row["time_s"]), float(row["pilot_deg"])))
figure, axes = plt.subplots(figsize=(7, 4))
for name, rows in motions.items():
    times_s, angles_deg = zip(*rows)
    axes.plot([1000 * t for t in times_s], angles_deg, "--" if name.startswith("springs") else "-",
              label=f"{name}: {1000 * times_s[-1]:.3g} ms")
axes.set_xscale("log")
axes.set_xlabel("time (ms)")
axes.set_ylabel("pilot angle (°)")
axes.legend(fontsize=8)
axes.grid(alpha=0.3)
figure.tight_layout()
plt.rcParams["svg.hashsalt"] = "rubber"
figure.savefig(sys.argv[2], metadata={"Date": None})
