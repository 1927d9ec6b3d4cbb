#!/usr/bin/env python3
"""Writes the example meshes of search/patterns (FOLD 1.2): scripts/patterns.py search/patterns"""
import json
import math
import pathlib
import sys


def ray(deg):
    return math.cos(math.radians(deg)), math.sin(math.radians(deg))


def meet(p, u, q, v):
    """Where the lines from p along u and from q along v meet."""
    cross = u[0] * v[1] - u[1] * v[0]
    t = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / cross
    return p[0] + t * u[0], p[1] + t * u[1]


def grid(rows, columns, across, up, widths, heights):
    """Vertices from the first row's and column's lengths; across(i, j) and up(i, j) are the
    directions (deg) of the edges that leave vertex (i, j) for the next column and row."""
    p = {(0, 0): (0.0, 0.0)}
    for j in range(columns):
        u = ray(across(0, j))
        p[0, j + 1] = (p[0, j][0] + widths[j] * u[0], p[0, j][1] + widths[j] * u[1])
    for i in range(rows):
        u = ray(up(i, 0))
        p[i + 1, 0] = (p[i, 0][0] + heights[i] * u[0], p[i, 0][1] + heights[i] * u[1])
        for j in range(columns):
            p[i + 1, j + 1] = meet(p[i, j + 1], ray(up(i, j + 1)), p[i + 1, j], ray(across(i + 1, j)))
    return p


def fold(title, rows, columns, p, across_sign, up_sign, holes=()):
    """across_sign(i, j), up_sign(i, j): valley +1 or mountain -1 of the edges that leave (i, j)."""
    index = {(i, j): i * (columns + 1) + j for i in range(rows + 1) for j in range(columns + 1)}
    open_at = set(holes)
    kept = lambda r, c: 0 <= r < rows and 0 <= c < columns and (r, c) not in open_at
    edges, letters = [], []

    def edge(i, j, to_i, to_j, sides, sign):
        edges.append([index[i, j], index[to_i, to_j]])
        inside = all(kept(r, c) for r, c in sides)
        letters.append(("V" if sign > 0 else "M") if inside else "B")

    for i in range(rows + 1):
        for j in range(columns + 1):
            if j < columns:
                edge(i, j, i, j + 1, [(i - 1, j), (i, j)], across_sign(i, j))
            if i < rows:
                edge(i, j, i + 1, j, [(i, j - 1), (i, j)], up_sign(i, j))
    faces = [[index[r, c], index[r, c + 1], index[r + 1, c + 1], index[r + 1, c]]
             for r in range(rows) for c in range(columns) if kept(r, c)]
    return {"file_spec": 1.2, "file_creator": "misalign", "file_title": title,
            "file_classes": ["singleModel"], "frame_classes": ["creasePattern"],
            "frame_unit": "mm",
            "vertices_coords": [[round(x, 9) for x in p[key]] for key in sorted(index, key=index.get)],
            "edges_vertices": edges, "edges_assignment": letters, "faces_vertices": faces}


def miura_signs():
    """Zigzag lines valley and mountain in turn, the creases across them changing at every vertex."""
    zigzag = lambda j: 1 if j % 2 else -1
    return (lambda i, j: (zigzag(j) if j else -zigzag(1)) * (1 if i % 2 else -1),
            lambda i, j: zigzag(j))


def checkerboard(rows, columns):
    return [(r, c) for r in range(1, rows - 1) for c in range(1, columns - 1) if (r + c) % 2]


def double_corrugation(rows=6, columns=6, across_deg=10.0, up_deg=25.0, side=80.0):
    """Both families of creases are zigzags; all panels are parallelograms (a Miura-ori has
    across_deg = 0). The file lacks the panels of the odd checkerboard."""
    p = grid(rows, columns, lambda i, j: across_deg if j % 2 == 0 else -across_deg,
             lambda i, j: 90 - up_deg if i % 2 == 0 else 90 + up_deg, [side] * columns, [side] * rows)
    return fold("double corrugation surface", rows, columns, p, *miura_signs(),
                holes=checkerboard(rows, columns))


def turned_quads(title, angles_deg, rows=6, columns=6, widths=None, heights=None):
    """Quadrilaterals with the same four angles (from the first corner on, counter-clockwise), every
    other one turned by half: each inner vertex has all four. No two creases are collinear. With
    opposite angles that add up to 180 degrees every vertex folds flat (an angle array of one kind,
    Lang & Howell 2018); otherwise none does, and the sheet still folds (Kokotsakis 1933)."""
    a, b, c, d = angles_deg
    # Sides of the upright quadrilateral from corner 0: 0, 180 - b, ... ; up the other side a.
    across = {0: 0.0, 1: 180.0 - b - c}  # lower side; upper side walked the same way
    up = {0: a, 1: 180.0 - b}            # left side; right side
    odd = lambda i, j: (i + j) % 2
    p = grid(rows, columns, lambda i, j: across[odd(i, j)], lambda i, j: up[odd(i, j)],
             widths or [80.0] * columns, heights or [80.0] * rows)
    # At a vertex: one edge of each kind, three valleys and a mountain.
    return fold(title, rows, columns, p, lambda i, j: -1 if odd(i, j) else 1, lambda i, j: 1)


def main():
    folder = pathlib.Path(sys.argv[1])
    widths = [70.0, 76.0, 82.0, 88.0, 94.0, 100.0]
    files = {
        "double-corrugation-6x6": double_corrugation(),
        "angle-array-6x6": turned_quads("flat-foldable angle array", (80, 110, 100, 70),
                                        widths=widths),
        "turned-quads-6x6": turned_quads("quadrilaterals that do not fold flat", (84, 104, 100, 72)),
    }
    for name, content in files.items():
        lines = ",\n".join(f"{json.dumps(key)}: {json.dumps(value)}" for key, value in content.items())
        (folder / f"{name}.fold").write_text("{\n" + lines + "\n}\n")


main()
