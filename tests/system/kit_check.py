"""Kits to cut beside the sheet that they are cut from, as the FOLD export has it. Standard input has a line for each:

    SHEET.fold [--kerf K] [--crease score|cut|dash] [--dash CUT BRIDGE] [--joint-bore D] [--spring-bore D]
    [--spring-at vertex|panel] [--attached] [--point VERTEX PANEL]... [--against N] [--edge E] [--bed W H] [--units in] [--from DEG] [--grain] [--plain] [--wrong] [--numbers] [--turned] KIT...
    [--spoil HOW...]

The files are one kit, drawings and its page. Prints what is wrong, and ends with 1 if anything is. --wrong: something must be; --spoil: one
thing is spoilt first, and must be seen; --plain: only that DXF and SVG are one drawing; --numbers: also what was
measured; --turned: some part must be; --grain: all lie along the sheet's first side; --against: so many springs must contradict the verdict; --attached: that is about the springs as the pattern
attaches them, and not about its diagonals; --point: on this panel one has a point of its own. Geometry is its own: shoelace, distances of parallel
lines; springs by the drawn bores, placed in the folded panels of the sheet's frames (one for each degree)."""

import argparse
import itertools
import json
import math
import random
import re
import sys

from kit_drawing import Drawing, area, inside, turns_of
from kit_page import Page

NEAR = 0.01  # mm, of what the issue asks
STILL = 5e-6  # mm: a length that varies by less is constant; SVG has six decimals
SLOT = 1  # mm, as it is drawn, between a tab and the panels beside it
CUTS = ("cut", "opening", "slit", "score_mountain", "score_valley", "dash_mountain", "dash_valley")


def sides(points, closed=True):
    return list(zip(points, points[1:] + points[:1] if closed else points[1:]))


def beyond(point, p, q):
    """How far a point lies to the left of a line."""
    length = math.dist(p, q)
    return ((q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0])) / length


def cross_each_other(a, b, c, d):
    return beyond(c, a, b) * beyond(d, a, b) < -1e-12 and beyond(a, c, d) * beyond(b, c, d) < -1e-12


def crossing(a, b, c, d):
    """Where the lines of two sides meet."""
    u, v = (b[0] - a[0], b[1] - a[1]), (d[0] - c[0], d[1] - c[1])
    turn = u[0] * v[1] - u[1] * v[0]
    if abs(turn) < 1e-9 * math.dist(a, b) * math.dist(c, d):  # one line: anywhere between
        return ((b[0] + c[0]) / 2, (b[1] + c[1]) / 2)
    along = ((c[0] - a[0]) * v[1] - (c[1] - a[1]) * v[0]) / turn
    return (a[0] + along * u[0], a[1] + along * u[1])


def without_tabs(ring):
    """Its long sides, prolonged to where they meet: what it is without the arcs of tabs."""
    long = [side for side in sides(ring) if math.dist(*side) > 2]
    return [p[1] if p[1] == q[0] else crossing(*p, *q) for p, q in zip(long[-1:] + long, long)]


def nearest(at, p, q):
    """The point of a side that is nearest to another."""
    u = (q[0] - p[0], q[1] - p[1])
    share = max(0, min(1, ((at[0] - p[0]) * u[0] + (at[1] - p[1]) * u[1]) / (u[0] ** 2 + u[1] ** 2)))
    return (p[0] + share * u[0], p[1] + share * u[1])


def apart_of(one, other):
    """The distance of two parts' contours; 0 where they overlap."""
    least = math.inf
    for a, b in itertools.product(one.rings(), other.rings()):
        for (p, q), (r, s) in itertools.product(sides(a), sides(b)):
            if max(min(p[0], q[0]) - max(r[0], s[0]), min(r[0], s[0]) - max(p[0], q[0]),
                   min(p[1], q[1]) - max(r[1], s[1]), min(r[1], s[1]) - max(p[1], q[1])) > 6:
                continue
            if cross_each_other(p, q, r, s):
                return 0.0
            least = min(least, *(math.dist(at, nearest(at, u, v))
                                 for at, u, v in ((p, r, s), (q, r, s), (r, p, q), (s, p, q))))
    return 0.0 if one.holds(other.outer[0]) or other.holds(one.outer[0]) else least


def way_of(lengths):
    risen = max(b - a for a, b in zip(itertools.accumulate(lengths, min), lengths))
    fallen = max(a - b for a, b in zip(itertools.accumulate(lengths, max), lengths))
    return {(True, True): "reverses", (True, False): "lengthens", (False, True): "shortens",
            (False, False): "constant"}[(risen > STILL, fallen > STILL)]


def box(points):
    return [f(p[k] for p in points) for f in (min, max) for k in (0, 1)]


class Sheet:
    """What the FOLD file has: the truth."""

    def __init__(self, path):
        with open(path, encoding="utf8") as file:
            fold = json.load(file)
        self.points = [tuple(point) for point in fold["vertices_coords"]]
        row = sorted(fold["faces_vertices"][0])
        across = row[2] - row[0]  # vertices in a row of the sheet
        self.directions = []  # of sides, apart by a degree at least, modulo half a turn
        self.faces = {}
        for face in fold["faces_vertices"]:
            ring = [self.points[v] for v in face]
            if area(ring) < 0:
                face = face[::-1]
            self.faces["r%dc%d" % divmod(min(face), across)] = face
        for (x, y), (u, v) in ((self.points[a], self.points[b]) for a, b in fold["edges_vertices"]):
            way = math.atan2(v - y, u - x) % math.pi
            if all(0.02 < abs(way - other) < math.pi - 0.02 for other in self.directions):
                self.directions.append(way)
        self.assigned = {frozenset(edge): letter
                         for edge, letter in zip(fold["edges_vertices"], fold["edges_assignment"])}
        pattern = fold["misalign:pattern"]
        self.shifts = pattern.get("displacements_mm", {})
        self.is_unshifted = not self.shifts
        self.diagonals = fold["misalign:data"]["diagonals"]
        self.frames = [(0.0, [(x, y, 0.0) for x, y in self.points])] + \
            [(frame["misalign:pilot_deg"], frame["vertices_coords"]) for frame in fold["file_frames"]]
        rim = {v for edge, faces in self.faces_of_edges().items() if len(faces) == 1 for v in edge}
        self.area = sum(area([self.points[v] for v in face]) for face in self.faces.values())
        at = {v: [label for label, face in self.faces.items() if v in face] for v in rim}
        perimeter = self.perimeter()
        self.balls = {v: labels for v, labels in at.items() if len(labels) == 2 and v not in perimeter and
                      not any(set(labels) <= set(faces) for faces in self.faces_of_edges().values())}

    def ends(self):
        """Vertices of each spring."""
        return [[int(d[k][1:]) - 1 for k in ("from", "to")] for d in self.diagonals]

    def across(self, vertex):
        """Of the three faces at a corner of one hole that which shares an edge with both others."""
        at = [label for label, face in self.faces.items() if vertex in face]
        return max(at, key=lambda label: sum(
            len(set(self.faces[label]) & set(self.faces[other])) == 2 for other in at))

    def beside(self, hole, vertex):
        """At a ball joint the face next to a hole, counter-clockwise round the vertex."""
        corners = [self.points[v] for v in self.corners_of(hole)]
        middle = [sum(p[k] for p in corners) / 4 for k in (0, 1)]
        turn = lambda to: math.atan2(to[1] - self.points[vertex][1], to[0] - self.points[vertex][0])
        labels = [label for label, face in self.faces.items() if vertex in face]
        return min(labels, key=lambda label: (turn([sum(self.points[v][k] for v in self.faces[label]) / 4
                                                    for k in (0, 1)]) - turn(middle)) % (2 * math.pi))

    def corners_of(self, hole):
        return [v for d, ends in zip(self.diagonals, self.ends()) if d["hole"] == hole for v in ends]

    def folded(self, label, at, points):
        """A point of a flat face where that face is folded to."""
        a, b, c = self.faces[label][1:]
        (x, y), (u, v) = ([self.points[p][k] - self.points[b][k] for k in (0, 1)] for p in (a, c))
        p, q = at[0] - self.points[b][0], at[1] - self.points[b][1]
        s, t = (p * v - q * u) / (x * v - y * u), (x * q - y * p) / (x * v - y * u)
        return [points[b][k] + s * (points[a][k] - points[b][k]) + t * (points[c][k] - points[b][k])
                for k in range(3)]

    def faces_of_edges(self):
        found = {}
        for label, face in self.faces.items():
            for edge in sides(face):
                found.setdefault(frozenset(edge), []).append(label)
        return found

    def perimeter(self):
        """Its vertices: on the longest walk along edges of one face."""
        walks = self.walks(set(self.faces))
        return set(max(walks, key=lambda walk: abs(area([self.points[v] for v in walk]))))

    def walks(self, labels):
        """Contours of some faces, their material on the left; holes that touch are apart."""
        inner = {edge for label in labels for edge in sides(self.faces[label])}
        ways = {}
        for a, b in inner:
            if (b, a) not in inner:
                ways.setdefault(a, []).append(b)
        walks = []
        while ways:
            a = next(iter(ways))
            walk, b = [], ways[a][0]
            first = (a, b)
            while True:
                walk.append(a)
                back = self.angle(b, a)
                choices = ways.get(b, [])
                choice = min(choices, key=lambda c: (self.angle(b, c) - back) % (2 * math.pi) or 7)
                a, b = b, choice
                if (a, b) == first:
                    break
            for p, q in sides(walk):
                ways[p].remove(q)
                if not ways[p]:
                    del ways[p]
            walks.append(walk)
        return walks

    def angle(self, at, to):
        (x, y), (u, v) = self.points[at], self.points[to]
        return math.atan2(v - y, u - x)

    def components(self):
        """Labels of faces that edges join."""
        groups = {label: {label} for label in self.faces}
        for faces in self.faces_of_edges().values():
            if len(faces) == 2 and groups[faces[0]] is not groups[faces[1]]:
                both = groups[faces[0]] | groups[faces[1]]
                for label in both:
                    groups[label] = both
        return list({id(group): group for group in groups.values()}.values())


class Part:
    """One part of the drawing: its contours, what lies within, and where on the sheet it comes from."""

    def __init__(self, drawing, outer):
        self.drawing, self.outer = drawing, outer
        self.inner = []
        self.labels = set()
        self.residual = math.inf

    def holds(self, point):
        return inside(point, self.outer) and not any(inside(point, ring) for ring in self.inner)

    def rings(self):
        return [self.outer] + self.inner

    def find(self, sheet, kerf, has_tabs):
        """The turn and the shift that put the sheet's part, grown by half a kerf, on this one; the worst misfit."""
        wanted = sheet.walks(self.labels)
        wanted.sort(key=lambda walk: -abs(area([sheet.points[v] for v in walk])))
        rings = [without_tabs(ring) for ring in self.rings()] if has_tabs else self.rings()
        drawn = sorted(rings, key=lambda ring: -abs(area(ring)))
        if sorted(map(len, wanted)) != sorted(map(len, drawn)):
            return f"contours of {sorted(map(len, drawn))} corners, not {sorted(map(len, wanted))}"
        for turn in turns_of(self.outer, sheet.directions):
            for _ in range(2):  # the second time with the turn itself
                c, s = math.cos(turn), math.sin(turn)
                points = [(c * x - s * y, s * x + c * y) for x, y in sheet.points]
                a, off, weight = [], 0.0, 0.0
                for ring in drawn:
                    _, lines, turned, length = min((self.shifted_lines(walk, ring, points, kerf) for walk in wanted),
                                                   key=lambda found: found[0])
                    a, off, weight = a + lines, off + turned, weight + length
                if not a:
                    break
                turn += off / weight
            if not a:
                continue
            # Least squares for the shift (two unknowns) of distances along normals.
            sxx, sxy, syy = (sum(l[i] * l[j] for l in a) for i, j in ((0, 0), (0, 1), (1, 1)))
            bx, by = (sum(l[i] * l[2] for l in a) for i in (0, 1))
            det = sxx * syy - sxy * sxy
            shift = ((syy * bx - sxy * by) / det, (sxx * by - sxy * bx) / det)
            worst = max(abs(l[2] - l[0] * shift[0] - l[1] * shift[1]) for l in a)
            if worst < self.residual - 1e-9:
                self.residual, self.turn, self.shift = worst, turn, shift
                self.sheet_points = [(x + shift[0], y + shift[1]) for x, y in points]
        return None if self.residual <= NEAR else f"off by {self.residual:.4f} mm"

    def on_sheet(self, at):
        """Where a point of the drawing is on the sheet."""
        x, y = at[0] - self.shift[0], at[1] - self.shift[1]
        c, s = math.cos(self.turn), math.sin(self.turn)
        return (c * x + s * y, c * y - s * x)

    @staticmethod
    def shifted_lines(walk, ring, points, kerf):
        """Of the rotation of the walk whose sides are parallel to the ring's: how unlike, (nx, ny, distance), and the
        turn from its sides to the ring's times their length, and that length."""
        best = (math.inf, [], 0.0, 1.0)
        wanted = [points[v] for v in walk]
        if len(walk) != len(ring) or (area(wanted) > 0) != (area(ring) > 0):
            return best
        drawn_sides = sides(ring)
        for k in range(len(ring)):
            lines, unlike, turned, total = [], 0.0, 0.0, 0.0
            for (p, q), (r, s) in zip(sides(wanted[k:] + wanted[:k]), drawn_sides):
                length, along = math.dist(p, q), math.dist(r, s)
                t = ((q[0] - p[0]) / length, (q[1] - p[1]) / length)
                u = ((s[0] - r[0]) / along, (s[1] - r[1]) / along)
                unlike += math.dist(t, u) + 1e-3 * abs(length - along)
                if unlike > best[0]:
                    break
                turned += length * math.asin(max(-1, min(1, t[0] * u[1] - t[1] * u[0])))
                total += length
                normal = (t[1], -t[0])  # away from the material
                for a in (r, s):  # both ends: parallel, too
                    lines.append((*normal, (a[0] - p[0]) * normal[0] + (a[1] - p[1]) * normal[1] - kerf / 2))
            else:
                best = (unlike, lines, turned, total)
        return best


class Check:
    def __init__(self, sheet, drawings, wish, page):
        self.sheet, self.drawings, self.wish, self.page = sheet, drawings, wish, page
        for drawing in drawings:
            drawing.read_words(sheet.directions)
        self.faults = [fault for drawing in drawings for fault in drawing.faults]
        self.parts = []
        self.worst = dict.fromkeys(("length", "offset", "bore", "spring"), 0.0)
        self.tabs, self.closest = [], math.inf
        if wish.spring_bore and wish.spring_at == "vertex":
            self.tabs = sorted({v for ends in sheet.ends() for v in ends} - set(sheet.balls))
        self.radius = wish.spring_bore / 2 + wish.edge
        self.clear = self.radius + SLOT + wish.kerf

    def expect(self, good, words):
        if not good:
            self.faults.append(words)

    def run(self):
        for drawing in self.drawings:
            self.contours(drawing)
        self.numbering()
        for part in self.parts:
            fault = part.find(self.sheet, self.wish.kerf, bool(self.tabs))
            self.expect(fault is None, f"part {sorted(part.labels)[:3]}: {fault}")
            self.worst["offset"] = max(self.worst["offset"], part.residual)
        if self.faults:
            return
        self.expect(not self.wish.turned or any(abs(math.sin(part.turn)) > 0.01 for part in self.parts), "no part is turned")
        self.expect(not self.wish.grain or all(abs(math.sin(part.turn)) < 1e-6 for part in self.parts), "across the grain")
        self.whole_parts()
        self.areas()
        self.creases()
        self.bores()
        self.round_tabs()
        if not self.faults:
            self.springs()
        self.places()
        self.notes()

    def contours(self, drawing):
        """Closed, simple, none twice; which of them are parts."""
        rings = []
        for points, closed in drawing.paths.get("cut", []) + drawing.paths.get("opening", []):
            self.expect(closed, "an open contour")
            self.expect(len(points) >= 3, "a contour of two points")
            rings.append(points)
            lying = sorted(sides(points), key=lambda side: min(side))
            for k, (a, b) in enumerate(lying):
                for c, d in itertools.takewhile(lambda side: min(side) <= max(a, b), lying[k + 1:]):
                    self.expect(not cross_each_other(a, b, c, d), f"a contour crosses itself at {a}")
        seen = set()
        for layer in CUTS:
            for points, closed in drawing.paths.get(layer, []):
                for p, q in sides(points, closed):
                    key = frozenset((round(x, 4), round(y, 4)) for x, y in (p, q))
                    self.expect(key not in seen, f"a line twice: {p} {q}")
                    self.expect(len(key) == 2, f"a line of no length at {p}")
                    seen.add(key)
        self.expect(all(area(ring) > 0 for ring, _ in drawing.paths.get("cut", [])), "an opening among outer contours")
        parts = [Part(drawing, ring) for ring in rings if area(ring) > 0]
        for ring in rings:
            if area(ring) > 0:
                continue
            owners = [part for part in parts if all(inside(point, part.outer) for point in ring)]
            self.expect(owners, "an opening in no part")
            if owners:  # the smallest: a part may lie in another's opening
                min(owners, key=lambda part: area(part.outer)).inner.append(ring)
        self.parts += parts

    def numbering(self):
        numbers = [(drawing, text) for drawing in self.drawings for text in drawing.texts.get("engrave", [])
                   if re.fullmatch(r"r\d+c\d+", text[2])]
        words = [text[2] for _, text in numbers]
        self.expect(len(set(words)) == len(words), "a panel's number twice")
        self.expect(set(words) == set(self.sheet.faces), "numbers of other panels than the sheet has")
        for drawing, text in numbers:
            owners = [part for part in self.parts if part.drawing is drawing and part.holds(text[:2])]
            self.expect(len(owners) == 1, f"number {text[2]} is in no part")
            for part in owners:
                part.labels.add(text[2])
        for part in self.parts:
            self.expect(part.labels, "a part without a number")

    def on_panel(self, part, label):
        return [part.sheet_points[v] for v in self.sheet.faces[label]]

    def whole_parts(self):
        """Parts are what creases join (cut: panels; on a bed: pieces of that), and marks lie on their panels."""
        wanted = [{label} for label in self.sheet.faces] if self.wish.crease == "cut" else self.sheet.components()
        for part in self.parts:
            homes = [group for group in wanted if part.labels <= group]
            self.expect(len(homes) == 1, f"a part of {sorted(part.labels)}")
            self.expect(self.wish.bed or part.labels in wanted, f"a piece of a part: {sorted(part.labels)}")
        for drawing in self.drawings:
            for x, y, words, turned in drawing.texts.get("engrave", []):
                part = next((part for part in self.parts if part.drawing is drawing and part.holds((x, y))), None)
                self.expect(part, f"{words} is on no part")
                if part is None:
                    continue
                off = math.radians(turned) - part.turn
                self.expect(math.cos(off) > 0.99 or self.sheet.is_unshifted, f"{words} is turned by {turned}")
                panel = next((label for label in part.labels if inside((x, y), self.on_panel(part, label))), None)
                self.expect(panel, f"{words} is on no panel")
                if panel is None:
                    continue
                if words.startswith("r"):
                    self.expect(panel == words, f"number {words} is on panel {panel}")
                if words.startswith("A"):
                    self.expect(int(words[1:]) - 1 in self.sheet.faces[panel], f"{words} is on panel {panel}")

    def areas(self):
        if self.wish.kerf:
            return
        drawn = sum(area(ring) for part in self.parts for ring in part.rings())
        wanted = self.sheet.area
        for vertex in self.tabs:
            for label, face in self.sheet.faces.items():
                if vertex not in face:
                    continue
                k = face.index(vertex)
                angle = (self.sheet.angle(vertex, face[k - 1]) - self.sheet.angle(vertex, face[(k + 1) % 4])) \
                    % (2 * math.pi)
                wanted += self.radius ** 2 * (math.pi - angle / 2) if label == self.sheet.across(vertex) \
                    else -self.clear ** 2 * angle / 2
        self.area_off = abs(drawn - wanted)
        chords = 0.15 * len(self.tabs)
        self.expect(self.area_off < 1e-4 * len(self.parts) + chords, f"areas sum to {drawn}, not {wanted}")

    def creases(self):
        """Every crease of every part, on its layer, from vertex to vertex."""
        for part in self.parts:
            both = [edge for edge, faces in self.sheet.faces_of_edges().items()
                    if len(faces) == 2 and set(faces) <= part.labels]
            if self.wish.crease == "cut":
                self.expect(not both, "a crease is not cut")
                continue
            for letter, kind in (("M", "mountain"), ("V", "valley")):
                lines = [points for points, _ in part.drawing.paths.get(f"{self.wish.crease}_{kind}", [])
                         if inside(self.middle(points), part.outer)]
                wanted = [edge for edge in both if self.sheet.assigned[edge] == letter]
                for edge in wanted:
                    p, q = self.crease_ends(part, *sorted(edge))
                    here = [line for line in lines if all(self.on_line(at, p, q) for at in line)]
                    lines = [line for line in lines if line not in here]
                    (self.scored if self.wish.crease == "score" else self.dashed)(here, p, q)
                self.expect(not lines, f"{len(lines)} lines that are no {kind}")

    def crease_ends(self, part, a, b):
        """Its vertices; where one has a tab, as far from it as panels are cut away."""
        ends = []
        for at, to in ((a, b), (b, a)):
            (x, y), (u, v) = part.sheet_points[at], part.sheet_points[to]
            share = self.clear / math.dist((x, y), (u, v)) if at in self.tabs else 0
            ends.append((x + share * (u - x), y + share * (v - y)))
        return ends

    @staticmethod
    def middle(points):
        return tuple(sum(p[k] for p in points) / len(points) for k in (0, 1))

    @staticmethod
    def on_line(at, p, q):
        return abs(beyond(at, p, q)) < NEAR and math.dist(at, p) + math.dist(at, q) < math.dist(p, q) + NEAR

    def scored(self, lines, p, q):
        self.expect(len(lines) == 1, f"{len(lines)} lines on a crease")
        for line in lines:
            off = abs(math.dist(*line) - math.dist(p, q))
            self.worst["length"] = max(self.worst["length"], off)
            self.expect(off < NEAR, f"a crease is {off} mm too long or short")

    def dashed(self, lines, p, q):
        """Bridges first and last, all equal and at least as long as asked for; cuts as long as asked for."""
        dash, bridge = self.wish.dash
        self.expect(len(lines) == int((math.dist(p, q) - bridge) / (dash + bridge) + 1e-9), "too few cuts")
        spots = sorted(sorted(math.dist(p, at) for at in line) for line in lines)
        ends = [0.0] + [at for spot in spots for at in spot] + [math.dist(p, q)]
        for begin, end in spots:
            self.expect(abs(end - begin + self.wish.kerf - dash) < NEAR, "a cut of another length")
        bridges = [b - a - (self.wish.kerf if 0 < i < len(spots) else self.wish.kerf / 2)
                   for i, (a, b) in enumerate(zip(ends[::2], ends[1::2]))]
        self.expect(min(bridges) > bridge - NEAR and max(bridges) - min(bridges) < NEAR, f"bridges: {bridges}")

    def bores(self):
        joint, spring, edge, kerf = self.wish.joint_bore, self.wish.spring_bore, self.wish.edge, self.wish.kerf
        found, on_tabs = {}, []
        self.ends = {}  # where springs end, on the sheet: by vertex and panel
        for drawing in self.drawings:
            for x, y, radius in drawing.circles.get("bore", []):
                part = next((part for part in self.parts if part.drawing is drawing and part.holds((x, y))), None)
                vertex = part and next((v for v in self.tabs if math.dist(part.sheet_points[v], (x, y)) < NEAR), None)
                if vertex is not None:
                    on_tabs.append(vertex)
                    label = self.sheet.across(vertex)
                    self.expect(label in part.labels, f"A{vertex + 1} has its bore in another part than {label}")
                    self.expect(abs(2 * radius + kerf - spring) < NEAR, f"a bore of {2 * radius + kerf} mm")
                    self.ends[vertex, label] = part.on_sheet((x, y))
                    continue
                label = part and next((l for l in part.labels if inside((x, y), self.on_panel(part, l))), None)
                self.expect(label, "a bore in no panel")
                if label is None:
                    continue
                panel = self.on_panel(part, label)
                diameter = 2 * radius + kerf
                off, size = min((abs(diameter - size), size) for size in (joint, spring) if size)
                self.worst["bore"] = max(self.worst["bore"], off)
                self.expect(off < NEAR, f"a bore of {diameter} mm")
                depth = min(beyond((x, y), p, q) for p, q in sides(panel))
                self.expect(depth >= size / 2 + edge - NEAR, f"a bore leaves {depth - size / 2} mm of {label}")
                corner = min(self.sheet.faces[label], key=lambda v: math.dist(part.sheet_points[v], (x, y)))
                for other in found.get(label, []):
                    apart = math.dist(other[:2], (x, y)) - (other[2] + size) / 2
                    self.expect(apart >= edge - NEAR, f"bores {apart} mm apart in {label}")
                found.setdefault(label, []).append((x, y, size, corner, math.dist(part.sheet_points[corner], (x, y))))
                before = self.ends.get((corner, label))  # of two the joint's is nearer to the corner
                self.ends[corner, label] = max(filter(None, (before, part.on_sheet((x, y)))),
                                               key=lambda at: math.dist(at, self.sheet.points[corner]))
        if joint:
            for vertex, labels in self.sheet.balls.items():
                for label in labels:
                    near = sorted((bore for bore in found.get(label, []) if bore[3] == vertex), key=lambda b: b[4])
                    self.expect(near and near[0][2] == joint, f"no joint's bore in {label} at A{vertex + 1}")
        if spring and self.wish.spring_at == "vertex":
            self.expect(sorted(on_tabs) == self.tabs, f"tabs' bores at {sorted(on_tabs)}")
            for vertex, label in [(v, label) for v, labels in self.sheet.balls.items() for label in labels]:
                self.ends[vertex, label] = self.sheet.points[vertex]  # hangs in the joint
        elif spring:
            wanted = sorted(v for ends in self.sheet.ends() for v in ends)
            there = [bore[3] for bores in found.values() for bore in bores]
            if joint:
                there = list(there)
                for vertex in self.sheet.balls:
                    there.remove(vertex), there.remove(vertex)
            self.expect(sorted(there) == wanted, "springs' bores at other corners")
        if spring:
            words = sorted(text[2] for drawing in self.drawings for text in drawing.texts.get("engrave", [])
                           if text[2].startswith("s"))
            self.expect(words == sorted(2 * [f"s{d['diagonal']}" for d in self.sheet.diagonals]), "springs' numbers")
        count = sum(map(len, found.values()))
        in_panels = 2 * len(self.sheet.diagonals) if spring and self.wish.spring_at == "panel" else 0
        self.expect(count == (2 * len(self.sheet.balls) if joint else 0) + in_panels, f"{count} bores")

    def round_tabs(self):
        """What is material round a vertex with a tab: its panel, the disc, and the others off the slot."""
        random.seed(1)
        clear, radius, least = self.clear, self.radius, self.wish.kerf / 2 + 0.02
        for part, vertex in itertools.product(self.parts, self.tabs):
            labels = [label for label, face in self.sheet.faces.items() if vertex in face]
            if not part.labels & set(labels):
                continue
            owner, at = self.sheet.across(vertex), part.sheet_points[vertex]
            for ring in part.rings():
                near = min(math.dist(at, point) for point in ring)
                self.expect(near > (radius if owner in part.labels else clear - self.wish.kerf) + self.wish.kerf / 2
                            - NEAR, f"a contour {near} mm from A{vertex + 1}")
            for _ in range(120):
                away, turn = random.uniform(0, clear + 2), random.uniform(0, 2 * math.pi)
                point = (at[0] + away * math.cos(turn), at[1] + away * math.sin(turn))
                edges = [side for label in labels for side in sides(self.on_panel(part, label)) if at in side]
                if min(abs(away - radius), abs(away - clear), *(abs(beyond(point, *side)) for side in edges)) < least:
                    continue
                homes = [label for label in labels if inside(point, self.on_panel(part, label))]
                wanted = owner in part.labels if away < radius else \
                    bool(homes) and homes[0] in part.labels and (away > clear or homes[0] == owner)
                self.expect(part.holds(point) == wanted, f"{away:.2f} mm from A{vertex + 1} there is "
                            f"{'nothing' if wanted else 'material'}")

    def springs(self):
        """Lengths between drawn ends in every folded state, beside the tables; and what is said of them first."""
        springs, histories = self.page.springs(), self.page.histories()
        against = 0
        for d, (diagonal, (a, b)) in enumerate(zip(self.sheet.diagonals, self.sheet.ends())):
            if not self.wish.spring_bore:
                break
            places = []
            for v in (a, b):
                label = self.sheet.beside(diagonal["hole"], v) if v in self.sheet.balls else self.sheet.across(v)
                label = next((panel for vertex, panel in self.wish.point if vertex == f"A{v + 1}"), label)
                places.append((label, self.ends[v, label]))
            lengths = [math.dist(*(self.sheet.folded(label, at, points) for label, at in places))
                       for _, points in self.sheet.frames]
            own = lengths if self.wish.attached else [math.dist(points[a], points[b]) for _, points in self.sheet.frames]
            name = f"s{d}"
            against += way_of(own) != "reverses" and way_of(own) != way_of(lengths)
            if name not in springs or name not in histories:
                self.expect(False, f"{name} is not in the tables")
                continue
            flat, ends, ways = springs[name]
            self.near(name, flat + ends, [own[0], lengths[0], lengths[-1], max(lengths) - min(lengths)])
            self.expect(ways == [way_of(lengths), way_of(own)], f"{name}: {ways}, not {[way_of(lengths), way_of(own)]}")
            at = {round(deg, 6): length for (deg, _), length in zip(self.sheet.frames, lengths)}
            shown = [deg for deg in at if deg % 10 == 0 or deg == max(at)]
            self.expect(sorted(histories[name]) == shown, f"{name}: degrees {sorted(histories[name])}")
            self.near(name, histories[name].values(), [at[deg] for deg in histories[name]])
        self.against = against
        self.expect(self.wish.against in (None, against), f"{against} springs contradict the verdict")
        self.expect(len(self.page.warnings) == (1 if against else 0), f"{len(self.page.warnings)} warnings")
        for words in self.page.warnings:
            self.expect(words.startswith(f"{against} of {len(self.sheet.diagonals)} springs contradict"),
                        f"{words}, not {against}")
            self.expect(self.page.text.index(words) < self.page.text.index("<h2"), "the warning is not first")

    def near(self, name, printed, wanted, within=NEAR):
        for one, other in zip(printed, wanted):
            if within == NEAR:
                self.worst["spring"] = max(self.worst["spring"], abs(float(one) - other))
            self.expect(abs(float(one) - other) < within, f"{name}: {one}, not {other:.4f} mm")

    def places(self):
        """Outlines keep apart, and on their bed; registration marks, and what the page says of all that."""
        marks = set()
        for drawing in self.drawings:
            parts = [part for part in self.parts if part.drawing is drawing]
            boxes = {id(part): box(part.outer) for part in parts}
            if self.wish.bed:
                self.expect(math.dist(drawing.size, self.wish.bed) < 2e-5, f"a page of {drawing.size}")
            for b in boxes.values():
                self.expect(min(b[0], b[1], drawing.size[0] - b[2], drawing.size[1] - b[3]) > 5 - 1e-5,
                            "a part in the margin")
            for one, other in itertools.combinations(parts, 2):
                a, b = boxes[id(one)], boxes[id(other)]
                if max(a[0] - b[2], b[0] - a[2], a[1] - b[3], b[1] - a[3]) > 5:
                    continue
                apart = apart_of(one, other)
                self.closest = min(self.closest, apart)
                self.expect(apart > 5 - 1e-5, f"parts {apart} mm apart")
            circles = drawing.circles.get("registration", [])
            self.expect(len(circles) == 3, f"{len(circles)} registration marks")
            for x, y, radius in circles:
                self.expect(abs(2 * radius + self.wish.kerf - 3) < 1e-5, f"a mark of {2 * radius} mm")
                off = min(math.dist((x, y), at) for part in parts for p, q in sides(part.outer)
                          for at in [nearest((x, y), p, q)])
                self.expect(off > 1.5 + 5 - 1e-5 and not any(part.holds((x, y)) for part in parts),
                            f"a mark {off} mm from a part")
            marks.add(tuple((round(x, 4), round(y, 4)) for x, y, _ in circles))
        self.expect(len(marks) == 1, "marks at other places on another sheet")
        if {len(circles) for circles in marks} != {3}:
            return
        (low, right, high), (count, shown, least, apart) = min(marks), self.page.sheets()
        self.near("marks", apart, (math.dist(low, right), math.dist(low, high)), 0.02)
        total = sum(area(ring) for part in self.parts for ring in part.rings())
        room = (self.drawings[0].size[0] - 10) * (self.drawings[0].size[1] - 10)
        self.expect(count == len(self.drawings) and least == math.ceil(total / room), f"{count} sheets, at least {least}")
        self.near("area", [shown], [total], 51)

    def notes(self):
        for drawing in self.drawings:
            self.expect(not drawing.texts.get("note") and set(drawing.texts) <= {"engrave"}, "texts in a drawing")
        shifts = self.page.shifts()
        for vertex, shift in self.sheet.shifts.items():
            self.expect(vertex in shifts, f"the shift of {vertex} is not in the table")
            self.near(vertex, shifts.get(vertex, (math.inf,)), shift, 1e-4)


def same(one, other):
    """What differs between two kits that are to be the same drawings."""
    for a, b in zip(one, other):
        for kind in ("paths", "circles", "texts"):
            first, second = getattr(a, kind), getattr(b, kind)
            if {k for k in first if first[k]} != {k for k in second if second[k]}:
                yield f"{kind} on layers {sorted(first)} and {sorted(second)}"
                continue
            for layer in first:
                if len(first[layer]) != len(second[layer]):
                    yield f"{len(first[layer])} and {len(second[layer])} {kind} on {layer}"
                for p, q in zip(first[layer], second[layer]):
                    flat = [[n for at in item[0] for n in at] if kind == "paths" else
                            [n for n in item if not isinstance(n, str)] for item in (p, q)]
                    words = [[n for n in item if isinstance(n, (str, bool))] for item in (p, q)]
                    if words[0] != words[1] or len(flat[0]) != len(flat[1]) or \
                            any(abs(m - n) > 1e-5 for m, n in zip(*flat)):
                        yield f"{kind} on {layer}: {p} and {q}"


def spoil(drawing, page, how):
    """One thing that a check is to see."""
    random.seed(1)
    cut = drawing.paths["cut"]
    engrave = drawing.texts["engrave"]

    def move(layer, item, by):
        points, closed = drawing.paths[layer][item]
        drawing.paths[layer][item] = ([(points[0][0] + by, points[0][1])] + points[1:], closed)

    def rename(pick, change):
        k = next(i for i, text in enumerate(engrave) if pick(text[2]))
        x, y, words, turned = engrave[k]
        engrave[k] = change(x, y, words, turned)

    def tables(form, change):
        for table in page.tables:
            for row in table[1:]:
                row[:] = [change(words) if re.fullmatch(form, words) else words for words in row]

    panel = lambda words: words.startswith("r")
    {
        "open": lambda: cut.__setitem__(0, (cut[0][0], False)),
        "twice": lambda: drawing.paths["score_valley"].append(drawing.paths["score_valley"][0]),
        "corner": lambda: move("cut", 0, 0.05),
        "crease": lambda: move("score_mountain", 0, 0.05),
        "valley": lambda: drawing.paths["score_valley"].append(drawing.paths["score_mountain"].pop()),
        "number": lambda: rename(panel, lambda x, y, words, t: (x, y, engrave[-1][2], t)),
        "swapped": lambda: rename(lambda w: w == "r0c1", lambda x, y, w, t: (engrave[0][0], engrave[0][1], w, t)),
        "label": lambda: rename(lambda w: w == "A1", lambda x, y, w, t: (x, y, "A20", t)),
        "opening": drawing.paths["opening"].pop,
        "knot": lambda: cut.__setitem__(0, (cut[0][0][:2] + cut[0][0][2:9][::-1] + cut[0][0][9:], True)),
        "shift": lambda: tables(r"[+-]0\.4000", lambda words: "+0.3000"),
        "mark": lambda: drawing.circles["registration"].pop(),
        "bore": lambda: drawing.circles["bore"].__setitem__(
            0, (drawing.circles["bore"][0][0] + 1, *drawing.circles["bore"][0][1:])),
        "bores": lambda: drawing.circles["bore"].pop(),
        "tab": lambda: [drawing.paths.__setitem__(
            layer, [([(x + 0.05 * (math.dist((x, y), drawing.circles["bore"][-1][:2]) < 3.5), y) for x, y in points],
                     closed) for points, closed in drawing.paths.get(layer, [])]) for layer in ("cut", "opening")],
        "history": lambda: tables(r"\d+\.\d{3}", lambda words: f"{float(words) + 0.02:.3f}"),
        "way": lambda: tables("lengthens", lambda words: "shortens"),
        "warning": page.warnings.clear,
        "far": lambda: drawing.__setattr__("size", (0.5 * drawing.size[0], drawing.size[1])),
        "scale": lambda: drawing.paths.__setitem__(
            "cut", [([(1.0002 * x, 1.0002 * y) for x, y in points], closed) for points, closed in cut]),
    }[how]()


def arguments():
    words = argparse.ArgumentParser()
    words.add_argument("sheet")
    words.add_argument("kit", nargs="+")
    for name in ("--kerf", "--joint-bore", "--spring-bore"):
        words.add_argument(name, type=float, default=0)
    words.add_argument("--edge", type=float, default=2)
    words.add_argument("--spring-at", default="vertex")
    words.add_argument("--against", type=int)
    words.add_argument("--attached", action="store_true")
    words.add_argument("--point", nargs=2, action="append", default=[])
    words.add_argument("--crease", default="score")
    words.add_argument("--dash", nargs=2, type=float, default=(4, 1))
    words.add_argument("--units", default="mm")
    words.add_argument("--from", type=float, dest="from_deg")
    words.add_argument("--bed", nargs=2, type=float)
    for name in ("--plain", "--wrong", "--numbers", "--turned", "--grain"):
        words.add_argument(name, action="store_true")
    words.add_argument("--spoil", nargs="*", default=[])
    return words


def spoilt(sheet, wish):
    for how in wish.spoil:
        drawing, page = Drawing(wish.kit[0]), Page(wish.page)
        drawing.read_words(sheet.directions)
        spoil(drawing, page, how)
        check = Check(sheet, [drawing], wish, page)
        check.run()
        if not check.faults:
            yield f"nothing sees that it is spoilt ({how})"


def faults_of(wish):
    sheet = Sheet(wish.sheet)
    if wish.from_deg:
        sheet.frames = [frame for frame in sheet.frames if frame[0] < wish.from_deg + 1e-6]
    wish.page = next((path for path in wish.kit if path.endswith(".html")), None)
    if wish.spoil:
        yield from spoilt(sheet, wish)
        return
    kits = {ending: [Drawing(path) for path in wish.kit if path.endswith(ending)] for ending in (".dxf", ".svg")}
    if kits[".dxf"] and kits[".svg"]:
        yield from same(kits[".dxf"], kits[".svg"])
    for ending, drawings in kits.items():
        if wish.plain:
            yield from (fault for drawing in drawings for fault in drawing.faults)
        if not drawings or wish.plain:
            continue
        page = Page(wish.page)
        check = Check(sheet, drawings, wish, page)
        check.expect(all(drawing.unit == (25.4 if wish.units == "in" else 1) for drawing in drawings), "another unit")
        check.expect(page.unit == drawings[0].unit or not (page.springs() or page.shifts()), "the page has another unit")
        check.run()
        yield from (f"{ending[1:]}: {fault}" for fault in check.faults)
        if wish.numbers and not check.faults:
            area = "" if wish.kerf else f", areas within {check.area_off:.1e} mm2"
            worst = check.worst
            print(f"{ending[1:]}: {len(drawings)} sheets, {len(check.parts)} parts, {len(sheet.faces)} panels; "
                  f"contours within {worst['offset']:.1e} mm, creases within {worst['length']:.1e} mm, "
                  f"bores within {worst['bore']:.1e} mm{area}")
            if wish.spring_bore:
                print(f"{ending[1:]}: {check.against} of {len(sheet.diagonals)} springs contradict the verdict; their "
                      f"lengths within {worst['spring']:.1e} mm")


def main():
    words, bad = arguments(), False
    for line in sys.stdin:
        wish = words.parse_args(line.split())
        if wish.numbers:
            print(line.strip())
        faults = list(faults_of(wish))
        if wish.wrong:
            faults = [] if faults else ["what is wrong goes unseen"]
        for fault in faults[:20]:
            print(f"{line.strip()}: {fault}")
        bad = bad or bool(faults)
    sys.exit(bad)


main()
