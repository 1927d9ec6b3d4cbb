#!/usr/bin/env python3
"""What splitting gains over plain draws at each level: gain.py CATALOGUE PLAIN_DRAWS_PER_CORE_SECOND
Relative variance of one population's estimate times its work, in draws (first draws, plus moves) and in core
seconds; the same of plain draws, (1 - p) / p draws; their ratio; and the ideal, 1 / (p ln(p)^2)."""

import math
import sqlite3
import sys

database = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True)
plain_s = 1 / float(sys.argv[2])
levels = dict(database.execute("SELECT number, deploys_from_deg FROM level"))
populations = {}
for unit, level, *row in database.execute("SELECT unit, level, particles, survivors, tried, seconds FROM population"):
    populations.setdefault(unit, {})[level] = row

print("| from | share p | populations | variance / p² | draws | moves | core s | variance × draws: plain | splitting | gain "
      "| gain in core s | ideal gain |")
print("|" + "---|" * 12)
for top in sorted(levels):
    shares, draws, moves, seconds = [], 0, 0, 0.0
    for rows in populations.values():
        share = 1.0
        for level in range(top):
            if level not in rows:
                share = 0.0
                break
            particles, survivors, tried, spent = rows[level]
            share *= survivors / particles
            draws += tried if level == 0 else 0
            moves += tried if level > 0 else 0
            seconds += spent
        shares.append(share)
    count = len(shares)
    p = sum(shares) / count
    if p == 0:
        break
    relative = sum((share - p) ** 2 for share in shares) / (count - 1) / p**2
    plain = (1 - p) / p
    work = relative * (draws + moves) / count
    print(f"| {levels[top]:.5g}° | {p:.2e} | {count} | {relative:.2f} | {draws / count:.3g} | {moves / count:.3g} "
          f"| {seconds / count:.3g} | {plain:.2e} | {work:.2e} | {plain / work:.2g} "
          f"| {plain * plain_s / (relative * seconds / count):.2g} | {1 / (p * math.log(p)**2):.2g} |")
