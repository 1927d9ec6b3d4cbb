#!/usr/bin/env python3
"""Exports every end of an optimising campaign and asks other verbs of the files: files.py PROGRAM FILE.db DIRECTORY

`fold`: D, and the largest stroke up to the campaign's angle; `deploy`: the critical friction; `contact`: where panels meet.
What breaks a limit of the campaign, or is worth something else than the catalogue says, is named.
"""
import json
import pathlib
import sqlite3
import subprocess
import sys

program, path, directory = sys.argv[1:]
database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
configuration = json.loads(database.execute("SELECT configuration FROM campaign").fetchone()[0])
search, asked_deg = configuration["search"], configuration["accept"]["deploys_from_deg"]
limits = dict(limit.split(" <= ") for limit in search["subject_to"] if "<=" in limit)
floors = dict(limit.split(" >= ") for limit in search["subject_to"] if ">=" in limit)


def said(verb, file, *options):
    return json.loads(subprocess.run([program, verb, file, *options, "--json"], check=True, capture_output=True, text=True).stdout)


files, wrong, meeting = 0, [], []
rows = database.execute("SELECT draw, end_value, miscut_margin_mm FROM ascent JOIN candidate USING (draw) WHERE steps > 0")
for draw, end_value, margin_mm in rows:
    exported = subprocess.run([program, "export", path, "--draw", str(draw), "--output", directory], check=True,
                              capture_output=True, text=True)
    file = str(pathlib.Path(exported.stdout.split()[0]))
    folded, contact = said("fold", file), said("contact", file)
    within = [k for k, deg in enumerate(folded["samples_deg"]) if deg <= asked_deg]
    stroke = max(abs(diagonal["length_mm"][k] / diagonal["flat_mm"] - 1) for diagonal in folded["diagonals"] for k in within)
    files += 1
    if folded["verdict"]["deploys_from_deg"] < asked_deg:
        wrong.append((draw, "D", folded["verdict"]["deploys_from_deg"]))
    if stroke > float(limits.get("stroke_max", 1e9)):
        wrong.append((draw, "stroke", stroke))
    if margin_mm < float(floors.get("miscut_margin_mm", 0)):
        wrong.append((draw, "margin", margin_mm))
    if search["from_deg"] is not None and search["maximise"].startswith("critical"):
        friction = said("deploy", file, "--from", str(search["from_deg"]), "--stiffness", str(search["stiffness_n_per_mm"]),
                        "--preload", str(search["preload_n"]))["critical_friction_n_mm_per_mm"]
        if abs(friction / end_value - 1) > 1e-6:
            wrong.append((draw, "friction", friction, end_value))
    if contact["first_contact"] and contact["first_contact"]["pilot_deg"] < asked_deg - 1e-6:
        meeting.append((draw, contact["first_contact"]["pilot_deg"]))
print(f"{path}: {files} files; break a limit or are worth something else: {wrong or 'none'}")
print(f"  panels meet below {asked_deg:g} deg in {len(meeting)}: {meeting[:5]}")
