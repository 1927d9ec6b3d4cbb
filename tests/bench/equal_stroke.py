#!/usr/bin/env python3
"""Sheets that are made and sheets that are found, at equal stroke: equal_stroke.py PROGRAM FOLDER, with `import misalign`
on PYTHONPATH, writes FOLDER/equal-stroke.csv and .svg, and prints three tables.

Found: candidates of plain campaigns of 6 x 6, ternary 0.4 mm from 170 degrees and uniform 4 mm from 140. Made: members of the
parallel family with the rim held and like signs. Rigid panels, springs of 50 N/mm on all diagonals.

1. Critical friction from 36, 90 and 140 degrees, as if each sheet changed its most used diagonal by STROKE there: energy goes
   with the square of shifts, and so of strokes.
2. What a miscut of 0.05 mm costs, members scaled to the stroke at 36 degrees that found sheets have.
3. Members with a free part besides, uniform, of 1, 3 and 10 % of their largest shift."""

import csv
import json
import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import misalign
import numpy as np

program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
STROKE, FROM_DEG, MISCUT_MM, COPIES, SHEETS = 0.05, (36, 90, 140), 0.05, 1000, 40
PATTERN = {"family": "miura", "rows": 6, "columns": 6}
KINDS = {
    "found, ±0.4 mm": ({"amplitude_mm": 0.4}, 170, 1_500_000),
    "found, ±4 mm": ({"amplitude_mm": 4, "levels": "uniform"}, 140, 60_000),
    "made": ({"amplitude_mm": 4, "kind": "parallel"}, 179, 400),
}


def run(*words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def catalogue_of(name, misalignment, threshold_deg, draws, there):
    path = os.path.join(there, "campaign.json")
    with open(path, "w") as file:
        json.dump({"name": "study", "pattern": PATTERN, "misalignment": misalignment,
                   "path": {"end_deg": 180 if threshold_deg < 179 else 179},
                   "accept": {"deploys_from_deg": threshold_deg}}, file)
    catalogue = os.path.join(there, name.replace(" ", "-") + ".db")
    run("search", path, "--catalogue", catalogue, "--draws", str(draws))
    return misalign.Catalogue(catalogue)


def largest_strokes(catalogue, draws):
    """Of the most used diagonal, by draw and angle."""
    stations_deg, length_mm = catalogue.histories(draws)
    flat_mm = np.array([catalogue.pattern(int(draw)).fold(stations=[1]).flat_mm for draw in draws])
    at = [int(np.flatnonzero(stations_deg == deg)[0]) for deg in FROM_DEG]
    return np.abs(length_mm[:, at] / flat_mm[:, None] - 1).max(axis=2)


def survivors(catalogue, draw, scale, from_deg, rng):
    """The share of miscut copies of the sheet, so many times as large shifts, that deploy from there."""
    shifts_mm = scale * catalogue.shifts([draw])
    copies_mm = shifts_mm + rng.uniform(-MISCUT_MM, MISCUT_MM, (COPIES,) + shifts_mm.shape[1:])
    deploys_deg = misalign.judge(catalogue.campaign, copies_mm).deploys_from_deg
    return [float(np.mean(deploys_deg >= deg)) for deg in from_deg], float(np.median(deploys_deg))


def main():
    rng = np.random.default_rng(1)
    rows, spread = [], {}
    with tempfile.TemporaryDirectory() as there:
        catalogues = {name: catalogue_of(name, *what, there) for name, what in KINDS.items()}
        strokes = {}
        print(f"critical friction at a stroke of {STROKE:.0%}, N mm/mm: median, best of so many sheets")
        for name, catalogue in catalogues.items():
            asked = [f"critical_friction_n_mm_per_mm(draw, {deg})" for deg in FROM_DEG]
            table = catalogue.candidates(limit=200, columns=asked)
            draws = table.draw.to_numpy()
            strokes[name] = dict(zip(draws.tolist(), largest_strokes(catalogue, draws)))
            for k, deg in enumerate(FROM_DEG):
                stroke = np.array([strokes[name][draw][k] for draw in draws.tolist()])
                friction = table[asked[k]].to_numpy() * (STROKE / stroke) ** 2
                friction = friction[np.isfinite(friction)]
                spread[name, deg] = friction
                print(f"  {name:16} from {deg:3}: {np.median(friction):.4f}, {friction.max():.4f} of {len(friction)}; "
                      f"stroke as it is {np.median(stroke):.2%}")
                rows.append(["friction", name, deg, len(friction), np.median(friction), friction.max()])
        wanted = float(np.median([stroke[0] for stroke in strokes["found, ±0.4 mm"].values()]))
        degs = (140, 150, 160, 170)
        print(f"miscut by {MISCUT_MM} mm: median share of copies that deploy from {degs}, median D; stroke at 36 deg {wanted:.2%}")
        for name in ("found, ±0.4 mm", "made"):
            shares, deploys_deg = [], []
            for draw, stroke in list(strokes[name].items())[:SHEETS]:
                scale = wanted / stroke[0] if name == "made" else 1
                share, median_deg = survivors(catalogues[name], draw, scale, degs, rng)
                shares.append(share)
                deploys_deg.append(median_deg)
            print(f"  {name:16} {np.round(np.median(shares, axis=0), 3).tolist()}, {np.median(deploys_deg):g} deg")
            rows.append(["miscut", name, "", len(shares), *np.median(shares, axis=0), np.median(deploys_deg)])
        print("members with a free part: share that deploys from 90, 140, 170, 179; critical friction from 36 by the member's own")
        made = catalogues["made"]
        for part in (0, 0.01, 0.03, 0.1):
            shares, gains = [], []
            for draw, stroke in list(strokes["made"].items())[:SHEETS]:
                member_mm = wanted / stroke[0] * made.shifts([draw])[0]
                free_mm = rng.uniform(-1, 1, (200,) + member_mm.shape) * (member_mm.any(axis=1))[:, None]
                mixed_mm = member_mm + part * np.abs(member_mm).max() * free_mm
                deploys_deg = misalign.judge(made.campaign, mixed_mm).deploys_from_deg
                shares.append([float(np.mean(deploys_deg >= deg)) for deg in (90, 140, 170, 179)])
                pattern = made.pattern(draw)
                own = pattern.with_shifts(member_mm).deploy(from_deg=36, stiffness_n_per_mm=50)
                for k in np.flatnonzero(deploys_deg >= 140)[:5]:
                    mixed = pattern.with_shifts(mixed_mm[k]).deploy(from_deg=36, stiffness_n_per_mm=50)
                    gains.append(mixed["critical_friction_n_mm_per_mm"] / own["critical_friction_n_mm_per_mm"])
            gained = f"{np.median(gains):.2f}, {max(gains):.2f} of {len(gains)}" if gains else "none"
            print(f"  {part:4.0%}: {np.round(np.mean(shares, axis=0), 3).tolist()}; {gained}")
            rows.append(["free part", part, "", len(shares), *np.mean(shares, axis=0), gained])
    with open(os.path.join(folder, "equal-stroke.csv"), "w", newline="") as file:
        csv.writer(file).writerows([["study", "sheets", "from_deg", "count", "numbers"], *rows])
    figure, axes = plt.subplots(1, len(FROM_DEG), figsize=(9, 3.2), sharey=True)
    for axis, deg in zip(axes, FROM_DEG):
        axis.boxplot([spread[name, deg] for name in KINDS], whis=(0, 100), labels=[name.replace(", ", "\n") for name in KINDS])
        axis.set_title(f"from {deg}°")
    axes[0].set_ylim(bottom=0)
    axes[0].set_ylabel("critical friction, N mm/mm,\nat a stroke of 5 %")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "equal-stroke.svg"), metadata={"Date": None})


main()
