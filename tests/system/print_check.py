"""Plates to print, as readers of STL and 3MF have them: print_check.py SHEET.fold FROM_DEG KIT.3mf STL...

Every edge belongs to two triangles in opposite directions, and STL and 3MF are one kit. Plates are laid into the folded
states of the FOLD file, and no point just below the surface of one lies within another (parity of a ray's crossings)."""

import itertools
import json
import re
import struct
import sys
import xml.etree.ElementTree as xml
import zipfile

import numpy as np

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
BELOW = 0.02  # mm, of points below a surface: faces may touch
MOST = 120  # points of each pair


def read_stl(path):
    with open(path, "rb") as file:
        data = file.read()
    (count,) = struct.unpack("<I", data[80:84])
    assert len(data) == 84 + 50 * count, f"{path}: {len(data)} bytes for {count} triangles"
    rows = np.frombuffer(data, dtype=np.dtype([("n", "<3f4"), ("v", "<9f4"), ("a", "<u2")]), offset=84)
    return rows["v"].reshape(-1, 3, 3).astype(float)


def read_3mf(path):
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        model = xml.fromstring(package.read("3D/3dmodel.model"))
    assert model.get("unit") == "millimeter"
    solids = {}
    for part in model.iter(CORE + "object"):
        points = np.array([[float(v.get(k)) for k in "xyz"] for v in part.iter(CORE + "vertex")])
        corners = [[int(t.get(f"v{k}")) for k in (1, 2, 3)] for t in part.iter(CORE + "triangle")]
        solids[part.get("name")] = points[corners]
    assert len(list(model.iter(CORE + "item"))) == len(solids)
    return solids


def open_edges(triangles):
    """Edges that do not belong to just two triangles in opposite directions."""
    sides = {}
    for triangle in np.round(triangles, 3):
        points = [tuple(p) for p in triangle]
        for p, q in zip(points, points[1:] + points[:1]):
            sides[p, q] = sides.get((p, q), 0) + 1
    return sum(count != sides.get((q, p), 0) for (p, q), count in sides.items())


def volume(t):
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def placed(points, targets):
    a, b = points.mean(axis=0), targets.mean(axis=0)
    u, _, vt = np.linalg.svd((points - a).T @ (targets - b))
    turn = vt.T @ np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T
    return turn, b - turn @ a


def below_surface(t):
    normals = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    length = np.linalg.norm(normals, axis=1)
    t, normals = t[length > 1e-4], normals[length > 1e-4] / length[length > 1e-4, None]
    middles = [t.mean(axis=1)] + [0.5 * (t[:, k] + t[:, (k + 1) % 3]) * 0.98 + 0.02 * t.mean(axis=1) for k in range(3)]
    return np.concatenate([m - BELOW * normals for m in middles])


def within(points, t):
    """Which points lie within a solid: odd numbers of crossings with a ray."""
    ray = np.array([0.3217, 0.5613, 0.7625])
    a, b, c = (t[:, k] for k in range(3))
    u, v = b - a, c - a
    p = np.cross(ray, v)
    det = np.einsum("ij,ij->i", u, p)
    keep = np.abs(det) > 1e-12
    a, u, v, p, det = a[keep], u[keep], v[keep], p[keep], det[keep]
    odd = np.zeros(len(points), dtype=bool)
    for k, point in enumerate(points):
        s = point - a
        x = np.einsum("ij,ij->i", s, p) / det
        q = np.cross(s, u)
        y = q @ ray / det
        far = np.einsum("ij,ij->i", v, q) / det
        odd[k] = ((x >= 0) & (y >= 0) & (x + y <= 1) & (far > 0)).sum() % 2 == 1
    return odd


def main():
    sheet, from_deg, package, *stls = sys.argv[1:]
    with open(sheet, encoding="utf8") as file:
        fold = json.load(file)
    flat = np.hstack([np.array(fold["vertices_coords"]), np.zeros((len(fold["vertices_coords"]), 1))])
    row = sorted(fold["faces_vertices"][0])
    faces = {"r%dc%d" % divmod(min(face), row[2] - row[0]): face for face in fold["faces_vertices"]}
    solids = read_3mf(package)
    parts = {re.search(r"r\d+c\d+", path)[0]: read_stl(path) for path in stls}
    assert set(parts) == set(solids) == set(faces), (sorted(parts), sorted(solids))
    for label, triangles in parts.items():
        assert open_edges(triangles) == open_edges(solids[label]) == 0, f"{label}: {open_edges(triangles)} open edges"
        assert abs(volume(triangles) / volume(solids[label]) - 1) < 1e-4 and volume(triangles) > 0, label
    frames = [(0.0, flat)] + [(f["misalign:pilot_deg"], np.array(f["vertices_coords"])) for f in fold["file_frames"]]
    used = [frame for frame in frames if frame[0] <= float(from_deg) + 1e-6]
    assert abs(used[-1][0] - float(from_deg)) < 1e-6
    tried, random = 0, np.random.default_rng(1)
    for deg, at in (used[0], used[len(used) // 2], used[-1]):
        moved = {}
        for label, face in faces.items():
            turn, shift = placed(flat[face], at[face])
            moved[label] = parts[label] @ turn.T + shift
        for a, b in itertools.permutations(faces, 2):
            low, high = moved[b].min(axis=(0, 1)), moved[b].max(axis=(0, 1))
            if (moved[a].min(axis=(0, 1)) > high).any() or (moved[a].max(axis=(0, 1)) < low).any():
                continue
            points = below_surface(moved[a])
            points = points[((points > low) & (points < high)).all(axis=1)]
            points = points[random.permutation(len(points))[:MOST]]
            tried += len(points)
            inside = within(points, moved[b])
            assert not inside.any(), f"{deg:g} deg: {inside.sum()} points of {a} lie within {b}, such as {points[inside][0]}"
    print(f"{package}: {len(parts)} closed plates of {sum(map(volume, parts.values())) / 1000:.1f} cm3; "
          f"{tried} points below surfaces, none within another plate, flat to {used[-1][0]:g} deg")


main()
