"""Surfaces z = f(x, y) and distances of points from them, in numpy alone."""

import numpy as np


class Height:
    """A height by a formula, with its slopes by differences of complex steps: f takes arrays."""

    def __init__(self, f):
        self.f = f

    def at(self, x, y):
        step = 1e-30
        return (self.f(x, y), np.imag(self.f(x + 1j * step, y + 0j)) / step, np.imag(self.f(x + 0j, y + 1j * step)) / step)

    def distance(self, points):
        """Signed distances, positive above, and unit normals: Gauss and Newton's steps to each foot."""
        x, y = points[:, 0].copy(), points[:, 1].copy()
        for _ in range(200):
            z, by_x, by_y = self.at(x, y)
            # The nearest point of the tangent plane.
            along = (by_x * (points[:, 0] - x) + by_y * (points[:, 1] - y) - (points[:, 2] - z)) / (1 + by_x**2 + by_y**2)
            to_x, to_y = points[:, 0] - along * by_x - x, points[:, 1] - along * by_y - y
            x, y = x + to_x, y + to_y
            if max(abs(to_x).max(), abs(to_y).max()) < 1e-11:
                break
        z, by_x, by_y = self.at(x, y)
        normals = np.stack([-by_x, -by_y, np.ones_like(x)], axis=1) / np.sqrt(1 + by_x**2 + by_y**2)[:, None]
        feet = np.stack([x, y, z], axis=1)
        return np.einsum("vk,vk->v", points - feet, normals), normals


class Grid(Height):
    """Heights at nodes, rows along y, centred; Catmull and Rom's cubics along x, then y; beyond the rim straight on."""

    def __init__(self, spacing, heights):
        self.spacing = spacing
        padded = np.asarray(heights, float)
        self.rows, self.columns = padded.shape
        for _ in range(2):
            for _ in range(8):
                padded = np.vstack([2 * padded[0] - padded[1], padded, 2 * padded[-1] - padded[-2]])
            padded = padded.T
        self.padded = padded

    @staticmethod
    def cubic(p0, p1, p2, p3, t):
        """The value and slope of the cubic through p1 and p2 with slopes of their neighbours' chords."""
        m1, m2 = (p2 - p0) / 2, (p3 - p1) / 2
        c2, c3 = 3 * (p2 - p1) - 2 * m1 - m2, 2 * (p1 - p2) + m1 + m2
        return p1 + t * (m1 + t * (c2 + t * c3)), m1 + t * (2 * c2 + 3 * t * c3)

    def at(self, x, y):
        u, v = x / self.spacing + (self.columns - 1) / 2, y / self.spacing + (self.rows - 1) / 2
        i = np.clip(np.floor(u).astype(int), -6, self.columns + 4)  # no foot is farther off the rim
        j = np.clip(np.floor(v).astype(int), -6, self.rows + 4)
        lines = [self.cubic(*(self.padded[j + k + 7, i + m + 7] for m in range(4)), u - i) for k in range(4)]
        z, by_v = self.cubic(*(line[0] for line in lines), v - j)
        by_u, _ = self.cubic(*(line[1] for line in lines), v - j)
        return z, by_u / self.spacing, by_v / self.spacing


class Sphere:
    def __init__(self, radius):
        self.radius = radius

    def distance(self, points):
        away = points + [0, 0, self.radius]
        length = np.linalg.norm(away, axis=1)
        return length - self.radius, away / length[:, None]


class Cylinder:
    """Its axis along x."""

    def __init__(self, radius):
        self.sphere = Sphere(radius)

    def distance(self, points):
        return self.sphere.distance(points * [0, 1, 1])


def saddle(radius):
    return Height(lambda x, y: (x * x - y * y) / (2 * radius))


def helicoid(radius):
    return Height(lambda x, y: x * np.tan(y / radius))
