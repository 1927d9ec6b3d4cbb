"""Kits of plates beside the folded sheets that they are cut for. Standard input has a line for each:

    SHEET.fold KIT.dxf --crease film|bevel|pin|offset --thickness T --from DEG [--barrel D] [--clearance C] [--film F]
    [--spacer S] [--joint-bore D] [--spring-bore D] [--edge E] [--wire W --play P] [--thicker T] [--wrong]

Plates are rebuilt from the drawing alone: contours, axes of hinges, lines and angles of bevels. They are laid into the
folded states of the FOLD file by their axes. No two plates or barrels may overlap there (separating axes of convex
pieces), and vertices of all plates must meet. Gaps are compared with fold angles by normals of the folded faces; bores
and tabs with the vertices of diagonals and ball joints, whose bores have the play of a wire. --thicker: plates of another thickness; --wrong: something must
be wrong. Prints what was measured, and ends with 1 if anything is wrong."""

import argparse
import itertools
import json
import math
import re
import sys

import numpy as np

from kit_drawing import Drawing, area, inside, turns_of
from stroke_reader import words_of

DEEP = 0.01  # mm of overlap: bores, arcs and rounding are drawn within 0.005
NEAR = 0.01  # mm
MISFIT = 0.05  # mm


def placed(points, targets):
    """Rotation and shift that lay points onto targets (least squares, no reflection), and the largest distance left."""
    a, b = np.mean(points, axis=0), np.mean(targets, axis=0)
    u, _, vt = np.linalg.svd((points - a).T @ (targets - b))
    flip = np.eye(len(a))
    flip[-1, -1] = np.sign(np.linalg.det(vt.T @ u.T))
    turn = vt.T @ flip @ u.T
    shift = b - turn @ a
    return turn, shift, np.abs(points @ turn.T + shift - targets).max()


def distance(point, p, q):
    point, p, q = map(np.asarray, (point, p, q))
    share = np.clip((point - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1)
    return float(np.linalg.norm(point - p - share * (q - p)))


def crossing(one, other):
    """The common point of two lines."""
    (p, q), (r, s) = np.array(one), np.array(other)
    along = np.linalg.solve(np.column_stack([q - p, r - s]), r - p)[0]
    return p + along * (q - p)


def clipped(ring, p, q, keep):
    """The part of a polygon on that side of a line on which `keep` lies."""
    p, d = np.asarray(p), np.asarray(q) - np.asarray(p)
    normal = np.array([-d[1], d[0]]) / np.linalg.norm(d)
    normal *= np.sign(normal @ (np.asarray(keep) - p))
    rest = []
    for a, b in zip(ring, ring[1:] + ring[:1]):
        u, v = normal @ (np.asarray(a) - p), normal @ (np.asarray(b) - p)
        if u >= 0:
            rest.append(tuple(a))
        if u * v < 0:
            rest.append(tuple(np.asarray(a) + u / (u - v) * (np.asarray(b) - np.asarray(a))))
    return rest


class Solid:
    """A convex piece: corners, and directions of its face normals and edges."""

    def __init__(self, corners, normals, edges):
        self.corners, self.normals, self.edges = (np.asarray(rows, dtype=float) for rows in (corners, normals, edges))

    def moved(self, turn, shift):
        return Solid(self.corners @ turn.T + shift, self.normals @ turn.T, self.edges @ turn.T)


def layered(levels):
    """The hull of polygons with the same number of corners at some heights."""
    corners, normals, edges = [], [(0, 0, 1)], []
    rings = [[(*p, z) for p in ring] for z, ring in levels]
    for ring in rings:
        corners += ring
        edges += [np.subtract(q, p) for p, q in zip(ring, ring[1:] + ring[:1])]
    for low, high in zip(rings, rings[1:]):
        for k, p in enumerate(low):
            q = low[(k + 1) % len(low)]
            up = np.subtract(high[k], p)
            edges.append(up)
            for along in (np.subtract(q, p), np.subtract(high[(k + 1) % len(low)], high[k])):
                normals.append(np.cross(along, up))
    return Solid(corners, unit(normals), unit(edges))


def unit(vectors):
    vectors = np.asarray(vectors, dtype=float)
    length = np.linalg.norm(vectors, axis=1)
    vectors = vectors[length > 1e-9] / length[length > 1e-9, None]
    return np.unique(np.round(vectors, 9), axis=0)


def overlap(a, b):
    """The least shift that separates two convex solids, mm; negative: they are apart."""
    if (a.corners.min(0) > b.corners.max(0)).any() or (b.corners.min(0) > a.corners.max(0)).any():
        return -1.0
    least = math.inf
    crossed = lambda: np.cross(a.edges[:, None, :], b.edges[None, :, :]).reshape(-1, 3)
    for axes in (lambda: a.normals, lambda: b.normals, crossed):
        directions = unit(axes())
        p, q = a.corners @ directions.T, b.corners @ directions.T
        least = min(least, np.minimum(p.max(0) - q.min(0), q.max(0) - p.min(0)).min())
        if least < -1e-9:
            return least
    return least


class Sheet:
    def __init__(self, path, from_deg):
        with open(path, encoding="utf8") as file:
            fold = json.load(file)
        self.flat = np.array(fold["vertices_coords"])
        row = sorted(fold["faces_vertices"][0])
        across = row[2] - row[0]
        self.faces = {}
        for face in fold["faces_vertices"]:
            face = face if area([tuple(self.flat[v]) for v in face]) > 0 else face[::-1]
            self.faces["r%dc%d" % divmod(min(face), across)] = face
        sides = {math.atan2(*(self.flat[q] - self.flat[p])[::-1]) % math.pi
                 for face in self.faces.values() for p, q in zip(face, face[1:] + face[:1])}
        self.directions = sorted({round(side, 2) for side in sides})
        self.letters = {frozenset(e): letter for e, letter in zip(fold["edges_vertices"], fold["edges_assignment"])}
        self.frames = [(0.0, np.hstack([self.flat, np.zeros((len(self.flat), 1))]))] + [
            (frame["misalign:pilot_deg"], np.array(frame["vertices_coords"])) for frame in fold["file_frames"]
            if frame["misalign:pilot_deg"] <= from_deg + 1e-6]
        assert abs(self.frames[-1][0] - from_deg) < 1e-6, f"no frame at {from_deg}"
        self.ends = {int(d[end][1:]) - 1 for d in fold["misalign:data"]["diagonals"] for end in ("from", "to")}

    def largest_fold(self, letter):
        """By normals of folded faces, radians."""
        def normal(at, face):
            n = np.cross(at[face[2]] - at[face[0]], at[face[3]] - at[face[1]])
            return n / np.linalg.norm(n)
        edges = {}
        for label, face in self.faces.items():
            for p, q in zip(face, face[1:] + face[:1]):
                edges.setdefault(frozenset((p, q)), []).append(label)
        self.shared = {edge: labels for edge, labels in edges.items() if len(labels) == 2}
        return max(math.acos(np.clip(normal(at, self.faces[a]) @ normal(at, self.faces[b]), -1, 1))
                   for edge, (a, b) in self.shared.items() if self.letters[edge] == letter for _, at in self.frames)


class Plate:
    def __init__(self, label, contour, drawing):
        self.label, self.contour = label, contour
        self.bores = [c for c in drawing.circles.get("bore", []) if inside(c[:2], contour)]
        self.axes, self.bevels = [], {"valley": [], "mountain": []}
        self.angles = [(t[:2], float(t[2][1:])) for t in drawing.texts.get("engrave", [])
                       if t[2][0] == "b" and inside(t[:2], contour)]

    def find(self, sheet):
        """Lays the drawn axes onto sides of its face; returns how far they miss. A plate that ball joints alone hold
        has no axes, but its whole sides: the four longest lines."""
        face = sheet.faces[self.label]
        if not self.axes:
            lines = list(zip(self.contour, self.contour[1:] + self.contour[:1]))
            long = sorted(sorted(range(len(lines)), key=lambda k: -math.dist(*lines[k]))[:4])
            corners = [crossing(lines[long[k - 1]], lines[long[k]]) for k in range(4)]
            fits = [(placed(np.array(corners), sheet.flat[face[k:] + face[:k]]), k) for k in range(4)]
            (self.turn, self.shift, off), _ = min(fits, key=lambda fit: fit[0][2])
            self.sides, self.vertices = (), []
            return off
        drawn = np.array([end for axis in self.axes for end in axis])
        best = (math.inf,)
        for sides in itertools.permutations(range(4), len(self.axes)):
            wanted = np.array([sheet.flat[face[(k + end) % 4]] for k in sides for end in (0, 1)])
            turn, shift, off = placed(drawn, wanted)
            best = min(best, (off, sides, turn, shift), key=lambda row: row[0])
        off, self.sides, self.turn, self.shift = best
        self.vertices = [face[k] for k in self.sides]
        return off

    def on_sheet(self, point):
        return tuple(self.turn @ np.asarray(point) + self.shift)


class Check:
    def __init__(self, wish):
        self.wish, self.faults = wish, []
        self.sheet = Sheet(wish.sheet, wish.from_deg)
        thickness = wish.thicker or wish.thickness
        # Heights of both faces over the axes.
        self.low, self.high = (wish.spacer, wish.spacer + thickness) if wish.crease == "offset" else (
            -thickness / 2, thickness / 2)
        drawing = Drawing(wish.kit)
        self.faults += drawing.faults
        contours = [points for points, closed in drawing.paths["cut"] if closed and area(points) > 0]
        drawing.texts["engrave"] = [word for ring in contours for word in self.words_in(drawing, ring)]
        self.plates = {}
        for x, y, words, _ in drawing.texts.get("engrave", []):
            if not re.fullmatch(r"r\d+c\d+", words):
                continue
            rings = [ring for ring in contours if inside((x, y), ring)]
            self.expect(len(rings) == 1, f"{words} lies in {len(rings)} contours")
            self.plates[words] = Plate(words, rings[0], drawing)
        self.expect(set(self.plates) == set(self.sheet.faces) and len(contours) == len(self.plates),
                    "plates are not the sheet's panels")
        for points, _ in drawing.paths.get("hinge", []):
            self.nearest(points).axes.append(points)
        for kind in ("valley", "mountain"):
            for points, _ in drawing.paths.get(f"score_{kind}", []):
                self.nearest(points).bevels[kind].append(points)

    def words_in(self, drawing, ring):
        """What is engraved in a contour, read at the turn at which most of it is a label."""
        paths = [path for path in drawing.paths["engrave"] if inside(path[0][0], ring)]
        turns = turns_of(ring, self.sheet.directions)
        if len(turns) < 2:  # trimmed corners are as long as sides
            turns = np.arange(0, 2 * math.pi, 0.04)
        readings = [list(words_of(paths, [turn])) for turn in turns]
        own = lambda words: sum(word[2] in self.sheet.faces for word in words)
        corners = lambda words: max((sum(f"A{v + 1}" in {w[2] for w in words} for v in self.sheet.faces[word[2]])
                                     for word in words if word[2] in self.sheet.faces), default=0)
        others = lambda words: sum(bool(re.fullmatch(r"[Abs]\d+", word[2])) for word in words)
        return max(readings, key=lambda words: (own(words) == 1, corners(words), own(words) + 2 * others(words) - len(words)), default=[])

    def expect(self, good, words):
        if not good:
            self.faults.append(words)

    def nearest(self, points):
        """The plate with both ends of a line nearest to its contour."""
        return min(self.plates.values(), key=lambda plate: sum(min(
            distance(np.add(np.multiply(points[0], 1 - s), np.multiply(points[1], s)), p, q)
            for p, q in zip(plate.contour, plate.contour[1:] + plate.contour[:1])) for s in (0.3, 0.5, 0.7)))

    def run(self):
        off = max(plate.find(self.sheet) for plate in self.plates.values())
        self.expect(off < NEAR, f"axes lie {off:.4f} mm off the panels' sides")
        if self.faults:
            return
        self.contours()
        self.fittings()
        pieces = {label: self.pieces(plate) for label, plate in self.plates.items()}
        misfit, deepest = 0.0, (-math.inf, "", 0)
        for deg, at in self.sheet.frames:
            places = {}
            seen = {}
            for label, plate in self.plates.items():
                face = self.sheet.faces[label]
                flat = np.hstack([self.sheet.flat[face], np.zeros((4, 1))])
                turn, shift, _ = placed(flat, at[face])
                places[label] = (turn, shift)
                for axis, k in zip(plate.axes, plate.sides):
                    for end, v in zip(axis, (face[k], face[(k + 1) % 4])):
                        seen.setdefault(v, []).append(turn @ np.array([*plate.on_sheet(end), 0]) + shift)
            misfit = max([misfit] + [np.linalg.norm(p - q) for points in seen.values()
                                     for p, q in itertools.combinations(points, 2)])
            bodies = [(label, piece.moved(*places[label])) for label, rows in pieces.items() for piece in rows]
            bodies += [("+".join(labels), barrel.moved(*places[labels[0]])) for labels, barrel in self.barrels()]
            for (a, one), (b, other) in itertools.combinations(bodies, 2):
                if a == b:
                    continue
                depth = overlap(one, other)
                if depth > deepest[0]:
                    deepest = (depth, f"{a} and {b}", deg)
        self.expect(misfit < MISFIT, f"vertices miss by {misfit:.4f} mm")
        self.expect(deepest[0] < DEEP, f"{deepest[1]} overlap by {deepest[0]:.4f} mm at {deepest[2]:g} deg")
        print(f"{self.wish.kit}: {len(self.plates)} plates, {len(self.sheet.frames)} states up to {deg:g} deg; axes "
              f"within {off:.1e} mm, vertices within {misfit:.1e} mm, deepest overlap {deepest[0]:.1e} mm")

    def axis_of(self, plate, k):
        """The ends of an axis on the drawing, and the unit vector from it into the plate."""
        p, q = (np.asarray(end) for end in plate.axes[k])
        d = (q - p) / np.linalg.norm(q - p)
        return p, q, np.array([-d[1], d[0]])

    def back(self, plate, k):
        """The distance of the contour's side from an axis: of its longest line that is parallel to it."""
        p, _, inwards = self.axis_of(plate, k)
        best = (0, 0)
        for a, b in zip(plate.contour, plate.contour[1:] + plate.contour[:1]):
            u, v = inwards @ (np.asarray(a) - p), inwards @ (np.asarray(b) - p)
            if abs(u - v) < 1e-4 and math.dist(a, b) > best[0] and u < 0.25 * math.dist(*plate.axes[k]):
                best = (math.dist(a, b), u)
        return best[1]

    def contours(self):
        """Gaps by the sharpest fold of each kind; angles of bevels."""
        wish = self.wish
        for letter, kind in (("M", "mountain"), ("V", "valley")):
            half = self.sheet.largest_fold(letter) / 2
            wanted = {"film": (max(wish.thickness * math.tan(half), wish.film) + wish.clearance) / 2,
                      "bevel": wish.clearance / 2,
                      "pin": max(wish.barrel, wish.thickness / math.cos(half)) / 2 + wish.clearance,
                      "offset": wish.clearance / 2 + (wish.spacer + wish.thickness) * math.tan(half) * (letter == "V"),
                      }[wish.crease]
            for plate in self.plates.values():
                face = self.sheet.faces[plate.label]
                for k, side in enumerate(plate.sides):
                    if self.sheet.letters[frozenset((face[side], face[(side + 1) % 4]))] != letter:
                        continue
                    back = self.back(plate, k)
                    self.expect(abs(back - wanted) < NEAR, f"{plate.label}: {back:.4f} mm off a {kind}, not {wanted:.4f}")
                if wish.crease == "bevel":
                    sides = [self.sheet.letters[frozenset((face[s], face[(s + 1) % 4]))] for s in plate.sides]
                    self.expect(len(plate.bevels[kind]) == sides.count(letter), f"{plate.label}: bevels of {kind}s")
            if wish.crease == "bevel":
                self.angle = getattr(self, "angle", {}) | {kind: math.ceil(math.degrees(half) - 1e-3)}
        if wish.crease != "bevel":
            return
        for plate in self.plates.values():
            engraved = sorted(angle for _, angle in plate.angles)
            wanted = sorted(self.angle[kind] for kind in plate.bevels for _ in plate.bevels[kind])
            self.expect(engraved == wanted, f"{plate.label}: angles {engraved}, not {wanted}")

    def fittings(self):
        """Bores of tabs on their vertices, of ball joints in both panels, and material round all of them."""
        wish = self.wish
        at = {v: [label for label, face in self.sheet.faces.items() if v in face] for v in self.sheet.ends}
        joined = {frozenset(labels) for labels in self.sheet.shared.values()}
        tabs = bores = 0
        for v, labels in at.items():
            whole = any(frozenset(pair) in joined for pair in itertools.combinations(labels, 2))
            here = [(label, math.dist(self.plates[label].on_sheet(c[:2]), self.sheet.flat[v]), 2 * c[2])
                    for label in labels for c in self.plates[label].bores]
            if whole and wish.spring_bore:
                across = max(labels, key=lambda a: sum(frozenset((a, b)) in joined for b in labels))
                good = [row for row in here if row[0] == across and row[1] < NEAR and
                        abs(row[2] - wish.spring_bore) < NEAR]
                self.expect(len(good) == 1, f"A{v + 1} has no tab with a bore on {across}")
                tabs += 1
            if not whole and wish.joint_bore:
                for label in labels:
                    good = [row for row in here if row[0] == label and abs(row[2] - wish.joint_bore) < NEAR and row[1] < 20]
                    self.expect(len(good) >= 1, f"A{v + 1} has no bore of a ball joint on {label}")
                    bores += 1
        if wish.play:
            play = max(self.play(v, labels) for v, labels in at.items()
                       if not any(frozenset(pair) in joined for pair in itertools.combinations(labels, 2)))
            self.expect(abs(play - wish.play) < NEAR, f"ball joints have a play of {play:.3f} mm, not {wish.play} mm")
            print(f"{wish.kit}: play of ball joints {play:.3f} mm")
        for plate in self.plates.values():
            for x, y, r in plate.bores:
                left = min(distance((x, y), p, q) for p, q in zip(plate.contour, plate.contour[1:] + plate.contour[:1])) - r
                self.expect(left > wish.edge - 2 * NEAR, f"{plate.label}: {left:.3f} mm of material at a bore")
        if wish.spring_bore or wish.joint_bore:
            print(f"{wish.kit}: {tabs} tabs, {bores} bores of ball joints")

    def play(self, v, labels):
        """The play of a loop of wire: how far its bores approach each other, and the wire's clearance."""
        apart = []
        for _, at in self.sheet.frames:
            ends = []
            for label in labels:
                face, plate = self.sheet.faces[label], self.plates[label]
                turn, shift, _ = placed(np.hstack([self.sheet.flat[face], np.zeros((4, 1))]), at[face])
                bore = min(plate.bores, key=lambda c: math.dist(plate.on_sheet(c[:2]), self.sheet.flat[v]))
                ends.append(turn @ np.array([*plate.on_sheet(bore[:2]), 0]) + shift)
            apart.append(np.linalg.norm(ends[0] - ends[1]))
        return max(apart) - min(apart) + self.wish.joint_bore - self.wish.wire

    def pieces(self, plate):
        """Convex pieces: the panel without its tabs, between its bevelled faces, and the discs of tabs."""
        ring = [plate.on_sheet(p) for p in plate.contour]
        discs = []
        for x, y, r in ((*plate.on_sheet(b[:2]), b[2]) for b in plate.bores):
            near = [p for p in ring if math.dist(p, (x, y)) < 3 * r + 20]
            radius = min((math.dist(p, (x, y)) for p in near), default=0)
            arc = [p for p in ring if abs(math.dist(p, (x, y)) - radius) < 1e-3]
            if len(arc) > 8:
                discs.append(((x, y), radius))
        solids = []
        flat = ring
        for (x, y), radius in discs:
            flat = [p for p in flat if math.dist(p, (x, y)) > radius + 1e-3]
            turns = [2 * math.pi * k / 32 for k in range(32)]
            disc = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in turns]
            solids.append(layered([(self.low, disc), (self.high, disc)]))
        if discs:
            # Sides of the contour go on to where they meet.
            face = self.sheet.faces[plate.label]
            flat = [tuple(self.sheet.flat[v]) for v in face]
            middle = np.mean(flat, axis=0)
            long = [(p, q) for p, q in zip(ring, ring[1:] + ring[:1]) if math.dist(p, q) > 3]
            for p, q in long:
                flat = clipped(flat, p, q, middle)
        middle = np.mean(flat, axis=0)
        faces = {}
        for kind in ("mountain", "valley"):
            rest = flat
            for p, q in plate.bevels[kind]:
                rest = clipped(rest, plate.on_sheet(p), plate.on_sheet(q), middle)
            faces[kind] = rest
        hull = [(self.low, faces["mountain"]), (0.0, flat), (self.high, faces["valley"])]
        return solids + self.halves(hull, plate)

    def halves(self, hull, plate):
        """The plate as two convex halves, whose faces are all its directions."""
        if self.wish.crease != "bevel":
            return [layered([hull[0], hull[2]])]
        solids = []
        for one, other in zip(hull, hull[1:]):
            corners = [(*p, z) for z, ring in (one, other) for p in ring]
            normals, edges = [(0, 0, 1)], [(0, 0, 1)]
            for _, ring in (one, other):
                for p, q in zip(ring, ring[1:] + ring[:1]):
                    d = np.subtract(q, p)
                    edges.append((*d, 0))
                    normals.append((d[1], -d[0], 0))
            kind = "mountain" if one[0] < 0 else "valley"
            lean = math.radians(self.angle[kind])
            for p, q in plate.bevels[kind]:
                d = np.subtract(plate.on_sheet(q), plate.on_sheet(p))
                d /= np.linalg.norm(d)
                outwards = np.array([d[1], -d[0]])
                normals += [(*(s * math.cos(lean) * outwards), t * math.sin(lean)) for s in (1, -1) for t in (1, -1)]
            for p in one[1]:  # from corner to corner of both faces
                q = min(other[1], key=lambda q: math.dist(p, q))
                edges.append((q[0] - p[0], q[1] - p[1], other[0] - one[0]))
            for q in other[1]:
                p = min(one[1], key=lambda p: math.dist(p, q))
                edges.append((q[0] - p[0], q[1] - p[1], other[0] - one[0]))
            solids.append(Solid(corners, unit(normals), unit(edges)))
        return solids

    def barrels(self):
        """Cylinders round the axes of pins, as long as the sides of both plates beside them."""
        if self.wish.crease != "pin":
            return
        for edge, labels in self.sheet.shared.items():
            spans = []
            for label in labels:
                plate, face = self.plates[label], self.sheet.faces[label]
                k = next(k for k, side in enumerate(plate.sides) if {face[side], face[(side + 1) % 4]} == set(edge))
                p, q, inwards = self.axis_of(plate, k)
                back = self.back(plate, k)
                along = (q - p) / np.linalg.norm(q - p)
                ends = [along @ (np.asarray(c) - p) for c in plate.contour if abs(inwards @ (np.asarray(c) - p) - back) < 1e-3]
                points = [np.array(plate.on_sheet(p + s * along)) for s in (min(ends), max(ends))]
                spans.append(points)
            (a, b), others = spans[0], spans[1]
            along = (b - a) / np.linalg.norm(b - a)
            low = max(0, min(along @ (p - a) for p in others))
            high = min(along @ (b - a), max(along @ (p - a) for p in others))
            side = np.array([-along[1], along[0]])
            radius = self.wish.barrel / 2
            ring = [radius * (math.cos(t) * np.array([*side, 0]) + math.sin(t) * np.array([0, 0, 1]))
                    for t in (2 * math.pi * k / 24 for k in range(24))]
            ends = [np.array([*(a + s * along), 0]) for s in (low, high)]
            corners = [end + r for end in ends for r in ring]
            edges = [q - p for p, q in zip(ring, ring[1:] + ring[:1])] + [(*along, 0)]
            normals = [p + q for p, q in zip(ring, ring[1:] + ring[:1])] + [(*along, 0)]
            yield labels, Solid(corners, unit(normals), unit(edges))


def main():
    words, bad = argparse.ArgumentParser(), False
    words.add_argument("sheet")
    words.add_argument("kit")
    words.add_argument("--crease")
    words.add_argument("--from", type=float, dest="from_deg")
    for name in ("--thickness", "--barrel", "--clearance", "--film", "--spacer", "--joint-bore", "--spring-bore", "--thicker", "--wire", "--play"):
        words.add_argument(name, type=float, default=0)
    words.add_argument("--edge", type=float, default=2)
    words.add_argument("--wrong", action="store_true")
    for line in sys.stdin:
        check = Check(words.parse_args(line.split()))
        check.run()
        faults = check.faults
        if check.wish.wrong:
            faults = [] if faults else ["what is wrong goes unseen"]
        for fault in faults[:20]:
            print(f"{line.strip()}: {fault}")
        bad = bad or bool(faults)
    sys.exit(bad)


main()
