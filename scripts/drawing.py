#!/usr/bin/env python3
"""Draws what the program searches for, into search/manual/concept.svg: drawing.py

One sheet of 4 x 4 panels, flat, on the way and folded, as its exact motion goes. Its shifts are ten times those of the
campaign that it is from, so that they can be seen. With the package `misalign` and NumPy.
"""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "build/release/python"))  # where the build leaves it; an installed one comes first
import misalign  # noqa: E402

DRAW, FACTOR = 1112, 10
ANGLES_DEG = (0, 60, 110)
TITLES = ("flat", "on the way", "folded")
WIDTH, HEIGHT = 960, 330
GROWS, SHRINKS, PILOT, INK, PALE = "#1f6fb2", "#c0392b", "#d98200", "#222222", "#8a8a8a"


def view(points):
    """Seen from the front and above: x to the right, height upwards, and how near a point is."""
    turn, rise = np.radians(168), np.radians(50)  # diagonals that grow do so in the picture too
    x = points[:, 0] * np.cos(turn) - points[:, 1] * np.sin(turn)
    y = points[:, 0] * np.sin(turn) + points[:, 1] * np.cos(turn)
    return np.column_stack([x, -(y * np.sin(rise) + points[:, 2] * np.cos(rise)),
                            points[:, 2] * np.sin(rise) - y * np.cos(rise)])


def path(points, closed=False):
    return "M" + "L".join(f"{x:.1f},{y:.1f}" for x, y in points[:, :2]) + ("Z" if closed else "")


def spring(a, b, turns=7, wide=3.5):
    """A zigzag from a to b."""
    along = (b - a)[:2] / np.hypot(*(b - a)[:2])
    across = np.array([-along[1], along[0]])
    at = np.linspace(0.12, 0.88, 2 * turns + 1)
    side = np.where(np.arange(len(at)) % 2, 1, -1) * wide
    side[[0, -1]] = 0
    inner = a[:2] + at[:, None] * (b - a)[:2] + side[:, None] * across
    return path(np.vstack([a[:2], inner, b[:2]]))


def text(x, y, words, size=13, fill=INK, anchor="middle", more=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{fill}" text-anchor="{anchor}"{more}>'
            f"{words}</text>")


def shade(corners):
    """A facet is lighter the more it faces up and left."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    light = abs(normal @ np.array([-0.45, -0.35, 0.82])) / np.linalg.norm(normal)
    level = int(165 + 70 * min(light, 1))
    return f"#{level:02x}{level:02x}{level - 12:02x}"


def state(sheet, points, grows, origin):
    """One state of the sheet: panels from far to near, then pilot, springs and corners of the holes."""
    seen = view(points)
    seen[:, :2] += origin - (seen[:, :2].max(0) + seen[:, :2].min(0)) / 2
    kept = [facet for number, facet in enumerate(sheet.facets) if number not in sheet.holes]
    out = [f'<path d="{path(seen[facet], True)}" fill="{shade(points[facet])}" stroke="{INK}" stroke-width="1" '
           'stroke-linejoin="round"/>' for facet in sorted(kept, key=lambda facet: seen[facet, 2].mean())]
    out.append(f'<path d="{path(seen[sheet.creases[sheet.pilot]])}" stroke="{PILOT}" stroke-width="4.5" '
               'stroke-linecap="round"/>')
    for (a, b), longer in zip(sheet.diagonals, grows):
        out.append(f'<path d="{spring(seen[a], seen[b])}" fill="none" stroke="{GROWS if longer else SHRINKS}" '
                   'stroke-width="1.8" stroke-linejoin="round"/>')
    for vertex in np.unique(sheet.facets[sheet.holes]):
        out.append(f'<circle cx="{seen[vertex, 0]:.1f}" cy="{seen[vertex, 1]:.1f}" r="3" fill="{INK}"/>')
    return out, seen


def chart(folding, grows, left, top, wide, high):
    """Elongation of each diagonal against the pilot angle, up to where the pictures end."""
    up_to = folding.pilot_deg <= ANGLES_DEG[-1]
    percent = 100 * (folding.length_mm / folding.flat_mm - 1)[up_to]
    bound = np.abs(percent).max() * 1.08
    at = np.column_stack([left + wide * folding.pilot_deg[up_to] / ANGLES_DEG[-1]])
    out = [f'<path d="M{left},{top}V{top + high}M{left},{top + high / 2}H{left + wide}" stroke="{PALE}"/>']
    for column, longer in zip(percent.T, grows):
        line = np.column_stack([at, top + high / 2 * (1 - column / bound)])[::4]
        out.append(f'<path d="{path(line)}" fill="none" stroke="{GROWS if longer else SHRINKS}" stroke-width="2"/>')
    for angle in ANGLES_DEG:
        out.append(text(left + wide * angle / ANGLES_DEG[-1], top + high + 16, f"{angle}°", 12, PALE))
    out += [text(left + 8, top + 12, "longer", 12, GROWS, "start"),
            text(left + 8, top + high - 6, "shorter", 12, SHRINKS, "start"),
            text(left + wide / 2, top + high + 34, "pilot angle", 12, PALE)]
    return out


def main():
    campaign = misalign.read(ROOT / "search/campaigns/miura-4x4.json")
    sheet = campaign.pattern
    shifts_mm = FACTOR * campaign.shifts([DRAW])[0]
    folding = sheet.fold(shifts_mm=shifts_mm)
    assert folding.deploys_from_deg >= ANGLES_DEG[-1]
    states = sheet.fold(ANGLES_DEG, shifts_mm)
    grows = states.length_mm[-1] > states.flat_mm
    scale = 0.57
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif">',
           "<title>A sheet with two holes, flat, on the way and folded, and the lengths of its four diagonals"
           "</title>", f'<rect width="{WIDTH}" height="{HEIGHT}" rx="8" fill="#ffffff"/>']
    for number, (angle, title) in enumerate(zip(ANGLES_DEG, TITLES)):
        origin = np.array([140 + 246 * number, 160])
        drawn, seen = state(sheet, scale * states.vertices_mm[number], grows, origin)
        out += drawn
        out.append(text(origin[0], 30, title, 15))
        out.append(text(origin[0], HEIGHT - 16, f"pilot angle {angle}°", 12, PALE))
        if number == 0:
            pilot = seen[sheet.creases[sheet.pilot], :2].mean(0)
            out.append(text(pilot[0] + 22, pilot[1] - 26, "pilot crease", 12, PILOT))
            x, y = seen[sheet.facets[sheet.holes].reshape(-1), :2].max(0)  # the corner farthest to the right
            out += [f'<path d="M{x - 24:.1f},{y - 4:.1f}L{x - 4:.1f},{y + 56:.1f}" stroke="{INK}" stroke-width="0.8"/>',
                    text(x - 6, y + 70, "hole, four corners", 12)]
    out.append(text(842, 30, "the diagonals", 15))
    out += chart(folding, grows, 752, 60, 180, 200)
    (ROOT / "search/manual/concept.svg").write_text("\n".join([*out, "</svg>"]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
