#!/usr/bin/env python3
"""Writes meshes as other programs and CAD exports write them, has each read by `misalign fold`, and prints what came of it
as a table: meshes.py PROGRAM [FOLDER]. Files stay in FOLDER if one is named.

Standard library only. Meshes are made here from angles, lengths and, for those with a target, from a folded shape: quadrilaterals
stay plane and angles round a vertex add up to 360 degrees (developable), by Newton's method with the least change; where the mesh
is flat-foldable, too, opposite angles add up to 180. A variant (turned over, in another plane or unit, in another format) must
fold as its original does: the last column is the largest difference of its fold angles at all angles that are printed.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

SIDE_MM = 80.0


# Vectors.
def minus(a, b): return [x - y for x, y in zip(a, b)]
def plus(a, b): return [x + y for x, y in zip(a, b)]
def times(k, a): return [k * x for x in a]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return times(1 / math.sqrt(dot(a, a)), a)
def angle(a, b): return math.atan2(math.hypot(*cross(a, b)), dot(a, b))


class Grid:
    """Rows and columns of panels with their vertices, edges and faces, counted row by row."""

    def __init__(self, rows, columns, holes=()):
        self.rows, self.columns, self.wide = rows, columns, columns + 1
        self.count = (rows + 1) * (columns + 1)
        at = lambda i, j: i * self.wide + j
        self.faces = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rows) for j in range(columns)]
        self.kept = [f for k, f in enumerate(self.faces) if divmod(k, columns) not in set(holes)]
        self.inner = [at(i, j) for i in range(1, rows) for j in range(1, columns)]
        self.edges = sorted({tuple(sorted((f[k], f[(k + 1) % 4]))) for f in self.faces for k in range(4)})

    def around(self, v):
        """Neighbours of an inner vertex, counter-clockwise."""
        return v + 1, v + self.wide, v - 1, v - self.wide


def checkerboard(rows, columns):
    return [(r, c) for r in range(1, rows - 1) for c in range(1, columns - 1) if (r + c) % 2]


def miura_signs(grid):
    """Zigzags valley and mountain in turn, the creases across them changing at every vertex: +1 is a valley."""
    signs = {}
    for a, b in grid.edges:
        i, j = divmod(a, grid.wide)
        if b == a + 1:
            signs[a, b] = ((1 if j % 2 else -1) if j else -1) * (1 if i % 2 else -1)
        else:
            signs[a, b] = 1 if j % 2 else -1
    return signs


def fold_file(grid, points, signs, **more):
    """FOLD with an edge between two kept faces a mountain or a valley, any other a border."""
    sides = {}
    for face in grid.kept:
        for k in range(4):
            key = tuple(sorted((face[k], face[(k + 1) % 4])))
            sides[key] = sides.get(key, 0) + 1
    letters = ["B" if sides[e] < 2 else "V" if signs[e] > 0 else "M" for e in grid.edges]
    return {"file_spec": 1.2, "frame_unit": "mm", "vertices_coords": [list(p) for p in points],
            "edges_vertices": [list(e) for e in grid.edges], "edges_assignment": letters,
            "faces_vertices": [list(f) for f in grid.kept], **more}


# Meshes from angles and lengths.
def miura(rows=6, columns=6, widths=None, heights=None, offsets=None):
    widths, heights, offsets = widths or [SIDE_MM] * columns, heights or [SIDE_MM] * rows, offsets or [40.0] * rows
    grid = Grid(rows, columns, checkerboard(rows, columns))
    points, shift = [], 0.0
    for i in range(rows + 1):
        points += [[shift + sum(widths[:j]), sum(heights[:i])] for j in range(columns + 1)]
        if i < rows:
            shift += offsets[i] if i % 2 == 0 else -offsets[i]
    return grid, points, miura_signs(grid)


def walked(rows, columns, across_deg, up_deg, widths):
    """Vertices from the directions of the edges that leave each for the next column and row."""
    def ray(deg): return [math.cos(math.radians(deg)), math.sin(math.radians(deg))]

    def meet(p, u, q, v):
        t = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / (u[0] * v[1] - u[1] * v[0])
        return plus(p, times(t, u))
    p = {(0, 0): [0.0, 0.0]}
    for j in range(columns):
        p[0, j + 1] = plus(p[0, j], times(widths[j], ray(across_deg(0, j))))
    for i in range(rows):
        p[i + 1, 0] = plus(p[i, 0], times(SIDE_MM, ray(up_deg(i, 0))))
        for j in range(columns):
            p[i + 1, j + 1] = meet(p[i, j + 1], ray(up_deg(i, j + 1)), p[i + 1, j], ray(across_deg(i + 1, j)))
    return [p[key] for key in sorted(p)]


def turned_quads(angles_deg, widths, rows=6, columns=6):
    """Quadrilaterals with the same four angles, every other one turned by half: rigid, and flat-foldable where opposite angles
    add up to 180 degrees."""
    a, b, c, _ = angles_deg
    across, up = [0.0, 180.0 - b - c], [a, 180.0 - b]
    grid = Grid(rows, columns, checkerboard(rows, columns))
    points = walked(rows, columns, lambda i, j: across[(i + j) % 2], lambda i, j: up[(i + j) % 2], widths)
    signs = {(v, w): (-1 if sum(divmod(v, grid.wide)) % 2 else 1) if w == v + 1 else 1 for v, w in grid.edges}
    return grid, points, signs


def double_corrugation(rows=6, columns=6):
    grid = Grid(rows, columns, checkerboard(rows, columns))
    points = walked(rows, columns, lambda i, j: -8.0 if j % 2 else 8.0, lambda i, j: 112.0 if i % 2 else 68.0, [SIDE_MM] * columns)
    return grid, points, miura_signs(grid)


# Meshes with a target: a folded shape, and the flat sheet that folds to it.
def solved(matrix, right):
    """Gaussian elimination with the largest pivots."""
    n = len(right)
    rows = [list(matrix[i]) + [right[i]] for i in range(n)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(k + 1, n):
            share = rows[i][k] / rows[k][k]
            if share:
                rows[i] = [x - share * y for x, y in zip(rows[i], rows[k])]
    found = [0.0] * n
    for k in reversed(range(n)):
        found[k] = (rows[k][n] - sum(rows[k][j] * found[j] for j in range(k + 1, n))) / rows[k][k]
    return found


def sheet_with_target(target, flat_foldable, rows=6, columns=6):
    """The nearest sheet to a Miura-ori at 100 degrees whose points `target` moves."""
    grid = Grid(rows, columns, checkerboard(rows, columns))
    half, slant = math.radians(50), math.atan2(SIDE_MM, 40.0)
    rise = math.sin(half) * math.sin(slant)                  # of a zigzag's edges
    wide = math.sqrt(1 - (math.cos(slant) / math.sqrt(1 - rise * rise)) ** 2)
    points = []
    for i in range(rows + 1):
        for j in range(columns + 1):
            along = SIDE_MM / math.sin(slant) * math.sqrt(1 - rise * rise)
            points.append(target([SIDE_MM * wide * j, along * i + SIDE_MM * math.sqrt(1 - wide * wide) * (j % 2),
                                  SIDE_MM / math.sin(slant) * rise * (i % 2)]))

    def plane(face):
        return list(face), lambda q: dot(minus(q[1], q[0]), cross(minus(q[2], q[0]), minus(q[3], q[0]))) / SIDE_MM ** 3

    def angles(v, weights, total):
        def open_by(q):
            rays = [minus(p, q[0]) for p in q[1:]]
            return sum(w * angle(rays[k], rays[(k + 1) % 4]) for k, w in enumerate(weights)) - total
        return [v, *grid.around(v)], open_by
    rules = [plane(face) for face in grid.faces] + [angles(v, (1, 1, 1, 1), 2 * math.pi) for v in grid.inner]
    if flat_foldable:
        rules += [angles(v, (1, -1, 1, -1), 0) for v in grid.inner]
    for _ in range(60):
        values, slopes = [], []
        for where, rule in rules:
            place = [list(points[v]) for v in where]
            values.append(rule(place))
            slope = {}
            for n, v in enumerate(where):
                for k in range(3):
                    kept, step = place[n][k], 1e-4
                    place[n][k] = kept + step
                    more = rule(place)
                    place[n][k] = kept - step
                    slope[3 * v + k] = (more - rule(place)) / (2 * step)
                    place[n][k] = kept
            slopes.append(slope)
        if max(map(abs, values)) < 1e-14:
            break
        gram = [[sum(x * b.get(k, 0.0) for k, x in a.items()) for b in slopes] for a in slopes]
        for k in range(len(gram)):
            gram[k][k] += 1e-16
        for share, slope in zip(solved(gram, values), slopes):
            for k, x in slope.items():
                points[k // 3][k % 3] -= share * x
    worst = max(abs(rule([points[v] for v in where])) for where, rule in rules)
    assert worst < 1e-11, worst
    return grid, unrolled(grid, points), signs_of(grid, points)


def signs_of(grid, points):
    middle = lambda f: times(0.25, plus(plus(points[f[0]], points[f[1]]), plus(points[f[2]], points[f[3]])))
    left = {(f[k], f[(k + 1) % 4]): f for f in grid.faces for k in range(4)}
    signs = {}
    for a, b in grid.edges:
        f, g = left.get((a, b)), left.get((b, a))
        if f and g:
            normal = cross(minus(points[f[1]], points[f[0]]), minus(points[f[2]], points[f[0]]))
            signs[a, b] = 1 if dot(normal, minus(middle(g), middle(f))) > 0 else -1
        else:
            signs[a, b] = 0
    return signs


def unrolled(grid, points):
    """The flat sheet: one face after the other laid against one that lies."""
    flat = {grid.faces[0][0]: (0.0, 0.0)}
    first = grid.faces[0]
    flat[first[1]] = (math.dist(points[first[0]], points[first[1]]), 0.0)
    left = list(grid.faces)
    while left:
        for face in left:
            known = [k for k in range(4) if face[k] in flat and face[(k + 1) % 4] in flat]
            if known:
                break
        left.remove(face)
        a, b = face[known[0]], face[(known[0] + 1) % 4]
        x = unit(minus(points[b], points[a]))
        normal = unit(cross(minus(points[face[2]], points[face[0]]), minus(points[face[3]], points[face[1]])))
        y = cross(normal, x)
        (ax, ay), (bx, by) = flat[a], flat[b]
        cos, sin = (bx - ax) / math.hypot(bx - ax, by - ay), (by - ay) / math.hypot(bx - ax, by - ay)
        for v in face:
            if v not in flat:
                u, w = dot(minus(points[v], points[a]), x), dot(minus(points[v], points[a]), y)
                flat[v] = (ax + u * cos - w * sin, ay + u * sin + w * cos)
    return [list(flat[v]) for v in range(grid.count)]


def arch(p, radius=900.0):
    return [(radius + p[2]) * math.sin(p[0] / radius), p[1], (radius + p[2]) * math.cos(p[0] / radius) - radius]


def dome(p, radius=1500.0):
    return [p[0], p[1], p[2] - ((p[0] - 180) ** 2 + (p[1] - 150) ** 2) / (2 * radius)]


# What other programs make of a mesh.
def rounded(mesh, step):
    grid, points, signs = mesh
    return grid, [[round(x / step) * step for x in p] for p in points], signs


def clockwise(file, letters=True):
    """The sheet seen from below: the same letters from there are the others."""
    other = {"M": "V", "V": "M"}
    if letters:
        file["edges_assignment"] = [other.get(letter, letter) for letter in file["edges_assignment"]]
    file["faces_vertices"] = [face[::-1] for face in file["faces_vertices"]]
    return file


def placed(file, place):
    file["vertices_coords"] = [place(*p) for p in file["vertices_coords"]]
    return file


def in_unit(file, name, mm):
    file["frame_unit"] = name
    return placed(file, lambda x, y: [x / mm, y / mm])


def with_cuts(grid, file):
    rim = lambda v: v < grid.wide or v >= grid.count - grid.wide or v % grid.wide in (0, grid.wide - 1)
    file["edges_assignment"] = ["C" if letter == "B" and not (rim(a) and rim(b)) else letter
                                for letter, (a, b) in zip(file["edges_assignment"], file["edges_vertices"])]
    return file


def without(file, *keys):
    return {key: value for key, value in file.items() if key not in keys}


def obj_file(file, lines=False):
    """Wavefront's OBJ, y upwards; lines in groups say mountains and valleys."""
    text = "# a flat sheet\n" + "".join(f"v {y!r} 0 {x!r}\n" for x, y in file["vertices_coords"])
    if lines:
        for name, letter in (("mountain", "M"), ("valley", "V")):
            text += f"g {name}\n" + "".join(f"l {a + 1} {b + 1}\n" for (a, b), its
                                            in zip(file["edges_vertices"], file["edges_assignment"]) if its == letter)
    return text + "g panels\n" + "".join("f " + " ".join(str(v + 1) for v in f) + "\n" for f in file["faces_vertices"])


def plus_sheet():
    grid = Grid(6, 6)
    _, points, signs = miura()
    faces = [f for k, f in enumerate(grid.faces) if k // 6 in (2, 3) or k % 6 in (2, 3)]
    used = sorted({v for f in faces for v in f})
    number = {v: n for n, v in enumerate(used)}
    edges = sorted({tuple(sorted((f[k], f[(k + 1) % 4]))) for f in faces for k in range(4)})
    count = lambda e: sum(set(e) <= set(f) for f in faces)
    return {"file_spec": 1.2, "frame_unit": "mm", "vertices_coords": [points[v] for v in used],
            "edges_vertices": [[number[a], number[b]] for a, b in edges],
            "edges_assignment": ["B" if count(e) < 2 else "V" if signs[e] > 0 else "M" for e in edges],
            "faces_vertices": [[number[v] for v in f] for f in faces]}


def meshes():
    """Name, what it is, the name of its original or none, ending, content."""
    widths = [70.0, 76.0, 82.0, 88.0, 94.0, 100.0]
    originals = {
        "miura": ("Miura-ori", miura()),
        "graded": ("Miura-ori, every row and column of its own size", miura(widths=widths, heights=[60.0, 85.0, 70.0, 90.0, 75.0, 65.0],
                                                                        offsets=[30.0, 45.0, 35.0, 40.0, 42.0, 33.0])),
        "corrugation": ("double corrugation surface", double_corrugation()),
        "array": ("angle array, flat-foldable", turned_quads((80, 110, 100, 70), widths)),
        "turned": ("turned quadrilaterals, rigid, not flat-foldable", turned_quads((84, 104, 100, 72), [SIDE_MM] * 6)),
        "arch": ("developable, flat-foldable, an arch at 100°", sheet_with_target(arch, True)),
        "dome": ("developable, flat-foldable, a dome at 100°", sheet_with_target(dome, True)),
        "vault": ("developable, an arch at 100°, not flat-foldable", sheet_with_target(arch, False)),
    }
    rows = [(name, what, None, "fold", fold_file(*mesh)) for name, (what, mesh) in originals.items()]
    of = lambda name: fold_file(*originals[name][1])

    def add(name, what, original, content, ending="fold"):
        rows.append((name, what, original, ending, content))
    for name in ("arch", "array", "turned"):
        for step in (0.001, 0.01, 0.1):
            add(f"{name}-{step:g}", f"{name}, rounded to {step:g} mm", None, fold_file(*rounded(originals[name][1], step)))
    add("clockwise", "arch, faces clockwise, letters seen from below", "arch", clockwise(of("arch")))
    mixed = of("arch")
    mixed["faces_vertices"][5].reverse()
    add("mixed", "arch, one face the other way round", None, mixed)
    add("upright-xz", "turned in the plane y = 0", "turned", placed(of("turned"), lambda x, y: [x, 0, y]))
    add("upright-yz", "array in the plane x = 40, faces clockwise from +x", "array", placed(of("array"), lambda x, y: [40, y, x]))
    c, s = math.cos(0.6), math.sin(0.6)
    add("tilted", "dome in a tilted plane, moved", "dome",
        placed(of("dome"), lambda x, y: [x + 100, c * y - 20, s * y + 300]))
    add("noise", "graded with z of ±1e-15", "graded", placed(of("graded"), lambda x, y: [x, y, 1e-15 if x > y else -1e-15]))
    add("tilted-0.1", "corrugation in a tilted plane, rounded to 0.1 mm", None,
        placed(of("corrugation"), lambda x, y: [round(v, 1) for v in (x, c * y, s * y)]))
    for unit_name, mm in (("nm", 1e-6), ("um", 1e-3), ("in", 25.4), ("pt", 25.4 / 72), ("m", 1000.0)):
        add(f"unit-{unit_name}", f"corrugation in {unit_name}", "corrugation", in_unit(of("corrugation"), unit_name, mm))
    add("unit-square", "miura of about 1 × 1, no unit", None, without(placed(of("miura"), lambda x, y: [x / 480, y / 480]), "frame_unit"))
    add("cuts", "angle array, holes cut (C), no faces", "array",
        without(with_cuts(originals["array"][1][0], of("array")), "faces_vertices"))
    add("cuts-faces", "turned, holes cut (C), with faces", "turned", with_cuts(originals["turned"][1][0], of("turned")))
    add("frames", "dome as the second frame of two", "dome",
        {"file_spec": 1.2, "file_frames": [{"frame_classes": ["foldedForm"], "vertices_coords": [[0, 0, 1]]},
                                           {"frame_classes": ["creasePattern"], **of("dome")}]})
    add("folded", "miura, the key frame folded", None,
        placed(of("miura"), lambda x, y: [x, y * 0.9, 25.0 if round(y / SIDE_MM) % 2 else 0.0]))
    add("letterless", "graded, no edges_assignment", "graded", without(of("graded"), "edges_assignment"))
    add("obj", "miura in OBJ, y upwards", "miura", obj_file(of("miura")), "obj")
    add("obj-lines", "arch in OBJ, creases as lines in groups", "arch", obj_file(of("arch"), lines=True), "obj")
    add("obj-open", "array in OBJ, no lines", None, obj_file(of("array")), "obj")
    add("triangles", "miura in OBJ, triangulated", None,
        "".join(f"v {x!r} {y!r} 0\n" for x, y in of("miura")["vertices_coords"]) +
        "".join(f"f {a + 1} {b + 1} {c + 1}\nf {a + 1} {c + 1} {d + 1}\n" for a, b, c, d in of("miura")["faces_vertices"]), "obj")
    add("plus", "miura without its four corners, no panel inside", None, plus_sheet())
    return rows


def creases_of(document):
    return {(crease["from"], crease["to"]): crease["fold_angle_deg"] for crease in document["creases"]}


def main():
    program, kept = sys.argv[1], sys.argv[2:]
    folder = pathlib.Path(kept[0] if kept else tempfile.mkdtemp())
    folder.mkdir(exist_ok=True)
    folded, read = {}, 0
    print("| file | mesh | what comes of it | off its original |\n|---|---|---|---|")
    rows = meshes()
    for name, what, original, ending, content in rows:
        path = folder / f"{name}.{ending}"
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        run = subprocess.run([program, "fold", str(path), "--json"], capture_output=True, text=True, check=False)
        said = [line.removeprefix("misalign: ").replace(str(path) + ": ", "") for line in run.stderr.splitlines()]
        off = ""
        if run.returncode == 0:
            read += 1
            folded[name] = json.loads(run.stdout)
            outcome = "; ".join(["read", *said])
            if original:
                ours, theirs = creases_of(folded[name]), creases_of(folded[original])
                assert ours.keys() == theirs.keys(), name
                off = f"{max(abs(a - b) for key in ours for a, b in zip(ours[key], theirs[key], strict=True)):.1g}°"
        else:
            outcome = f"refused ({run.returncode}): " + " ".join(said)
        print(f"| `{path.name}` | {what} | {outcome.replace('|', chr(92) + '|')} | {off} |")
    print(f"\n{len(rows)} meshes: {read} read, {len(rows) - read} refused.")


if __name__ == "__main__":
    main()
