#!/usr/bin/env python3
"""Draws a sheet that deploys into a dome and self-folds into it, into search/manual/dome.svg, and the dome alone, for
readers who want no motion, into dome-still.svg: moving_picture.py

The sheet is what `misalign shape search/patterns/dome-6x6.json` makes; its exact motion from stowed to the dome, flat, and
back. The sphere is the target, in the pose of least squares. With the package `misalign` and NumPy.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "build/release/python"))  # where the build leaves it; an installed one comes first
import misalign  # noqa: E402

PROGRAM, PATTERN = shutil.which("misalign") or ROOT / "build/release/misalign", ROOT / "search/patterns/dome-6x6.json"
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


def frame(sheet, points, shape_mm, angle_deg, high):
    """Panels from back to front, and the angle below them."""
    panels = sorted(sheet.panels, key=lambda panel: points[panel, 2].mean())
    drawn = "".join(polygon(points[panel], f'fill="{shade(shape_mm[panel])}"') for panel in panels)
    return (f'<g stroke="{INK}" stroke-width=".7" stroke-linejoin="round">{drawn}</g>'
            f'<text x="{WIDE / 2:g}" y="{high + 18}" text-anchor="middle" font-size="14" fill="{INK}">'
            f"pilot angle {angle_deg:.0f}°</text>")


def shown_when(shown):
    """The animation that shows its group in these frames alone."""
    changes = [0] + [i for i in range(1, len(shown)) if shown[i] != shown[i - 1]]
    times = ";".join(f"{i / len(shown):.4f}" for i in changes)
    values = ";".join("inline" if shown[i] else "none" for i in changes)
    return (f'<animate attributeName="display" calcMode="discrete" dur="{len(shown) * FRAME_S:g}s" repeatCount="indefinite" '
            f'values="{values}" keyTimes="{times}"/>')


def write(name, high, sphere, inside):
    """A picture of the sheet on the sphere's lines, which also shine through it."""
    (ROOT / "search/manual" / name).write_text(f"""\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {high + 26}" width="{WIDE}" font-family="sans-serif">
<title>A sheet that rests on a sphere of radius {RADIUS_MM} mm, deployed and self-folded</title>
<g id="sphere" fill="none" stroke="{SURFACE}" stroke-opacity=".45" stroke-width="1">{sphere}</g>
{inside}
<use href="#sphere" opacity=".4"/>
</svg>
""", encoding="utf-8")


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
    lines = [grid[k] for k in range(13)] + [grid[:, k] for k in range(13)]
    sphere = "".join(f'<path d="M{"L".join(f"{x:.0f} {y:.0f}" for x, y in line[:, :2])}"/>' for line in lines)
    moments = [frame(sheet, put(seen[k]), shapes[k], asked[k], high) for k in range(len(asked))]
    write("dome.svg", high, sphere, "".join(
        f"""<g{'' if frames[0] == k else ' display="none"'}>{moment}{shown_when(frames == k)}</g>\n"""
        for k, moment in enumerate(moments)))
    write("dome-still.svg", high, sphere, moments[at_shape])


if __name__ == "__main__":
    main()
