#!/usr/bin/env python3
"""How many of the paper's ternary shifts (every vertex -0.4, 0 or 0.4 mm in x and in y, 3^50 of them on 6 x 6) are
members of the parallel family, by two countings that share nothing but the sheet, and how many of those are monotone to
179 degrees, by the formula for one hole and by `judge`, which follows loops: ternary_members.py (needs `import misalign`)."""

import itertools
from fractions import Fraction

import numpy as np

import misalign

ROWS = COLUMNS = 6
WIDTH, HEIGHT, SLANT = 80, 80, 40
LEVEL_MM = 0.4


def vertex(row, column):
    return row * (COLUMNS + 1) + column


def place(row, column):
    return WIDTH * column + (SLANT if row % 2 else 0), HEIGHT * row


def is_hole(parity, row, column):
    inner = 0 < row < ROWS - 1 and 0 < column < COLUMNS - 1
    return inner and (row + column) % 2 == parity


def conditions(parity):
    """Rows of whole numbers by shift (2 v + axis): creases keep their directions, holes stay parallelograms."""
    rows = []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            for other, beside in (((row, column + 1), ((row - 1, column), (row, column))),
                                  ((row + 1, column), ((row, column - 1), (row, column)))):
                if other[0] > ROWS or other[1] > COLUMNS:
                    continue
                if any(not (0 <= r < ROWS and 0 <= c < COLUMNS) or is_hole(parity, r, c) for r, c in beside):
                    continue
                (x0, y0), (x1, y1) = place(row, column), place(*other)
                a, b = vertex(row, column), vertex(*other)
                rows.append({2 * b + 1: x1 - x0, 2 * b: y0 - y1, 2 * a + 1: x0 - x1, 2 * a: y1 - y0})
    for row in range(ROWS):
        for column in range(COLUMNS):
            if is_hole(parity, row, column):
                corners = ((row, column, 1), (row, column + 1, -1), (row + 1, column + 1, 1), (row + 1, column, -1))
                for axis in (0, 1):
                    rows.append({2 * vertex(r, c) + axis: sign for r, c, sign in corners})
    inner = {2 * vertex(r, c) + axis for r in range(1, ROWS) for c in range(1, COLUMNS) for axis in (0, 1)}
    return [{k: v for k, v in row.items() if k in inner} for row in rows], sorted(inner)


def members_by_elimination(parity):
    """Every choice of what elimination leaves free, in fractions."""
    rows, unknowns = conditions(parity)
    solved = {}
    for row in rows:
        row = {k: Fraction(v) for k, v in row.items()}
        for pivot, by in solved.items():
            if pivot in row:
                share = row[pivot]
                for k, v in by.items():
                    row[k] = row.get(k, Fraction(0)) - share * v
        row = {k: v for k, v in row.items() if v}
        if not row:
            continue
        pivot = min(row)
        row = {k: v / row[pivot] for k, v in row.items()}
        for other, by in solved.items():
            if pivot in by:
                share = by[pivot]
                for k, v in row.items():
                    by[k] = by.get(k, Fraction(0)) - share * v
                solved[other] = {k: v for k, v in by.items() if v}
        solved[pivot] = row
    free = [k for k in unknowns if k not in solved]
    found = []
    for values in itertools.product((-1, 0, 1), repeat=len(free)):
        shift = dict(zip(free, values))
        for pivot, row in solved.items():
            value = -sum(v * shift[k] for k, v in row.items() if k != pivot)
            if value not in (-1, 0, 1):
                break
            shift[pivot] = int(value)
        else:
            found.append(shift)
    return found, len(free)


def count_by_search(parity):
    """Vertex by vertex, each condition looked at as soon as all of its shifts are chosen; states that leave the same
    open are counted once (a sum over the sheet's rows, no elimination)."""
    rows, unknowns = conditions(parity)
    rows = [row for row in rows if row]
    last = [max(row) for row in rows]
    states = {(): 1}
    names = []
    for unknown in unknowns:
        names = names + [unknown]
        ending = [row for row, end in zip(rows, last) if end == unknown]
        needed = {k for row, end in zip(rows, last) if end > unknown for k in row if k <= unknown}
        kept = [k for k, name in enumerate(names) if name in needed]
        following = {}
        for values, times in states.items():
            for value in (-1, 0, 1):
                chosen = dict(zip(names, values + (value,)))
                if any(sum(v * chosen[k] for k, v in row.items()) for row in ending):
                    continue
                state = tuple((values + (value,))[k] for k in kept)
                following[state] = following.get(state, 0) + times
        states, names = following, [names[k] for k in kept]
    return sum(states.values())


def is_monotone(parity, shift):
    """Every hole by its own formula: delta and epsilon from the shifted edges, the slope at many angles."""
    at = {v: np.array(place(v // (COLUMNS + 1), v % (COLUMNS + 1)), float)
          + LEVEL_MM * np.array([shift.get(2 * v, 0), shift.get(2 * v + 1, 0)])
          for v in range((ROWS + 1) * (COLUMNS + 1))}
    squares = np.tan(np.radians(np.linspace(0.05, 179.95, 2000)) / 2) ** 2
    for row in range(ROWS):
        for column in range(COLUMNS):
            if not is_hole(parity, row, column):
                continue
            a = np.array([1.0, 0.0])
            b = np.array(place(row + 1, column + 1), float) - np.array(place(row, column + 1), float)
            b /= np.hypot(*b)
            cosine, sine = a @ b, a[0] * b[1] - a[1] * b[0]
            first = at[vertex(row, column + 1)] - at[vertex(row, column)]
            second = at[vertex(row + 1, column + 1)] - at[vertex(row, column + 1)]

            def parts(edge):
                return ((edge[0] * b[1] - edge[1] * b[0]) / sine, (a[0] * edge[1] - a[1] * edge[0]) / sine)
            (along, epsilon), (delta, beside) = parts(first), parts(second)
            # Tangents of half the straight edges' fold angles are cos(alpha) times the others'; signs alternate.
            x, y = squares / (1 + squares), cosine ** 2 * squares / (1 + cosine ** 2 * squares)
            sign = 1 if (row + column) % 2 else -1
            mixed = sign * abs(cosine) * squares / ((1 + squares) * (1 + cosine ** 2 * squares))
            change = (along * delta * x + beside * epsilon * y
                      + delta * epsilon * (2 * cosine * x * y + 2 * mixed))
            steps = np.diff(change)
            if not (np.all(steps > 0) or np.all(steps < 0)):
                return False
    return True


for name, parity in (("checkerboard-odd", 1), ("checkerboard-even", 0)):
    members, dimension = members_by_elimination(parity)
    counted = count_by_search(parity)
    assert len(members) == counted, (len(members), counted)
    campaign = misalign.read({"name": "t", "pattern": {"family": "miura", "rows": ROWS, "columns": COLUMNS, "holes": name},
                              "misalignment": {"amplitude_mm": LEVEL_MM}, "accept": {"deploys_from_deg": 179},
                              "path": {"end_deg": 179}})
    shifts = np.zeros((len(members), (ROWS + 1) * (COLUMNS + 1), 2))
    for k, member in enumerate(members):
        for unknown, value in member.items():
            shifts[k, unknown // 2, unknown % 2] = LEVEL_MM * value
    deploys = np.array(misalign.judge(campaign, shifts, threshold_deg=179))
    formula = np.array([is_monotone(parity, member) for member in members])
    print(f"{name}: {dimension} coordinates, {len(members)} members by both countings; "
          f"monotone to 179 deg {np.sum(deploys)} by following, {np.sum(formula)} by the formula, "
          f"{np.sum(deploys != formula)} differ")
