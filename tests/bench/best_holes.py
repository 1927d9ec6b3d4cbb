#!/usr/bin/env python3
"""Which holes are best: sets of inner panels of Miura-ori sheets, each with the sheet that `misalign construct` makes of
it, by stroke and energy: best_holes.py PROGRAM FOLDER writes FOLDER/best-holes.csv and .svg, and prints a table.

Energy is that of springs of 50 N/mm on all diagonals at 36 degrees, where the sheet is scaled so that every diagonal
changes by 5 % or more at 179 degrees: at equal stroke."""

import itertools
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
STROKE, AMPLITUDE_MM, STIFFNESS_N_PER_MM, FROM_DEG = 0.05, 25, 50, 36
MOST_SETS = 300


def run(*words):
    done = subprocess.run([program, *words], capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def looked_at(size, holes, rim):
    """Least stroke at an amplitude of 4 mm; energy and amplitude at equal stroke; None where no sheet changes them all."""
    with tempfile.TemporaryDirectory() as there:
        base, made = os.path.join(there, "base.json"), os.path.join(there, "made.json")
        with open(base, "w") as file:
            json.dump({"family": "miura", "rows": size, "columns": size, "holes": [list(hole) for hole in holes]}, file)
        freed = ["--rim"] if rim else []
        most = run("construct", base, "--amplitude", "4", "--json", *freed)
        if not most:
            return None
        row = {"stroke": most["stroke"], "energy": None, "amplitude_mm": None}
        asked = run("construct", base, "--amplitude", str(AMPLITUDE_MM), "--stroke", str(STROKE), "--json", *freed)
        if asked:
            with open(made, "w") as file:
                json.dump(asked["pattern"], file)
            folding = run("fold", made, "--to", str(FROM_DEG), "--json")
            row["energy"] = sum(STIFFNESS_N_PER_MM / 2 * (d["length_mm"][-1] - d["flat_mm"]) ** 2
                                for d in folding["diagonals"])
            row["amplitude_mm"] = asked["amplitude_mm"]
        return row


def sets_of(size, count):
    """All of them, or the first so many of a fixed shuffle."""
    inner = [(r, c) for r in range(1, size - 1) for c in range(1, size - 1)]
    apart = [s for s in itertools.combinations(inner, count)
             if all(abs(a[0] - b[0]) + abs(a[1] - b[1]) > 1 for a, b in itertools.combinations(s, 2))] \
        if count <= 2 else None
    if apart is None:
        return []
    return sorted(apart, key=lambda s: sum(ord(c) * k for k, c in enumerate(str(s))) % 9973)[:MOST_SETS]


def checkerboard(size, parity):
    return tuple((r, c) for r in range(1, size - 1) for c in range(1, size - 1) if (r + c) % 2 == parity)


def spread(size, count):
    """So many of a checkerboard's holes, each as far from the others as it can be."""
    holes = list(checkerboard(size, 1))
    chosen = [holes[0]]
    while len(chosen) < count:
        chosen.append(max((h for h in holes if h not in chosen),
                          key=lambda h: min((h[0] - o[0]) ** 2 + (h[1] - o[1]) ** 2 for o in chosen)))
    return tuple(sorted(chosen))


rows = []
for size in (4, 6, 8, 10, 12):
    all_holes = len(checkerboard(size, 1))
    jobs = []
    for rim in (True, False):
        for count in (1, 2):
            jobs += [(size, holes, rim) for holes in sets_of(size, count)]
        for count in (4, 8, 18, 32, 50):
            if 2 < count <= all_holes:
                jobs.append((size, spread(size, count), rim))
        jobs += [(size, checkerboard(size, parity), rim) for parity in (0, 1)]
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda job: looked_at(*job), jobs))
    for (_, holes, rim), row in zip(jobs, found):
        rows.append({"size": size, "holes": len(holes), "rim": "free" if rim else "held", "which": holes,
                     **(row or {"stroke": None, "energy": None, "amplitude_mm": None})})

with open(os.path.join(folder, "best-holes.csv"), "w") as file:
    file.write("size,holes,rim,which,stroke_at_4_mm,energy_n_mm_at_equal_stroke,amplitude_mm_at_equal_stroke\n")
    for row in rows:
        which = " ".join(f"{r}-{c}" for r, c in row["which"])
        numbers = ",".join("" if row[key] is None else f"{row[key]:.6g}" for key in ("stroke", "energy", "amplitude_mm"))
        file.write(f"{row['size']},{row['holes']},{row['rim']},{which},{numbers}\n")

print("| size | holes | rim | sets | of these made | best stroke at 4 mm, % | its holes | best energy a hole at 5 % |")
print("|---|---|---|---|---|---|---|---|")
for key in sorted({(row["size"], row["holes"], row["rim"]) for row in rows}):
    some = [row for row in rows if (row["size"], row["holes"], row["rim"]) == key]
    made = [row for row in some if row["stroke"] is not None]
    best = max(made, key=lambda row: row["stroke"], default=None)
    strong = max((row["energy"] / row["holes"] for row in made if row["energy"]), default=None)
    which = " ".join(f"{r}-{c}" for r, c in best["which"][:2]) + (" …" if best and len(best["which"]) > 2 else "") if best else "–"
    print(f"| {key[0]} × {key[0]} | {key[1]} | {key[2]} | {len(some)} | {len(made)} | "
          + (f"{100 * best['stroke']:.2f} | {which} | " if best else "– | – | ") + (f"{strong:.1f} |" if strong else "– |"))

figure, axes = plt.subplots(figsize=(7, 4))
for size in (4, 6, 8, 10, 12):
    points = {}
    for row in rows:
        if row["size"] == size and row["rim"] == "free" and row["stroke"] is not None:
            points[row["holes"]] = max(points.get(row["holes"], 0), 100 * row["stroke"])
    axes.plot(sorted(points), [points[k] for k in sorted(points)], "o-", label=f"{size} × {size}")
axes.set_xscale("log", base=2)
axes.set_xlabel("holes")
axes.set_ylabel("least stroke of a diagonal at 179°, %")
axes.set_title("Best constructed sheet, vertices shifted by 4 mm at most, rim free")
axes.legend()
figure.tight_layout()
matplotlib.rcParams["svg.hashsalt"] = "misalign"
figure.savefig(os.path.join(folder, "best-holes.svg"), metadata={"Date": None})
