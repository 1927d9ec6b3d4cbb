#!/usr/bin/python3
"""Compares chosen springs with SciPy's linprog (HiGHS), which shares no code with the programs.

    python3 tests/bench/linprog.py MISALIGN CATALOGUE FIRST COUNT

Draws of a catalogue, from FIRST on; each prints the friction of the choice and SciPy's bound from
the rows of `actuators --choose --json`. A spring with a free length between two limits is two
springs with these, so that all unknowns are rates.
"""
import json
import subprocess
import sys

import numpy as np
from scipy.optimize import linprog

FREE_WITHIN = 0.05


def best_friction(choice, flat_mm):
    """The largest least friction over the rows (N mm per mm), by SciPy."""
    rows, most = choice["rows"], choice["limits"]["most_rate_n_per_mm"]
    springs = len(flat_mm)
    gains = np.array([[(row["length_mm"][d] - flat_mm[d] * (1 + side * FREE_WITHIN))
                       * row["slope_mm"][d] / row["turning_mm"]
                       for side in (-1, 1) for d in range(springs)] for row in rows])
    unit = np.abs(gains).max()
    at_least = np.hstack([-gains / unit, np.ones((len(rows), 1))])
    together = np.hstack([np.eye(springs), np.eye(springs), np.zeros((springs, 1))])
    found = linprog(np.r_[np.zeros(2 * springs), -1],
                    A_ub=np.vstack([at_least, together]),
                    b_ub=np.r_[np.zeros(len(rows)), np.full(springs, most)],
                    bounds=[(0, most)] * (2 * springs) + [(None, None)], method="highs",
                    options={"primal_feasibility_tolerance": 1e-10,
                             "dual_feasibility_tolerance": 1e-10})
    return -found.fun * unit


def study(misalign, *arguments):
    ran = subprocess.run([misalign, "actuators", *arguments, "--json"], capture_output=True, text=True)
    if ran.returncode:
        print(*arguments, ran.stderr.strip())
    return None if ran.returncode else json.loads(ran.stdout)


def main(misalign, catalogue, first, count):
    worst, compared = 0, 0
    for draw in range(int(first), int(first) + int(count)):
        chosen = study(misalign, catalogue, str(draw), "--choose", "--from", "150")
        relaxed = study(misalign, catalogue, str(draw), "--from", "10")  # flat
        if not chosen or not relaxed or not chosen["choice"]["drives"]:
            continue
        choice = chosen["choice"]
        scipy = best_friction(choice, [spring["free_mm"] for spring in relaxed["forces"]])
        ours = choice["static_friction_n_mm_per_mm"]
        compared += 1
        worst = max(worst, scipy / ours - 1)
        print(f"{draw} {ours:.12g} {scipy:.12g} {scipy / ours - 1:.2e}")
    print(f"{compared} draws: SciPy's optimum exceeds a choice by {worst:.2e} at most")


main(*sys.argv[1:])
