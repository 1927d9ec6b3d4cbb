#!/usr/bin/env python3
"""A slow release in CalculiX beside the path: dynamic.py PROGRAM PATTERN.json FOLDER

FOLDER is the --output of a damped `misalign stress` of that pattern. At each of ccx's times the fold angles of all creases,
between the panels' mean normals, are put beside those of the rigid path where the sum of length times fold angle is the
same; prints the largest difference every few degrees, and the largest of all. Vertices alone are compared.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from static import Deck


def folds_of(deck, places):
    """Of each crease, degrees; `places` of each corner of each panel."""
    normals = []
    for panel in deck.panels:
        p = [places[deck.node_of[n]] for n in panel]
        normals.append(np.cross(p[2] - p[0], p[3] - p[1]))
    return np.array([np.degrees(np.arctan2(np.linalg.norm(np.cross(normals[i], normals[j])), normals[i] @ normals[j]))
                     for i, j, _ in deck.folds])


def rigid_path(program, pattern, deck):
    """Sums (mm) and fold angles of the rigid sheet, degree by degree."""
    with tempfile.TemporaryDirectory() as folder:
        name = subprocess.run([program, "export", pattern, "--format", "fold", "--step", "1", "--output", folder], check=True,
                              capture_output=True, text=True).stdout.split()[-1]
        sheet = json.loads(Path(name).read_text())
    assert len(sheet["faces_vertices"]) == len(deck.panels)
    rows = []
    for frame in sheet["file_frames"]:
        at = np.array(frame["vertices_coords"])
        places = {deck.node_of[n]: at[v] for panel, face in zip(deck.panels, sheet["faces_vertices"])
                  for n, v in zip(panel, face)}
        rows.append(folds_of(deck, places))
    rows = np.array(rows)
    lengths = np.array([length for *_, length in deck.folds])
    return np.radians(rows) @ lengths, rows, lengths


def main(program, pattern, folder):
    stem = Path(pattern).stem
    deck = Deck(next(Path(folder).glob(f"{stem}*.inp")).read_text())
    dat = next(Path(folder).glob(f"{stem}*.dat")).read_text()
    sums, path, lengths = rigid_path(program, pattern, deck)
    blocks = re.split(r"\n displacements .* time +(\S+)\n", dat)
    worst, shown = 0, None
    print("| time | mean fold of the creases | largest difference of one |\n|---|---|---|")
    for time, block in zip(blocks[1::2], blocks[2::2]):
        moved = {}
        for node, *u in re.findall(r"^ +(\d+) +(\S+) +(\S+) +(\S+)$", block, re.M):
            if int(node) in deck.node_of:
                moved.setdefault(deck.node_of[int(node)], np.array([float(v) for v in u]))
        folds = folds_of(deck, {n: deck.at[n] + moved[n] for n in deck.vertices})
        total = np.radians(folds) @ lengths
        rigid = np.array([np.interp(total, sums, path[:, k], left=0) for k in range(path.shape[1])])
        mean, off = total / lengths.sum() * 180 / np.pi, np.abs(folds - rigid).max()
        worst = max(worst, off)
        if shown is None or shown - mean >= 3:
            shown = mean
            print(f"| {float(time):.3f} s | {mean:.1f}° | {off:.2f}° |")
    print(f"\nlargest: {worst:.2f}°, last at a mean fold of {mean:.1f}°, {float(time):.3f} s")


if __name__ == "__main__":
    main(*sys.argv[1:])
