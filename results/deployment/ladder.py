#!/usr/bin/env python3
"""What amplitude do I need? ladder.py PROGRAM CAMPAIGN.json DIRECTORY [SECONDS]

For each amplitude and each angle of use draws sheets of the campaign for some seconds on all cores (5), and says: how many
are accepted; of those the mean largest stroke, the mean and the best critical friction and static friction of panels that
bend, and the mean thickness, by the campaign's design; and of the five whose miscut margin is largest the mean yield and
the play that joints may have. Leaves DIRECTORY/ladder.csv and ladder.svg. Needs matplotlib for the figure.
"""
import csv
import json
import subprocess
import sys
from pathlib import Path

AMPLITUDES_MM = (0.2, 0.4, 0.8, 1.6, 3.2, 5.6, 8)
ANGLES_DEG = (60, 90, 140, 170)
SOME = 40  # candidates of which studies are asked
MISCUT_MM = 0.1
COLUMNS = ("amplitude_mm", "from_deg", "draws", "accepted", "stroke", "critical_mean", "critical_best", "static_mean",
           "static_best", "thickness_mm", "yield", "play_mm")


def said(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


def cell(program, campaign, directory, amplitude, angle, seconds):
    """One row of the table."""
    document = json.loads(json.dumps(campaign))
    document["name"] = f"ladder-{amplitude:g}-{angle}"
    document.setdefault("misalignment", {})["amplitude_mm"] = amplitude
    document.setdefault("accept", {})["deploys_from_deg"] = angle
    document.setdefault("design", {})["from_deg"] = angle
    file, catalogue = directory / f"{document['name']}.json", directory / f"{document['name']}.db"
    file.write_text(json.dumps(document))
    catalogue.unlink(missing_ok=True)
    said(program, "search", file, "--draws", 10 ** 9, "--max-time", seconds, "--ranks", "all", "--catalogue", catalogue,
         "--progress", "none")
    status = json.loads(said(program, "status", catalogue, "--json"))
    row = dict.fromkeys(COLUMNS) | {"amplitude_mm": amplitude, "from_deg": angle, "draws": status["draws"],
                                    "accepted": status["accepted"]}
    if not row["accepted"]:
        return row
    some = f"(SELECT * FROM candidates ORDER BY draw LIMIT {SOME})"
    names = ("stroke", "critical_mean", "critical_best", "static_mean", "static_best", "thickness_mm")
    numbers = said(program, "query", catalogue, "--csv", "SELECT avg(stroke_max), avg(c), max(c), avg(s), max(s), avg(t) FROM "
                   "(SELECT stroke_max, bent_critical_friction_n_mm_per_mm(draw) AS c, static_friction_n_mm_per_mm(draw) AS s, "
                   f"thickness_mm(draw) AS t FROM {some})").splitlines()[-1].split(",")
    row.update((name, float(number)) for name, number in zip(names, numbers) if number)
    best = ("--best", 5, "--by", "miscut_margin_mm", "--from", angle, "--json")
    miscut = min(MISCUT_MM, amplitude / 4)
    copies = json.loads(said(program, "tolerance", catalogue, "--amplitude", miscut, "--trials", 200, "--no-keep", *best))
    row["yield"] = sum(one["from_threshold"]["share"] for one in copies) / len(copies)
    loose = json.loads(said(program, "tolerance", catalogue, "--backlash", 1e-3, "--trials", 50, *best))
    row["play_mm"] = sum(one["largest"]["backlash_mm"] if one["largest"] else 0 for one in loose) / len(loose)
    return row


def figure(rows, path):
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot
    matplotlib.rcParams["svg.hashsalt"] = "ladder"
    fig, axes = pyplot.subplots(2, 3, figsize=(11, 6), layout="constrained")
    shown = (("accepted of all draws", lambda r: r["accepted"] / r["draws"], "log"),
             ("largest stroke, mean", lambda r: r["stroke"], "log"),
             ("critical friction, panels bend, mean\nN mm per mm", lambda r: r["critical_mean"], "log"),
             ("thickness, mean, mm", lambda r: r["thickness_mm"], "linear"),
             (f"yield, ±{MISCUT_MM:g} mm or a quarter of the shifts", lambda r: r["yield"], "linear"),
             ("play of joints, mm", lambda r: r["play_mm"], "linear"))
    for axis, (title, of, scale) in zip(axes.flat, shown):
        for angle in ANGLES_DEG:
            points = [(r["amplitude_mm"], of(r)) for r in rows if r["from_deg"] == angle and r["stroke"] is not None]
            points = [(x, y) for x, y in points if y is not None and (y > 0 or scale == "linear")]
            axis.plot(*zip(*points), marker="o", ms=3, label=f"from {angle}°") if points else None
        axis.set(title=title, xscale="log", yscale=scale, xlabel="amplitude, mm")
        axis.set_xticks(AMPLITUDES_MM, [f"{mm:g}" for mm in AMPLITUDES_MM])
        axis.minorticks_off()
        axis.grid(alpha=0.3)
    axes.flat[0].legend()
    fig.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    program, source, directory, *rest = sys.argv[1:]
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    sheet, table = json.loads(Path(source).read_text()), []
    for mm in AMPLITUDES_MM:
        for deg in ANGLES_DEG:
            table.append(cell(program, sheet, folder, mm, deg, float(rest[0]) if rest else 5))
            print({key: value for key, value in table[-1].items() if value is not None}, flush=True)
    with open(folder / "ladder.csv", "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, COLUMNS)
        writer.writeheader()
        writer.writerows(table)
    figure(table, folder / "ladder.svg")
