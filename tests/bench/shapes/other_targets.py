#!/usr/bin/env python3
"""Sheets shaped to other surfaces than those of the table, and distances measured on exported vertices:

    other_targets.py PROGRAM FOLDER [NAME[:RADIUS[:FROM]]...] [12x8] [--OPTION=VALUE...]

writes FOLDER/NAME.json and FOLDER/NAME-shaped.json, and prints rows of a table. Radii are in widths of the sheet.

Distances are the program's; then those of the exported OBJ's vertices from the target, in the pose that is fitted here; then
from the surface that a grid stands for. Nothing is shared but the target's numbers. Seconds are CPU seconds."""

import json
import os
import resource
import subprocess
import sys

import numpy as np
from misfit import best_fit, read_obj, rms_and_max
from surfaces import Cylinder, Grid, Height, Sphere, helicoid, saddle

PANEL_MM, SPACING_MM = 80, 40
FROM_DEG = 105


def letter(x, y, high):
    """A plane with an L on it, its sides as steep as the grid allows."""
    upright = (abs(x + 80) <= 40) & (abs(y) <= 160)
    foot = (abs(x) <= 120) & (abs(y + 120) <= 40)
    return float(high) * (upright | foot)


def targets(rows, columns, radius=3):
    """Name: the target of a file, its surface here, that which is meant, and the stowed angle. Radius in widths."""
    w = np.sqrt(rows * columns) * PANEL_MM

    def grid(f, spacing=SPACING_MM, smooth=True):
        half = int(np.ceil(0.625 * max(rows, columns) * PANEL_MM / spacing))
        at = np.arange(-half, half + 1) * float(spacing)
        heights = f(*np.meshgrid(at, at))
        return ({"surface": "grid", "spacing_mm": spacing, "heights_mm": heights.tolist()}, Grid(spacing, heights),
                Height(f) if smooth else None)

    wave = w / (2 * np.pi)
    return {
        "arch-along": ({"surface": "cylinder", "radius_mm": radius * w, "axis": "x"}, Cylinder(radius * w), None, FROM_DEG),
        "dome": ({"surface": "sphere", "radius_mm": radius * w}, Sphere(radius * w), None, FROM_DEG),
        "saddle": ({"surface": "saddle", "radius_mm": radius * w}, saddle(radius * w), None, 98),
        "twist": ({"surface": "helicoid", "radius_mm": radius * w}, helicoid(radius * w), None, 120),
        "s-arch-across": (*grid(lambda x, y: wave**2 / (1.5 * w) * np.sin(x / wave)), FROM_DEG),
        "s-arch-along": (*grid(lambda x, y: wave**2 / (3 * w) * np.sin(y / wave)), FROM_DEG),
        "s-arch-along-tight": (*grid(lambda x, y: wave**2 / (1.5 * w) * np.sin(y / wave)), FROM_DEG),
        "dome-off-centre": (*grid(lambda x, y: w / 27 * np.exp(-4.5 * ((x - w / 8) ** 2 + (y - w / 12) ** 2) / w**2)),
                            FROM_DEG),
        "paraboloid": (*grid(lambda x, y: -(x * x + y * y) / (6 * w)), FROM_DEG),
        "elliptic-paraboloid": (*grid(lambda x, y: -(x * x / 2.5 + y * y / 5) / (2 * w)), FROM_DEG),
        "propeller-blade": (*grid(lambda x, y: (x + w / 8) * np.tan(y / (4 * w)) - (x + w / 8) ** 2 / (6 * w)), FROM_DEG),
        "egg-box": (*grid(lambda x, y: wave**2 / (radius * w) * np.cos(x / wave) * np.cos(y / wave)), FROM_DEG),
        "letter": (*grid(lambda x, y: letter(x, y, 20), smooth=False), FROM_DEG),
        "high-letter": (*grid(lambda x, y: letter(x, y, 60), smooth=False), FROM_DEG),
    }


def sides_of(rows, columns):
    """Heights of the unshifted sheet's folded vertices in half depths: a rim that cuts panels lies beyond the two levels."""
    sides = np.tile(np.where(np.arange(columns + 1) % 2, -1.0, 1.0), (rows + 1, 1))
    sides[1::2, 0] = sides[0::2, -1] = 2
    return sides.ravel()


def run(*words):
    return subprocess.run(words, check=False, capture_output=True, text=True)


def shaped(program, folder, name, rows, columns, more):
    word, *rest = name.split(":")
    target, surface, meant, from_deg = targets(rows, columns, *map(float, rest[:1]))[word]
    from_deg = float(rest[1]) if rest[1:] else from_deg
    name = name.replace(":", "-")
    path, output = f"{folder}/{name}.json", f"{folder}/{name}-shaped.json"
    document = {"family": "miura", "rows": rows, "columns": columns, "panel_width_mm": PANEL_MM,
                "panel_height_mm": PANEL_MM, "zigzag_offset_mm": PANEL_MM / 2, "holes": "checkerboard-odd",
                "target": target, "design": {"from_deg": from_deg, "springs": {"stiffness_n_per_mm": 5, "rest_deg": 90}}}
    with open(path, "w", encoding="utf-8") as file:
        json.dump(document, file)
    begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    said = run(program, "shape", path, "--output", output, "--json", *more)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin
    if said.returncode:
        return print(f"| {name} | {said.stderr.strip()} |")
    said = json.loads(said.stdout)
    run(program, "export", output, "--format", "obj", "--step", "90", "--output", folder)
    points = read_obj(f"{folder}/{name}-shaped-090deg.obj")
    sides = sides_of(rows, columns)
    fitted = rms_and_max(best_fit(surface, points, sides))
    true = f"{rms_and_max(best_fit(meant, points, sides))[0]:.4f}" if meant else "–"
    w = np.sqrt(rows * columns) * PANEL_MM
    used = said["used_from_deg"]
    print(f"| {name} | {said['rms_mm']:.4f}, {said['max_mm']:.4f} | {said['rms_mm'] / w:.1e} | "
          f"{fitted[0]:.4f}, {fitted[1]:.4f} | {true} | {said['shift_max_mm']:.1f} | "
          f"{said['deploys_from_deg']:g}° | {f'{used:g}°' if used else '–'} | {said['sheets_folded']} | {seconds:.1f} |",
          flush=True)


def main(program, folder, *names):
    more = [word for word in names if word.startswith("-")]
    size = [word for word in names if word.endswith("x8") or word.endswith("x6")] or ["6x6"]
    names = [word for word in names if word not in more + size]
    rows, columns = map(int, size[0].split("x"))
    os.makedirs(folder, exist_ok=True)
    print("| target | rms, max mm | rms, widths | measured rms, max mm | from the surface meant, rms mm | shift, mm | "
          "monotone | used | sheets | s |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in names or targets(rows, columns):
        shaped(os.path.abspath(program), folder, name, rows, columns, more)


if __name__ == "__main__":
    main(*sys.argv[1:])
