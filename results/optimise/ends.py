#!/usr/bin/env python3
"""Where the draws of an optimising campaign ended: ends.py FILE.db...

Quantiles of what starts and ends are worth, how many are certified up to the campaign's angle (after `misalign certify
FILE.db --all`), seconds a start, and how often the best one was met.
"""
import json
import sqlite3
import sys


def quantiles(values):
    values = sorted(values)
    return " ".join(f"{values[min(len(values) - 1, int(q * len(values)))]:9.4g}" for q in (0, 0.25, 0.5, 0.75, 1))


for path in sys.argv[1:]:
    database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    ask = lambda sql: database.execute(sql).fetchone()  # noqa: E731
    configuration = json.loads(ask("SELECT configuration FROM campaign")[0])
    asked_deg = configuration["accept"]["deploys_from_deg"]
    print(f"{path}: {configuration['search']['maximise']}, {configuration['search']['subject_to']}")
    for column in ("start_value", "end_value"):
        values = [row[0] for row in database.execute(f"SELECT {column} FROM ascent WHERE {column} IS NOT NULL")]
        print(f"  {column:12} {len(values):5}  least, quarters, most: {quantiles(values)}")
    kept = ask("SELECT count(*) FROM ascent WHERE start_value IS NULL")[0]
    proven = ask(f"SELECT count(*) FROM certificate JOIN ascent USING (draw) WHERE start_value IS NOT NULL "
                 f"AND certified_deg >= {asked_deg}")[0]
    starts, steps, folded = ask("SELECT count(*), avg(steps), avg(sheets_folded) FROM ascent WHERE start_value IS NOT NULL")
    seconds = ask("SELECT sum(seconds) FROM unit")[0]
    print(f"  {kept} kept as drawn; certified from flat to {asked_deg:g} deg: {proven} of {starts}")
    print(f"  {steps:.0f} steps and {folded:.0f} sheets a start; {seconds / max(starts, 1):.2f} s each, draws among them")
