#!/usr/bin/env python3
"""Draws a sheet that deploys into a dome and self-folds into it, into search/manual/dome.svg: moving_picture.py

The sheet is what `misalign shape search/patterns/dome-6x6.json` makes; its exact motion from stowed to the dome, flat, and
back. The sphere is the target, in the pose of least squares. With the package `misalign` and NumPy.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "build/release/python"))  # where the build leaves it; an installed one comes first
import misalign  # noqa: E402

PROGRAM, PATTERN = ROOT / "build/release/misalign", ROOT / "search/patterns/dome-6x6.json"
RADIUS_MM, SHAPE_DEG, HOLD, FRAME_S = 1440, 90, 12, 1 / 12
WIDE = 640
INK, SURFACE = "#222222", "#4a90d9"


def eased(start_deg, end_deg, frames):
    """Angles that start and end slowly."""
    return start_deg + (end_deg - start_deg) * (1 - np.cos(np.pi * np.arange(frames) / (frames - 1))) / 2


def laid_on(points, places):
    """Moved to where they fit other points best (Kabsch 1976), with their middle at zero."""
    middle, place = points.mean(axis=0), places.mean(axis=0)
    u, _, v = np.linalg.svd((points - middle).T @ (places - place))
    turn = u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    return (points - middle) @ turn


def view(points):
    """Seen from the front and above: x to the right, height downwards on the page, and how near a point is."""
    turn, rise = np.radians(-28), np.radians(32)
    x = points[..., 0] * np.cos(turn) - points[..., 1] * np.sin(turn)
    y = points[..., 0] * np.sin(turn) + points[..., 1] * np.cos(turn)
    return np.stack([x, -(y * np.sin(rise) + points[..., 2] * np.cos(rise)), points[..., 2] * np.sin(rise) - y * np.cos(rise)],
                    axis=-1)


def shade(corners):
    """A facet is lighter the more it faces up and left."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    level = int(150 + 90 * min(abs(normal @ np.array([-0.5, -0.3, 0.8])) / np.linalg.norm(normal), 1))
    return f"#{level:02x}{level:02x}{level - 14:02x}"


def polygon(corners, style):
    return f'<path d="M{"L".join(f"{x:.0f} {y:.0f}" for x, y in corners[:, :2])}Z" {style}/>'


def main():
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "dome.json"
        said = json.loads(subprocess.run([PROGRAM, "shape", PATTERN, "--json", "--output", made], check=True, capture_output=True,
                                         text=True).stdout)
        sheet = misalign.read(str(made))
    stowed = said["used_from_deg"]
    angles = np.concatenate([eased(stowed, SHAPE_DEG, 14), np.full(HOLD, SHAPE_DEG), eased(SHAPE_DEG, 1, 26), np.full(4, 1.0),
                             eased(1, SHAPE_DEG, 26), np.full(HOLD, SHAPE_DEG), eased(SHAPE_DEG, stowed, 14)])
    asked, frames = np.unique(np.round(angles, 3), return_inverse=True)
    shapes = np.asarray(sheet.fold(asked).vertices_mm)
    flat = np.column_stack([np.asarray(sheet.vertices_mm), np.zeros(len(shapes[0]))])
    at_shape = int(np.argmin(abs(asked - SHAPE_DEG)))
    dome = laid_on(shapes[at_shape], flat)
    outward = (dome[:, :2] ** 2).sum(axis=1)
    if dome[:, 2] @ (outward - outward.mean()) > 0:
        dome = dome * np.array([1, -1, -1])  # the apex above the rim
    # The sphere in the middle between the two levels, by least squares of height and tilt; the sheet is tilted back.
    bulge = np.sqrt(RADIUS_MM**2 - (dome[:, :2] ** 2).sum(axis=1)) - RADIUS_MM
    tilt = np.linalg.lstsq(np.column_stack([dome[:, :2], np.ones(len(dome))]), dome[:, 2] - bulge, rcond=None)[0]
    dome = laid_on(dome, np.column_stack([dome[:, :2], dome[:, 2] - dome[:, :2] @ tilt[:2]]))
    shapes = np.array([laid_on(points, dome) for points in shapes])
    height = (dome[:, 2] - bulge).mean()
    half = 1.06 * abs(dome[:, :2]).max(axis=0)
    x, y = np.meshgrid(np.linspace(-half[0], half[0], 13), np.linspace(-half[1], half[1], 13))
    surface = np.stack([x, y, np.sqrt(RADIUS_MM**2 - x**2 - y**2) - RADIUS_MM + height], axis=-1)

    seen = [view(points) for points in shapes]
    corners = np.concatenate([points[:, :2] for points in seen])
    least, most = corners.min(axis=0) - 12, corners.max(axis=0) + 12
    scale = WIDE / (most - least)[0]
    high = round((most - least)[1] * scale)
    put = lambda points: np.concatenate([(points[..., :2] - least) * scale, points[..., 2:]], axis=-1)  # noqa: E731
    grid = put(view(surface))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {high + 26}" width="{WIDE}" font-family="sans-serif">',
           f"<title>A sheet that rests on a sphere of radius {RADIUS_MM} mm, deployed and self-folded</title>"]
    lines = [grid[k] for k in range(13)] + [grid[:, k] for k in range(13)]
    drawn = "".join(f'<path d="M{"L".join(f"{x:.0f} {y:.0f}" for x, y in line[:, :2])}"/>' for line in lines)
    out.append(f'<g id="sphere" fill="none" stroke="{SURFACE}" stroke-opacity=".45" stroke-width="1">{drawn}</g>')
    seconds = len(frames) * FRAME_S
    for k in range(len(asked)):
        shown = [frame == k for frame in frames]
        changes = [0] + [i for i in range(1, len(shown)) if shown[i] != shown[i - 1]]
        times = ";".join(f"{i / len(shown):.4f}" for i in changes)
        values = ";".join("inline" if shown[i] else "none" for i in changes)
        points = put(seen[k])
        panels = sorted(sheet.panels, key=lambda panel: points[panel, 2].mean())
        hidden = "" if shown[0] else ' display="none"'
        out.append(f"<g{hidden} stroke=\"{INK}\" stroke-width=\".7\" stroke-linejoin=\"round\">"
                   + "".join(polygon(points[panel], f'fill="{shade(shapes[k][panel])}"') for panel in panels)
                   + f'<text x="{WIDE / 2}" y="{high + 18}" text-anchor="middle" font-size="14" fill="{INK}" stroke="none">'
                   f"pilot angle {asked[k]:.0f}°</text>"
                   f'<animate attributeName="display" calcMode="discrete" dur="{seconds:g}s" repeatCount="indefinite" '
                   f'values="{values}" keyTimes="{times}"/></g>')
    (ROOT / "search/manual/dome.svg").write_text("\n".join([*out, '<use href="#sphere" opacity=".4"/>', "</svg>"]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
