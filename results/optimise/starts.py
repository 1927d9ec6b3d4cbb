#!/usr/bin/env python3
"""Optimises candidates of a campaign, one after another, and says what became of them.

usage: starts.py PROGRAM CATALOGUE STARTS [OPTION of `misalign optimise`...]

The first STARTS candidates by their numbers that the options allow to start from. A table of quantiles: what they were
worth, what their ends are worth, seconds of one core each, ends that are proven up to the angle asked for; the ends as
JSON lines on standard error.
"""
import json
import resource
import sqlite3
import statistics
import subprocess
import sys


def worth(end: dict, when: str) -> float:
    return next(number for key, number in end.items() if key.startswith(f"{when}_"))


def main() -> None:
    program, catalogue, starts, *options = sys.argv[1:]
    draws = [row[0] for row in sqlite3.connect(f"file:{catalogue}?mode=ro", uri=True).execute(
        "SELECT draw FROM candidates ORDER BY draw")]
    ends, seconds, refused = [], [], 0
    for draw in draws:
        if len(ends) == int(starts):
            break
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = subprocess.run([program, "optimise", catalogue, str(draw), "--json", *options], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if run.returncode == 2:  # it does not keep a limit
            refused += 1
            continue
        run.check_returncode()
        end = json.loads(run.stdout)
        ends.append(end)
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        print(json.dumps({"draw": draw, **{key: value for key, value in end.items() if key != "limits"}}), file=sys.stderr)
    print("| | least | quarter | median | three quarters | most |\n|---|---|---|---|---|---|")
    for name, values in {"before": [worth(end, "before") for end in ends],
                         "after": [worth(end, "after") for end in ends],
                         "stroke": [end["stroke"] for end in ends],
                         "seconds": seconds}.items():
        quarters = statistics.quantiles(values, n=4, method="inclusive")
        print(f"| {name} | " + " | ".join(f"{value:.3g}" for value in [min(values), *quarters, max(values)]) + " |")
    proven = sum(end["certified_deg"] >= end["asked_deg"] for end in ends)
    print(f"\n{len(ends)} starts ({refused} refused, which do not keep a limit); {proven} ends proven up to the angle asked for")


main()
