#!/usr/bin/env python3
"""Shapes of miscut copies where they stop, with `import misalign` on PYTHONPATH:

    miscut_shapes.py PATTERN RADIUS_MM [COPIES]

Springs are cut for the sheet as drawn, relaxed at its angle of rest; a copy stops where their energy is least. Its vertices
are compared with a sphere, by a fit of pose and depth that shares no code with the program, and with the drawn sheet's."""

import sys

import misalign
import numpy as np
from misfit import begin, fit, rms_and_max
from surfaces import Sphere

MISCUT_MM, HALF_BAND_DEG, STEP_DEG = 0.1, 15, 0.25


def sides_of(pattern):
    """Heights of the base's vertices in half depths, by its inner vertices' two levels."""
    points = pattern.fold([90], np.zeros_like(pattern.shifts_mm)).vertices_mm[0]
    inner = np.array(pattern.interior)
    rotation, move, _ = begin(points[inner], np.ones(len(inner)), False, 0)
    heights = (points @ rotation.T + move)[:, 2]
    level = abs(heights[inner] - heights[inner].mean()).mean()
    return np.round((heights - heights[inner].mean()) / level)


def moved_onto(points, to):
    """Distances after the rigid motion that fits best (Kabsch)."""
    a, b = points - points.mean(axis=0), to - to.mean(axis=0)
    u, _, v = np.linalg.svd(a.T @ b)
    return np.linalg.norm(a @ u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v - b, axis=1)


def main(path, radius_mm, copies=1000):
    pattern = misalign.read(path)
    rest_deg = pattern.design["springs"]["rest_deg"]
    stations = np.arange(rest_deg - HALF_BAND_DEG, rest_deg + HALF_BAND_DEG + STEP_DEG / 2, STEP_DEG)
    drawn = pattern.fold([rest_deg])
    sides = sides_of(pattern)
    sphere = Sphere(float(radius_mm))
    random = np.random.default_rng(1)
    found, held = [], 0
    for _ in range(int(copies)):
        errors = random.uniform(-MISCUT_MM, MISCUT_MM, pattern.shifts_mm.shape)
        folded = pattern.fold(stations, pattern.shifts_mm + errors)
        energy = ((folded.length_mm - drawn.length_mm) ** 2).sum(axis=1)
        k = int(np.nanargmin(energy))
        if k in (0, len(stations) - 1) or not np.isfinite(energy[k - 1 : k + 2]).all():
            held += 1
            continue
        below, at, above = energy[k - 1 : k + 2]
        share = (below - above) / (2 * (below - 2 * at + above))
        weights = np.array([share * (share - 1) / 2, 1 - share**2, share * (share + 1) / 2])
        points = np.einsum("s,svk->vk", weights, folded.vertices_mm[k - 1 : k + 2])
        away = min((fit(sphere, points, sides, *begin(points, sides, flip, 0))[0] for flip in (False, True)),
                   key=lambda d: d @ d)
        rms, largest = rms_and_max(away)
        found.append((stations[k] + share * STEP_DEG, rms, largest, moved_onto(points, drawn.vertices_mm[0]).max()))
    found = np.array(found)
    print(f"{len(found)} copies stop, {held} do not, or more than {HALF_BAND_DEG} deg off")
    for name, values in zip(("stop, deg", "rms, mm", "largest distance, mm", "largest from its place, mm"), found.T):
        print(f"{name:28}", *(f"{q} %: {np.percentile(values, q):.3f}" for q in (5, 50, 95, 100)))


if __name__ == "__main__":
    main(*sys.argv[1:])
