"""Distances of exported vertices from a surface: a pose and half a depth are fitted to them by Gauss and Newton's method."""

import itertools

import numpy as np


def read_obj(path):
    with open(path, encoding="utf-8") as file:
        return np.array([line.split()[1:4] for line in file if line.startswith("v ")], float)


def turn(about):
    """The rotation by |about| rad about it (Rodrigues)."""
    angle = np.linalg.norm(about)
    if angle == 0:
        return np.eye(3)
    k = np.cross(np.eye(3), about / angle)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def distances(surface, points, sides, rotation, move, half_depth):
    away, normals = surface.distance(points @ rotation.T + move)
    return away - sides * half_depth, normals


def begin(points, sides, flip, yaw):
    """The sheet's middle plane on z = 0, its middle at the origin, turned about z by yaw degrees."""
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle)
    normal = axes[2] if axes[2, 2] > 0 else -axes[2]
    x = np.array([1, 0, 0]) - normal[0] * normal
    x /= np.linalg.norm(x)
    rotation = np.array([x, np.cross(normal, x), normal])
    if flip:
        rotation = np.diag([1, -1, -1]) @ rotation
    rotation = turn(np.array([0, 0, np.deg2rad(yaw)])) @ rotation
    placed = (points - middle) @ rotation.T
    return rotation, -rotation @ middle, (placed[:, 2] * sides).mean()


def fit(surface, points, sides, rotation, move, half_depth):
    """The pose nearby with the least squares; damped steps (Levenberg), turns about the sheet's middle."""
    now, normals = distances(surface, points, sides, rotation, move, half_depth)
    damping = 1e-6
    for _ in range(300):
        placed = points @ rotation.T + move
        arms = placed - placed.mean(axis=0)
        by = np.hstack([np.cross(arms, normals) / 100, normals, -sides[:, None]])
        squares = by.T @ by
        change = -np.linalg.solve(squares + damping * np.trace(squares) / 7 * np.eye(7), by.T @ now)
        more = turn(change[:3] / 100)
        middle = placed.mean(axis=0)
        there = more @ rotation, more @ (move - middle) + middle + change[3:6], half_depth + change[6]
        after, turned = distances(surface, points, sides, *there)
        if after @ after < now @ now:
            is_last = now @ now - after @ after < 1e-13 * (now @ now)
            (rotation, move, half_depth), now, normals = there, after, turned
            damping = max(damping / 10, 1e-15)
            if is_last:
                break
        elif damping > 1e3:
            break
        else:
            damping *= 10
    return now, (rotation, move, half_depth)


def best_fit(surface, points, sides):
    """Distances in the best of eight poses: four turns about z, and both sides."""
    starts = itertools.product((False, True), (0, 90, 180, 270))
    return min((fit(surface, points, sides, *begin(points, sides, *start))[0] for start in starts), key=lambda d: d @ d)


def rms_and_max(away):
    return np.sqrt((away**2).mean()), abs(away).max()
