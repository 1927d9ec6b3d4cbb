#!/usr/bin/env python3
"""Meshes of two other programs, flat and folded, through `misalign fold`:
peers.py MISALIGN ADDITIVE_ORIGAMI RFFQM_ORIGAMI, the last two clones of github.com/garyptchoi/additive-origami and
github.com/AlonSardas/RFFQMOrigami. Prints the tables of README.md."""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np


def read_obj(path):
    lines = [line.split() for line in path.read_text().splitlines() if line.strip()]
    return (np.array([[float(x) for x in w[1:4]] for w in lines if w[0] == "v"]),
            [[int(x.split("/")[0]) - 1 for x in w[1:]] for w in lines if w[0] == "f"])


def places(faces):
    """Row and column of each face, walking over shared edges from the first."""
    beside = collections.defaultdict(list)
    for f, face in enumerate(faces):
        for k in range(4):
            beside[frozenset((face[k], face[k - 3]))].append(f)
    at, turn, left = {0: (0, 0)}, {0: 0}, [0]
    while left:
        f = left.pop()
        for k in range(4):
            side = (k - turn[f]) % 4
            for g in beside[frozenset((faces[f][k], faces[f][k - 3]))]:
                if g in at:
                    continue
                step = ((-1, 0), (0, 1), (1, 0), (0, -1))[side]
                at[g] = at[f][0] + step[0], at[f][1] + step[1]
                turn[g] = (faces[g].index(faces[f][k - 3]) - side - 2) % 4
                left.append(g)
    least = np.min(list(at.values()), axis=0)
    return {(r - least[0], c - least[1]): f for f, (r, c) in at.items()}


def block(folder, name, row, column, size=6):
    flat, faces = read_obj(folder / f"{name}_flat.obj")
    folded = read_obj(folder / f"{name}_fold.obj")[0]
    at = places(faces)
    part = [faces[at[r, c]] for r in range(row, row + size) for c in range(column, column + size)]
    used = sorted({v for face in part for v in face})
    return flat[used], folded[used], [[used.index(v) for v in face] for face in part]


class Trial:
    def __init__(self, program):
        self.program, self.folder = program, pathlib.Path(tempfile.mkdtemp())

    def run(self, verb, flat, folded, faces, more=(), digits=None, **keys):
        """Exit code, standard output and messages; edges are scaled to 80 mm."""
        edge = np.median([np.linalg.norm(flat[f[k]] - flat[f[k - 1]]) for f in faces for k in range(4)])
        for name, points in ("flat.obj", flat), ("folded.obj", folded):
            points = points * 80 / edge if digits is None else np.round(points * 80 / edge, digits)
            lines = ["v " + " ".join(repr(float(x)) for x in p) for p in points]
            lines += ["f " + " ".join(str(v + 1) for v in f) for f in faces]
            (self.folder / name).write_text("\n".join(lines) + "\n")
        pattern = {"family": "fold", "file": "flat.obj", "target_file": "folded.obj", **keys}
        (self.folder / "mesh.json").write_text(json.dumps(pattern))
        run = subprocess.run([self.program, verb, str(self.folder / "mesh.json"), *more], capture_output=True, text=True)
        return run.returncode, run.stdout, [line.split("mesh.json: ")[-1] for line in run.stderr.splitlines()]

    def row(self, label, *mesh, **keys):
        code, out, said = self.run("fold", *mesh, more=["--json"], **keys)
        if code:
            return print(f"| {label} | refused: {said[-1]} | | | | | | |")
        fold = json.loads(out)
        at = fold["target"]
        base = "closed form" if "rigidly" in said[-1] else "its own"
        joined = said[-1].split("within ")[-1].removesuffix(" mm")
        moved = next((s.split("at most ")[-1].removesuffix(" mm") for s in said if "nearest sheet" in s), "0")
        held = "" if at["barrier_n_mm"] < 1e-9 else f"{at['driven_from_below_deg']:.1f} to {at['driven_from_deg']:.1f}"
        print(f"| {label} | {base} | {moved} | {at['rest_deg']:.2f}° | {joined} | {at['shape_off_mm']:.1e} | {held} | "
              f"{max(at['barrier_n_mm'], 1e-9):.4g} |")


def rffqm(folder):
    sys.path.insert(0, str(folder))
    from origami import RFFQMOrigami, marchingalgorithm, quadranglearray
    for left, bottom, gamma, lengths, angle in ((0, 0, 1.2, [1] * 6, 0.7 * np.pi),
                                                (0.03, 0.05, 1.0, [1.2, 1, 1.2, 1.1, 1.2, 1], 1.3),
                                                (0, 0.08, 1.4, [2, 1.4, 2, 1.4, 2, 1.4], 2)):
        lefts, bottoms = marchingalgorithm.create_miura_angles(np.array(lengths), np.ones(6), angle)
        marching = marchingalgorithm.MarchingAlgorithm(lefts + left, bottoms + bottom)
        dots, number = marching.create_dots(np.array(lengths), np.ones(6))
        sheet = RFFQMOrigami.RFFQM(quadranglearray.dots_to_quadrangles(dots, number))
        flat = sheet.initial_dots.dots.T.copy()
        sheet.set_gamma(gamma)
        faces = [[int(number[r, c]), int(number[r, c + 1]), int(number[r + 1, c + 1]), int(number[r + 1, c])]
                 for r in range(6) for c in range(6)]
        yield f"angle {angle:.3g}, + {left}, {bottom}; γ = {gamma}", flat, sheet.dots.dots.T.copy(), faces


def main():
    program, additive, marching = sys.argv[1], pathlib.Path(sys.argv[2]) / "pattern", pathlib.Path(sys.argv[3])
    trial = Trial(program)
    head = "| mesh | base | moved, mm | target | joined, mm | off the target, mm | driven from | barrier, N mm |\n" + "|---" * 8 + "|"
    print(head)
    blocks = [(0, 0), (5, 5), (10, 12), (14, 20), (20, 30), (26, 4), (13, 17)]
    for row, column in blocks:
        trial.row(f"`peaks_coarse2` from {row}, {column}", *block(additive, "peaks_coarse2", row, column))
    mesh = block(additive, "peaks_coarse2", 0, 0)
    for digits in (4, 3, 2):
        trial.row(f"the first, rounded to {10**-digits:g} mm", *mesh, digits=digits)
    trial.row("the first, even holes", *mesh, holes="checkerboard-even")
    for size, holes in (8, "checkerboard-odd"), (12, "checkerboard-odd"), (12, "checkerboard-even"):
        trial.row(f"{size} × {size} from 2, 2, {holes[13:]} holes", *block(additive, "peaks_coarse2", 2, 2, size), holes=holes)
    for name, row, column in (("F4D", 2, 40), ("F4E", 10, 6), ("F4E", 20, 8), ("F4E", 30, 2)):
        trial.row(f"`{name}` from {row}, {column}", *block(additive, name, row, column))
    print("\n" + head)
    for label, *mesh in rffqm(marching):
        trial.row(label, *mesh)
    out = trial.run("perforations", *block(additive, "peaks_coarse2", 0, 0))[1]
    print("\n" + out.splitlines()[-1])


main()
