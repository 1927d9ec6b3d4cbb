#!/usr/bin/env python3
"""Which ways diagonals can go at all, for shifts that tend to zero: cone.py D_DEG [AMPLITUDE_MM [BEST]].

Elongations of the paper's 6 x 6 sheet are linear in small shifts of its interior vertices. For each pattern of signs of its
diagonals (of a pattern and its mirror image, all signs the other way round, one) a linear program asks for shifts of at most
1 with which every diagonal goes its way between all neighbouring angles up to D, and makes the least movement over the norm
of its gradient, the margin against miscuts, as large as it can be. Signs are taken one after the other, and what is
impossible for some of the diagonals is not asked for all. With an amplitude the BEST patterns' shifts are scaled to it,
folded, and optimised from there.

PYTHONPATH=build/release/python results/optimise/cone.py 150 0.05 20
"""
import sys
import time

import numpy as np
from scipy.optimize import linprog

import misalign

to_deg = float(sys.argv[1])
base = misalign.read("search/patterns/table1.json")
base = base.with_shifts(0 * base.shifts_mm)
angles = np.append(np.arange(4, to_deg - 24, 4), np.append(np.arange(max(4, to_deg - 24), to_deg, 2), to_deg))
by_mm = base.gradient(np.append(0, angles))["length_by_mm"]
interior = np.array(base.interior)
moved = np.diff(by_mm, axis=0)[:, :, interior, :].reshape(len(angles), by_mm.shape[1], -1)  # section, diagonal, coordinate
moved /= np.linalg.norm(moved, axis=2, keepdims=True)
diagonals, coordinates = moved.shape[1:]
coarse = np.unique(np.append(np.arange(0, len(angles), 5), [len(angles) - 2, len(angles) - 1]))
programs = 0


def best(signs, sections):
    """The largest margin for these first diagonals, mm for each mm, and its shifts; none where there is no room."""
    global programs
    programs += 1
    rows = (np.array(signs)[:, None, None] * moved[sections][:, : len(signs)].transpose(1, 0, 2)).reshape(-1, coordinates)
    found = linprog(np.append(np.zeros(coordinates), -1), A_ub=np.hstack([-rows, np.ones((len(rows), 1))]),
                    b_ub=np.zeros(len(rows)), bounds=[(-1, 1)] * coordinates + [(0, None)], method="highs")
    return (-found.fun, found.x[:-1]) if found.status == 0 and -found.fun > 1e-9 else None


possible, opened = [], [[1]]
begin = time.process_time()
while opened:
    signs = opened.pop()
    if best(signs, coarse) is None:
        continue
    if len(signs) < diagonals:
        opened += [signs + [-1], signs + [1]]
        continue
    found = best(signs, np.arange(len(angles)))
    if found:
        possible.append((*found, signs))
possible.sort(key=lambda one: -one[0])
print(f"up to {to_deg:g} deg: {len(possible)} of {2 ** (diagonals - 1)} patterns are possible, {programs} programs, "
      f"{time.process_time() - begin:.0f} s")
if not possible:
    sys.exit()
holes = {}
for k in range(diagonals):
    holes.setdefault(k // 2, []).append(k)  # two of each hole, one after the other
opposite = sum(all(signs[a] != signs[b] for a, b in holes.values()) for _, _, signs in possible)
print(f"the two diagonals of every hole go opposite ways in {opposite} of them")
margins = np.array([one[0] for one in possible])
print("margin, mm for each mm of amplitude: most, median, least:", *(f"{m:.3g}" for m in (margins[0], np.median(margins), margins[-1])))
if len(sys.argv) > 2:
    amplitude_mm, wanted = float(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 10
    folded, ends = 0, []
    for margin, shifts, signs in possible[:wanted]:
        shifts_mm = np.zeros_like(base.shifts_mm)
        shifts_mm[interior] = amplitude_mm * np.clip(shifts, -1, 1).reshape(-1, 2)
        sheet = base.with_shifts(shifts_mm)
        d_deg = sheet.fold().deploys_from_deg
        folded += d_deg >= to_deg
        if d_deg >= to_deg:
            better, said = sheet.optimise(deploys_from_deg=to_deg, amplitude_mm=amplitude_mm, goal="miscut_margin_mm")
            ends.append((margin * amplitude_mm, said["before_mm"], said["after_mm"]))
    print(f"of the best {min(wanted, len(possible))}, at {amplitude_mm:g} mm, {folded} deploy from there")
    for foreseen, before, after in ends:
        print(f"  margin foreseen {foreseen:.4f} mm, folded {before:.4f}, optimised {after:.4f}")
