#!/usr/bin/env python3
"""Compares what both criteria accept, and how strong the strongest accepted sheets are:
compare.py MISALIGN FOLDER [DRAWS [PANELS...]]

Searches the same draws by diagonals and by energy, on 4 x 4 to 10 x 10 panels (fewer draws of the last two), with shifts of
0.4 and 4 mm, from 140, 170 and 179 degrees, and prints a table of the strongest sheet with at most 15 % elongation. Critical
friction: rigid panels, springs of 50 N/mm. Static friction: from the threshold down to 1 degree, bending panels of 4 mm of
aluminium. Yield: share of 200 copies cut within 0.05 mm that the criterion accepts."""

import json
import sqlite3
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
draws = int(sys.argv[3]) if len(sys.argv) > 3 else 20000
SHARE = {4: 1, 6: 1, 8: 0.5, 10: 0.2}
STROKE = 0.15
STUDIED = (4, 6)  # panels of sheets whose static friction and yield are found: of larger ones it takes hours


def run(*words):
    done = subprocess.run([program, *map(str, words), "--log-level", "off"], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def campaign(size, amplitude_mm, from_deg, by):
    accept = {"deploys_from_deg": from_deg} | ({"by": "energy"} if by == "energy" else {})
    pattern = {"family": "miura", "rows": size, "columns": size, "panel_width_mm": 80, "panel_height_mm": 80,
               "zigzag_offset_mm": 40, "holes": "checkerboard-odd"}
    return {"name": f"{by}-{size}-{amplitude_mm:g}-{from_deg}", "pattern": pattern,
            "misalignment": {"vertices": "interior", "amplitude_mm": amplitude_mm, "levels": "ternary"},
            "path": {"sample_deg": 1, "end_deg": 180}, "accept": accept, "seed": 1, "stop": {"draws": int(draws * SHARE[size])}}


def strongest(catalogue, size, from_deg):
    database = sqlite3.connect(f"file:{catalogue}?mode=ro", uri=True)
    best = database.execute("SELECT draw, energy_friction_n_mm_per_mm, stroke_max FROM candidates WHERE stroke_max <= ? "
                            "ORDER BY 2 DESC LIMIT 1", (STROKE,)).fetchone()
    if not best or size not in STUDIED:
        return {"friction": best[1]} if best else None
    bent = run("deploy", catalogue, best[0], "--from", from_deg, "--panels", "bend", "--thickness", 4, "--json")
    cut = run("tolerance", catalogue, best[0], "--amplitude", 0.05, "--trials", 200, "--json")
    bent, cut = json.loads(bent) if bent else {}, json.loads(cut) if cut else {}
    static = bent.get("bent", {}).get("static_friction_n_mm_per_mm")
    share = cut.get("from_threshold", {}).get("share")
    return {"friction": best[1], "static": static, "yield": share}


def shown(value, form="{:.3g}"):
    return "–" if value is None else form.format(value)


print("| panels | shifts, mm | from | accepted: diagonals | energy | critical friction, N mm/mm: diagonals | energy "
      "| static friction: diagonals | energy | yield: diagonals | energy |")
print("|" + "---|" * 11)
folder.mkdir(parents=True, exist_ok=True)
for size in [int(word) for word in sys.argv[4:]] or SHARE:
    for amplitude_mm in (0.4, 4.0):
        for from_deg in (140, 170, 179):
            found = {}
            for by in ("diagonals", "energy"):
                text = campaign(size, amplitude_mm, from_deg, by)
                path, catalogue = folder / f"{text['name']}.json", folder / f"{text['name']}.db"
                path.write_text(json.dumps(text))
                run("search", path, "--catalogue", catalogue)
                counts = json.loads(run("status", catalogue, "--json"))
                found[by] = (counts["accepted"] / counts["draws"], strongest(catalogue, size, from_deg) or {})
            cells = [f"{size} × {size}", f"{amplitude_mm:g}", f"{from_deg}°"]
            cells += [f"{100 * found[by][0]:.3g} %" for by in found]
            for key in ("friction", "static", "yield"):
                cells += [shown(found[by][1].get(key)) for by in found]
            print("| " + " | ".join(cells) + " |", flush=True)
