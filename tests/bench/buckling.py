#!/usr/bin/env python3
"""Compares the bounds of panels' buckling with CalculiX's *BUCKLE: `buckling.py MISALIGN FOLDER [--sheet]`.

Each panel alone, under the forces that joints and springs put on it in its plane, its creases straight, one corner
after another free to rise. `--sheet`: the whole sheet, its creases hinges. Needs ccx; writes decks into FOLDER and a
table in Markdown to standard output. Springs are so soft that panels stay flat under them: forces are those of
`deploy --forces held`, and factors are linear in them.
"""
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys

SHEETS = [("table1", 36), ("table1", 90), ("miura-wide-6x6", 60), ("turned-quads-6x6", 60)]
SOFT_N_PER_MM, E_MPA, NU, T_MM = 1e-3, 70e3, 0.33, 1.0
ELEMENTS = 10
RIGIDITY = E_MPA * T_MM**3 / 12 / (1 - NU * NU)


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def axes(p):
    """The axes of a panel by its corners: along its first edge, square to it, its normal."""
    along = unit(sub(p[1], p[0]))
    normal = unit(cross(along, sub(p[3], p[0])))
    return [along, cross(normal, along), normal]


def turned(to, of, vector):
    """The vector that has the components on `to` that `vector` has on `of`."""
    parts = [dot(axis, vector) for axis in of]
    return [sum(parts[k] * to[k][i] for k in range(3)) for i in range(3)]


def shown(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


class Sheet:
    """A folded sheet with the forces on each panel in its plane."""

    def __init__(self, program, folder, pattern, name, from_deg):
        base = ["--from", str(from_deg)]
        self.name, self.from_deg = name, from_deg
        study = json.loads(shown(program, "deploy", pattern, *base, "--forces", "held", "--stiffness",
                                 str(SOFT_N_PER_MM), "--panels", "bend", "--thickness", str(T_MM), "--json"))
        self.factors = study["bent"]["buckling"]["angles"][-1]["factors"]
        self.places = [panel["panel"] for panel in study["bent"]["buckling"]["panels"]]
        out = os.path.join(folder, f"{name}-{from_deg}")
        shutil.rmtree(out, ignore_errors=True)
        for form in ("inp", "fold"):
            shown(program, "export", pattern, "--format", form, "--output", out,
                  *(base + ["--stiffness", str(SOFT_N_PER_MM)] if form == "inp" else []))
        files = {os.path.splitext(f)[1]: os.path.join(out, f) for f in os.listdir(out)}
        with open(files[".inp"]) as file:
            self.deck = file.read()
        with open(files[".fold"]) as file:
            fold = json.load(file)
        self.faces = fold["faces_vertices"]
        self.flat = [[*p[:2], 0.0] for p in fold["vertices_coords"]]
        nodes = {int(a): [float(x) for x in b.split(",")]
                 for a, b in re.findall(r"^(\d+),(-?\d\.\d+e\S+)$", self.deck, re.M)}
        corners = [[int(n) for n in line.split(",")] for line in
                   re.search(r"NSET=CORNERS\n((?:[\d,]+\n)+)", self.deck).group(1).split()]
        assert len(corners) == len(self.faces)
        first = axes([nodes[n] for n in corners[0]])
        to_first = axes([self.flat[v] for v in self.faces[0]])
        self.at = [None] * len(self.flat)  # in the coordinates of the first panel
        for face, its in zip(self.faces, corners):
            for v, n in zip(face, its):
                self.at[v] = turned(to_first, first, nodes[n])
        self.forces = [{"corner": [[0.0] * 3 for _ in range(4)], "edge": [[0.0] * 3 for _ in range(4)],
                        "moment": [0.0] * 4, "crease": [False] * 4} for _ in self.faces]
        self.add_joints(study["forces"])
        self.add_springs({n: v for face, its in zip(self.faces, corners) for v, n in zip(face, its)})

    def in_plane(self, panel, vector):
        face = self.faces[panel]
        return turned(axes([self.flat[v] for v in face]), axes([self.at[v] for v in face]), vector)

    def push(self, panel, vertex, force):
        at = self.forces[panel]["corner"][self.faces[panel].index(vertex)]
        for k, part in enumerate(self.in_plane(panel, force)):
            at[k] += part

    def add_joints(self, joints):
        label = lambda text: int(text[1:]) - 1
        for crease in joints["creases"]:
            a, b = label(crease["from"]), label(crease["to"])
            for panel, face in enumerate(self.faces):
                for i in range(4):
                    if {face[i], face[(i + 1) % 4]} != {a, b}:
                        continue
                    sign = -1 if face[i] == a else 1  # the panel to the left sees a, then b
                    its = self.forces[panel]
                    its["crease"][i] = True
                    force, moment = (self.in_plane(panel, [sign * x for x in crease[key][0]])
                                     for key in ("force_n", "moment_n_mm"))
                    its["edge"][i], its["moment"][i] = force, moment[2]
        # Each is the force on one of the two panels; balance says on which.
        self.balls = []
        for ball in joints["ball_joints"]:
            vertex = label(ball["vertex"])
            at = [k for k, face in enumerate(self.faces) if vertex in face]
            self.balls.append((vertex, at, ball["force_n"][0]))

    def add_springs(self, vertex_of):
        for a, b in re.findall(r"TYPE=SPRINGA, ELSET=S\d+\n\d+,(\d+),(\d+)", self.deck):
            a, b = vertex_of[int(a)], vertex_of[int(b)]
            along = sub(self.at[b], self.at[a])
            length, flat = math.sqrt(dot(along, along)), math.dist(self.flat[a], self.flat[b])
            pull = [SOFT_N_PER_MM * (length - flat) * x / length for x in along]
            for vertex, sign in ((a, 1), (b, -1)):
                panels = [k for k, face in enumerate(self.faces) if vertex in face]
                for panel in panels:
                    self.push(panel, vertex, [sign * x / len(panels) for x in pull])
        for vertex, at, force in self.balls:
            self.push_ball(vertex, at, force, 1)
        # All combinations, one ball turned round at a time (Gray's code): the one in balance stays.
        signs, best, kept = [1] * len(self.balls), math.inf, []
        for step in range(1, 2 ** len(self.balls) + 1):
            off = sum(self.residual(k) for k in range(len(self.faces)))
            if off < best:
                best, kept = off, list(signs)
            k = min((step & -step).bit_length(), len(self.balls)) - 1
            self.push_ball(*self.balls[k], -2 * signs[k])
            signs[k] = -signs[k]
        for ball, sign, wanted in zip(self.balls, signs, kept):
            self.push_ball(*ball, wanted - sign)
        largest = max(abs(x) for its in self.forces for f in its["corner"] for x in f)
        assert max(self.residual(k) for k in range(len(self.faces))) < 1e-6 * largest

    def push_ball(self, vertex, at, force, factor):
        for panel, sign in zip(at, (factor, -factor)):
            self.push(panel, vertex, [sign * x for x in force])

    def bounds(self, panel):
        """The bound by this file, and whether a pressed corner decides."""
        its, p = self.forces[panel], [self.flat[v] for v in self.faces[panel]]
        area = cross(sub(p[2], p[0]), sub(p[3], p[1]))[2] / 2
        longest = max(math.dist(p[0], p[2]), math.dist(p[1], p[3]))**2
        xx = xy = yx = yy = 0.0
        for i in range(4):
            a, b = p[i], p[(i + 1) % 4]
            e = unit(sub(b, a))
            for f, x in ((its["corner"][i], a), (its["edge"][i], [(s + t) / 2 for s, t in zip(a, b)]),
                         ([-its["moment"][i] * e[1], its["moment"][i] * e[0]], e)):
                xx, xy, yx, yy = xx + f[0] * x[0], xy + f[0] * x[1], yx + f[1] * x[0], yy + f[1] * x[1]
        mean, half, shear = (xx + yy) / 2 / area, (xx - yy) / 2 / area, (xy + yx) / 2 / area
        pressed = math.hypot(half, shear) - mean
        least = [(0.43 * math.pi**2 * RIGIDITY / longest / pressed, "mean stress")] if pressed > 0 else []
        for i in range(4):
            if its["crease"][i] or its["crease"][i - 1]:
                continue
            diagonal = sub(p[(i + 2) % 4], p[i])
            load = dot(its["corner"][i], unit(diagonal))
            if load > 0:
                d = math.sqrt(dot(diagonal, diagonal))
                least.append((0.35 * (1 - NU) * RIGIDITY * d / area / load, "corner"))
        return min(least) if least else (math.inf, "none")

    def residual(self, panel):
        its = self.forces[panel]
        return max(abs(sum(f[k] for f in its["corner"] + its["edge"])) for k in range(2))


def nodes_of(n):
    """Numbers of the nodes of n x n S8R, by half steps (i, j)."""
    keys = [(i, j) for j in range(2 * n + 1) for i in range(2 * n + 1) if i % 2 == 0 or j % 2 == 0]
    return {key: k + 1 for k, key in enumerate(keys)}


def edge_nodes(numbers, n, edge):
    m = 2 * n
    walk = [lambda k: (k, 0), lambda k: (m, k), lambda k: (m - k, m), lambda k: (0, m - k)][edge]
    return [numbers[walk(k)] for k in range(m + 1)]


def panel_deck(sheet, panel, free, scale, n=ELEMENTS):
    its, p = sheet.forces[panel], [sheet.flat[v] for v in sheet.faces[panel]]
    numbers = nodes_of(n)
    text = "*NODE, NSET=ALL\n"
    for (i, j), k in numbers.items():
        u, v = i / (2 * n), j / (2 * n)
        x, y = ((1 - v) * ((1 - u) * p[0][d] + u * p[1][d]) + v * (u * p[2][d] + (1 - u) * p[3][d]) for d in range(2))
        text += f"{k},{x:.10e},{y:.10e},0.\n"
    text += "*ELEMENT, TYPE=S8R, ELSET=PANEL\n"
    element = 0
    for j in range(0, 2 * n, 2):
        for i in range(0, 2 * n, 2):
            element += 1
            around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
            text += f"{element}," + ",".join(str(numbers[i + a, j + b]) for a, b in around) + "\n"
    text += f"*MATERIAL, NAME=M\n*ELASTIC\n{E_MPA},{NU}\n*SHELL SECTION, ELSET=PANEL, MATERIAL=M\n{T_MM}\n"
    corner = [edge_nodes(numbers, n, i)[0] for i in range(4)]
    still = {corner[i] for i in range(4) if i != free}
    for i in range(4):
        if not its["crease"][i]:
            continue
        line = edge_nodes(numbers, n, i)
        if free not in (i, (i + 1) % 4):
            still.update(line)
            continue
        end = line[0] if free == i else line[-1]
        for k in range(1, 2 * n):
            share = 1 - k / (2 * n) if free == i else k / (2 * n)
            text += f"*EQUATION\n2\n{line[k]},3,1.,{end},3,{-share:.10g}\n"
    text += "*BOUNDARY\n" + "".join(f"{k},3,3\n" for k in sorted(still))
    text += f"{corner[0]},1,2\n{corner[1]},2,2\n"
    loads = {}
    for i in range(4):
        for d in range(2):
            loads[corner[i], d] = loads.get((corner[i], d), 0) + its["corner"][i][d]
        a, b = p[i], p[(i + 1) % 4]
        e, length = unit(sub(b, a)), math.dist(a, b)
        line, step = edge_nodes(numbers, n, i), length / n
        for k in range(n):
            # Quadratic elements: a uniform traction gives 1/6, 2/3, 1/6 of its force, a linear one by Simpson's rule.
            for place, weight in ((0, 1 / 6), (1, 2 / 3), (2, 1 / 6)):
                s = (k + place / 2) / n - 0.5
                across = 12 * its["moment"][i] * s / length**2
                for d in range(2):
                    traction = its["edge"][i][d] / length + across * (-e[1], e[0])[d]
                    key = line[2 * k + place], d
                    loads[key] = loads.get(key, 0) + traction * weight * step
    text += "*STEP\n*BUCKLE\n4,1e-4,40,5000\n*CLOAD\n"
    text += "".join(f"{k},{d + 1},{scale * load:.12e}\n" for (k, d), load in loads.items() if load)
    return text + "*NODE FILE\nU\n*END STEP\n"


def buckling_factors(folder, name, deck):
    with open(os.path.join(folder, name + ".inp"), "w") as file:
        file.write(deck)
    subprocess.run(["ccx", name], cwd=folder, capture_output=True, timeout=600,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    with open(os.path.join(folder, name + ".dat")) as file:
        text = file.read()
    return [float(x) for x in re.findall(r"^\s+\d+\s+(\S+)\s*$", text, re.M)]


def shifted(root, folder, name):
    """A copy of the pattern; one without shifts gets those of a ternary draw."""
    with open(os.path.join(root, "search", "patterns", name + ".json")) as file:
        pattern = json.load(file)
    if "file" in pattern:
        shutil.copy(os.path.join(root, "search", "patterns", pattern["file"]), folder)
    if "displacements_mm" not in pattern:
        draw = random.Random(57)
        pattern["displacements_mm"] = {f"A{7 * i + j + 1}": [draw.choice([-0.4, 0, 0.4]) for _ in range(2)]
                                       for i in range(1, 6) for j in range(1, 6)}
    path = os.path.join(folder, name + ".json")
    with open(path, "w") as file:
        json.dump(pattern, file)
    return path


def compare(program, folder, root):
    print("| sheet | at | panel | bound by | bound / CalculiX, least corner | program's factor |")
    print("|---|---|---|---|---|---|")
    worst = 0
    for name, from_deg in SHEETS:
        sheet = Sheet(program, folder, shifted(root, folder, name), name, from_deg)
        order = sorted(range(len(sheet.faces)), key=lambda k: sheet.bounds(k)[0])
        chosen = [k for k in order if sheet.bounds(k)[1] == "corner"][:3]
        chosen += [k for k in order if sheet.bounds(k)[1] == "mean stress"][:2]
        for panel in chosen:
            bound, kind = sheet.bounds(panel)
            least = math.inf
            for free in range(4):
                found = buckling_factors(folder, f"{name}-{from_deg}-{panel}-{free}",
                                         panel_deck(sheet, panel, free, bound))
                least = min([least] + [x for x in found if x > 0])
            worst = max(worst, 1 / least)
            its = sheet.factors[panel]
            print(f"| {name} | {from_deg}° | {sheet.places[panel]} | {kind} | {1 / least:.3f} | {bound / its - 1:+.1e} |",
                  flush=True)
    print(f"\nlargest bound over CalculiX: {worst:.3f}")


def held(node, vectors):
    """Equations of no motion along one or two vectors, each with a direct unknown of its own."""
    rows, leads = [list(v) for v in vectors], []
    for row in rows:
        lead = max((k for k in range(3) if k not in leads), key=lambda k: abs(row[k]))
        leads.append(lead)
        for other in rows:
            if other is not row:
                share = other[lead] / row[lead]
                other[:] = [a - share * b for a, b in zip(other, row)]
                other[lead] = 0.0
    text = ""
    for row, lead in zip(rows, leads):
        terms = [k for k in (lead, *(k for k in range(3) if k != lead)) if abs(row[k]) > 1e-12]
        text += f"*EQUATION\n{len(terms)}\n" + ",".join(f"{node},{k + 1},{row[k]:.10g}" for k in terms) + "\n"
    return text


def compare_sheets(program, folder, root, mesh):
    """The program's deck, springs replaced by their forces; six supports on the first panel, one for the fold angle."""
    print("| sheet | at | elements a side | least bound / CalculiX |\n|---|---|---|---|")
    for name, from_deg in SHEETS:
        pattern = shifted(root, folder, name)
        sheet = Sheet(program, folder, pattern, name, from_deg)
        out = os.path.join(folder, f"{name}-{from_deg}-sheet")
        shown(program, "export", pattern, "--format", "inp", "--from", str(from_deg), "--mesh", str(mesh),
              "--stiffness", str(SOFT_N_PER_MM), "--output", out)
        with open(os.path.join(out, name + ".inp")) as file:
            deck = file.read()
        springs = re.findall(r"TYPE=SPRINGA, ELSET=S\d+\n\d+,(\d+),(\d+)", deck)
        text = deck[:deck.index("*ELEMENT, TYPE=SPRINGA")]
        nodes = {int(a): [float(x) for x in b.split(",")]
                 for a, b in re.findall(r"^(\d+),(-?\d\.\d+e\S+)$", deck, re.M)}
        corners = [[int(n) for n in line.split(",")] for line in
                   re.search(r"NSET=CORNERS\n((?:[\d,]+\n)+)", deck).group(1).split()]
        first, second = (axes([nodes[n] for n in corners[k]]) for k in (0, 1))
        text += held(corners[0][1], first[1:]) + held(corners[0][3], first[2:]) + held(corners[1][1], second[2:])
        text += f"*BOUNDARY\n{corners[0][0]},1,3\n*STEP\n*BUCKLE\n4,1e-4,60,5000\n*CLOAD\n"
        bound = min(sheet.bounds(k)[0] for k in range(len(sheet.faces)))
        vertex = {n: v for face, its in zip(sheet.faces, corners) for v, n in zip(face, its)}
        loads = {}
        for a, b in ((int(a), int(b)) for a, b in springs):
            along = sub(nodes[b], nodes[a])
            length, flat = math.sqrt(dot(along, along)), math.dist(sheet.flat[vertex[a]], sheet.flat[vertex[b]])
            for node, sign in ((a, 1), (b, -1)):
                for k in range(3):
                    pull = sign * bound * SOFT_N_PER_MM * (length - flat) * along[k] / length
                    loads[node, k] = loads.get((node, k), 0) + pull
        text += "".join(f"{n},{k + 1},{load:.12e}\n" for (n, k), load in loads.items())
        found = buckling_factors(folder, f"{name}-{from_deg}-sheet", text + "*NODE FILE\nU\n*END STEP\n")
        print(f"| {name} | {from_deg}° | {mesh} | {1 / min(x for x in found if x > 0):.3f} |", flush=True)


if __name__ == "__main__":
    folder = os.path.abspath(sys.argv[2])
    os.makedirs(folder, exist_ok=True)
    program, root = os.path.abspath(sys.argv[1]), os.path.abspath(os.path.join(os.path.dirname(__file__), "../.."))
    if "--sheet" in sys.argv:
        compare_sheets(program, folder, root, 4)
    else:
        compare(program, folder, root)
