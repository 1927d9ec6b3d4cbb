#!/usr/bin/python3
"""Candidates' studies again, from vertex coordinates alone: coordinates.py PROGRAM FOLDER [--each N] [--only NAME]

For N candidates of each plain campaign: the sheet is written as a FOLD mesh with displacements, moved by
(-3000, 2000) mm and turned by 37 degrees, and `deploy` and `actuators` of it are compared with numbers that are
found here. The unknowns are where vertices lie in space, the equations that panels keep their sides, a
diagonal and their flatness; no fold angle but the pilot's, no loop, no joint is known. Starts are taken from the
folded frames of an export, from which Newton's method goes on. Prints the largest differences, relative to the
largest number found where no unit is said; exit code 1 where one is beyond its allowance.
"""
import argparse, json, math, pathlib, subprocess, sys

import numpy as np

FROM_DEG, STIFFNESS, AREA_DENSITY = 36.0, 50.0, 1.0 * 2.7e-9  # N/mm, t/mm^2: what `deploy` takes by default
TURN, MOVE = math.radians(37), np.array([-3000.0, 2000.0])
# Ten times and more above what rounding and the interpolation of this file leave.
ALLOWED = {"energy at 36 deg": 1e-7, "time to flat": 1e-7, "moment that holds it": 1e-6, "forces of ball joints": 1e-6,
           "mechanical advantage": 1e-6, "elongations, mm": 1e-9, "D, deg": 0}
CAMPAIGNS = {  # draws that leave some hundreds of candidates
    "miura-4x4": 2000, "miura-6x6": 600000, "ring-6x6": 400000, "miura-8x6": 40000, "miura-8x8": 400000,
    "miura-graded-6x6": 400000, "miura-wide-6x6": 400000, "miura-narrow-6x6": 400000,
    "double-corrugation-6x6": 400000, "turned-quads-6x6": 400000, "angle-array-6x6-90": 200000}


def run(*words):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout


class Sheet:
    """A shifted sheet as panels; `points` are where its vertices are now, [vertices, 3], in mm."""

    def __init__(self, fold):
        self.flat = np.pad(np.array(fold["vertices_coords"], float)[:, :2], ((0, 0), (0, 1)))
        self.panels = np.array(fold["faces_vertices"])
        edges = {tuple(sorted((f[i], f[(i + 1) % 4]))) for f in self.panels.tolist() for i in range(4)}
        self.bars = np.array(sorted(edges) + [(f[0], f[2]) for f in self.panels.tolist()])
        self.bar_mm = self.distance(self.flat, self.bars)
        self.diagonals = np.array([[int(d[k][1:]) - 1 for k in ("from", "to")]
                                   for d in fold["misalign:data"]["diagonals"]])
        self.relaxed_mm = self.distance(self.flat, self.diagonals)
        side = {(f[i], f[(i + 1) % 4]): k for k, f in enumerate(self.panels.tolist()) for i in range(4)}
        self.creases = np.array([(a, b, side[a, b], side[b, a]) for a, b in sorted(side) if a < b and (b, a) in side])
        for e, letter, angle in zip(fold["edges_vertices"], fold["edges_assignment"],
                                    fold["file_frames"][0]["edges_foldAngle"]):
            if letter in "MV" and abs(abs(angle) - 10) < 1e-9:  # the first frame is at 10 degrees of the pilot
                self.pilot = e
                self.sign = math.copysign(1, angle)
                break
        a, b = self.pilot
        left, right = (self.panels[side[e]].tolist() for e in ((a, b), (b, a)))
        self.ground = left  # lies as it lay flat
        self.swung = [v for v in right if v not in (a, b)][0]

    @staticmethod
    def distance(points, pairs):
        return np.linalg.norm(points[pairs[:, 1]] - points[pairs[:, 0]], axis=1)

    def normal(self, deg):
        """Of the panel right of the pilot: z turned by minus the fold angle about a -> b; and its rate by the angle."""
        a, b = self.flat[self.pilot[0]], self.flat[self.pilot[1]]
        axis, up, rho = (b - a) / np.linalg.norm(b - a), np.array([0, 0, 1.0]), -self.sign * math.radians(deg)
        side = np.cross(axis, up)
        return (math.cos(rho) * up + math.sin(rho) * side,
                -self.sign * (-math.sin(rho) * up + math.cos(rho) * side))

    def equations(self, points, deg):
        """Residuals and Jacobian: bars, flatness, ground (6), pilot last; 3 V of them."""
        n, rows = len(points), len(self.bars) + len(self.panels) + 7
        f, j = np.zeros(rows), np.zeros((rows, n, 3))
        apart = points[self.bars[:, 1]] - points[self.bars[:, 0]]
        length = np.linalg.norm(apart, axis=1)
        k = np.arange(len(self.bars))
        f[k] = length - self.bar_mm
        j[k, self.bars[:, 1]] = apart / length[:, None]
        j[k, self.bars[:, 0]] = -apart / length[:, None]
        k = len(self.bars) + np.arange(len(self.panels))
        p = points[self.panels]
        a, b, c = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]
        scale = 1 / np.linalg.norm(np.cross(b, c), axis=1)  # about a distance from the plane
        by = [np.cross(b, c), np.cross(c, a), np.cross(a, b)]
        f[k] = np.einsum("ij,ij->i", a, by[0]) * scale
        for corner, gradient in zip((1, 2, 3), by):
            j[k, self.panels[:, corner]] = gradient * scale[:, None]
        j[k, self.panels[:, 0]] = -sum(by) * scale[:, None]
        g, row = self.ground, rows - 7
        for v, coordinates in ((g[0], (0, 1, 2)), (g[1], (1, 2) if abs((self.flat[g[1]] - self.flat[g[0]])[0]) > 1 else (0, 2)), (g[2], (2,))):
            for i in coordinates:
                f[row] = points[v, i] - self.flat[v, i]
                j[row, v, i] = 1
                row += 1
        normal, rate = self.normal(deg)
        arm = points[self.swung] - self.flat[self.pilot[0]]
        f[row], j[row, self.swung] = normal @ arm, normal
        return f, j.reshape(rows, 3 * n), rate @ arm

    def solve(self, points, deg):
        for _ in range(30):
            f, j, _ = self.equations(points, deg)
            step = np.linalg.solve(j, f).reshape(points.shape)
            points = points - step
            if abs(step).max() < 1e-11 * 1000:
                f, j, by_pilot = self.equations(points, deg)
                points = points - np.linalg.solve(j, f).reshape(points.shape)
                right = np.zeros(len(f))
                right[-1] = -by_pilot
                return points, np.linalg.solve(j, right).reshape(points.shape), j  # rate per rad
        raise RuntimeError("Newton's method on coordinates does not converge")

    def start(self, points, deg):
        """From a guess near the state at this pilot angle."""
        self.points, self.rates, self.jacobian = self.solve(self.brought_here(points), deg)
        self.deg, self.bend = deg, np.zeros_like(points)

    def go_to(self, deg, longest=5.0):
        """Along the path, predicted by its rates and how they changed last."""
        while self.deg != deg:
            far = deg - self.deg
            to = deg if abs(far) <= longest else self.deg + math.copysign(longest, far)
            h, before = math.radians(to - self.deg), self.rates
            guess = self.points + h * before + h * h / 2 * self.bend
            self.points, self.rates, self.jacobian = self.solve(guess, to)
            self.bend, self.deg = (self.rates - before) / h, to
            if not abs(self.rates).max() < 1e6:
                raise RuntimeError('the pilot stands still')

    def brought_here(self, points):
        """A guess laid onto the ground panel."""
        g = np.array(self.ground)
        a, b = points[g], self.flat[g]
        u, _, vt = np.linalg.svd((a - a.mean(0)).T @ (b - b.mean(0)))
        d = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
        return (points - a.mean(0)) @ (u @ d @ vt) + b.mean(0)

    def sides(self):
        """To which side each crease is folded, -1 or 1: it changes where the crease passes 0 or 180 degrees."""
        p = self.points[self.panels]
        normals = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
        a, b, left, right = self.creases.T
        return np.sign(np.einsum("ij,ij->i", np.cross(normals[left], normals[right]), self.points[b] - self.points[a]))

    def stretch(self, points):
        return self.distance(points, self.diagonals) - self.relaxed_mm

    def stretch_rates(self, points, rates):
        apart = points[self.diagonals[:, 1]] - points[self.diagonals[:, 0]]
        moving = rates[self.diagonals[:, 1]] - rates[self.diagonals[:, 0]]
        return np.einsum("ij,ij->i", apart, moving) / np.linalg.norm(apart, axis=1)

    def mass(self, points, rates):
        """Twice the kinetic energy at one rad/s, least over all rigid motions that may be added (t mm^2)."""
        n = len(points)
        mass = np.zeros((n, n))
        for f in self.panels:
            for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3])):
                area = np.linalg.norm(np.cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) / 2
                mass[np.ix_(t, t)] += AREA_DENSITY * area / 12 * (np.ones((3, 3)) + np.eye(3))
        centred = points - points.mean(0)
        rigid = [np.tile(e, (n, 1)) for e in np.eye(3)] + [np.cross(e, centred) / 100 for e in np.eye(3)]
        product = lambda a, b: float(np.einsum("ik,ij,jk->", a, mass, b))
        gram = np.array([[product(a, b) for b in rigid] for a in rigid])
        best = np.linalg.solve(gram, [product(a, rates) for a in rigid])
        left = rates - sum(x * a for x, a in zip(best, rigid))
        return product(left, left)

    def ball_forces(self, points, jacobian, corners):
        """|force| at each (vertex, panel), the sheet held by its pilot; and the holding moment."""
        loads = np.zeros_like(points)
        pull = STIFFNESS * self.stretch(points)
        apart = points[self.diagonals[:, 1]] - points[self.diagonals[:, 0]]
        for (a, b), f, d in zip(self.diagonals, pull, apart / np.linalg.norm(apart, axis=1)[:, None]):
            loads[a] += f * d
            loads[b] -= f * d
        members = np.linalg.solve(jacobian.T, -loads.ravel())
        forces = []
        for v, panel in corners:
            f, total = self.panels[panel], np.zeros(3)
            sides = {tuple(sorted((f[i], f[(i + 1) % 4]))) for i in range(4)} | {(f[0], f[2])}
            for k, bar in enumerate(self.bars):
                if v in bar and (tuple(bar) in sides or (k >= len(self.bars) - len(self.panels) and tuple(bar) == (f[0], f[2]))):
                    total += members[k] * jacobian[k].reshape(-1, 3)[v]
            k = len(self.bars) + panel
            total += members[k] * jacobian[k].reshape(-1, 3)[v]
            forces.append(np.linalg.norm(total + loads[v] / 2))  # the spring's half is not the joint's
        return np.array(forces), members[-1]


def moved(fold):
    """The pattern file of the moved, turned sheet: its base as a mesh, its displacements."""
    turn = np.array([[math.cos(TURN), -math.sin(TURN)], [math.sin(TURN), math.cos(TURN)]])
    base, shifts = np.array(fold["vertices_coords"], float)[:, :2], {}
    for label, shift in fold["misalign:pattern"].get("displacements_mm", {}).items():
        base[int(label[1:]) - 1] -= shift
        shifts[label] = (turn @ shift).tolist()
    mesh = {k: fold[k] for k in ("file_spec", "edges_vertices", "edges_assignment", "faces_vertices")}
    mesh["vertices_coords"] = (base @ turn.T + MOVE).tolist()
    return {"family": "fold", "mesh": mesh, "displacements_mm": shifts}


def deploys_from(stretches):
    """The last degree up to which every diagonal goes on as it began, steps of less than 8e-11 mm left aside."""
    before, directions = np.zeros(len(stretches[1])), np.zeros(len(stretches[1]))
    for deg in sorted(stretches):
        step = stretches[deg] - before
        step[abs(step) < 8e-11] = 0
        if np.any(step * directions < 0):
            return deg - 1
        directions[directions == 0] = np.sign(step[directions == 0])
        before = stretches[deg]
    return max(stretches)


class Compared:
    """Largest differences, and where."""

    def __init__(self):
        self.worst, self.sheets = {}, 0

    def see(self, what, found, wanted, where, scale=None):
        found, wanted = np.atleast_1d(np.asarray(found, float)), np.atleast_1d(np.asarray(wanted, float))
        off = float(np.max(abs(found - wanted) / (np.max(abs(wanted)) if scale is None else scale)))
        if not off <= self.worst.get(what, (-1, ""))[0]:
            self.worst[what] = (off, where)


def compare(program, folder, fold, compared, where):
    sheet = Sheet(fold)
    pattern = moved(fold)
    pattern["pilot"] = "A%d-A%d" % tuple(v + 1 for v in sorted(sheet.pilot))
    file = folder / "moved.json"
    file.write_text(json.dumps(pattern))
    told = json.loads(run(program, "deploy", file, "--json", "--forces", "held", "--from", FROM_DEG))
    acts = json.loads(run(program, "actuators", file, "--json"))

    frames = [f for f in fold["file_frames"] if "vertices_coords" in f]
    pilot_at = fold["edges_vertices"].index(list(sheet.pilot))
    angle = lambda f: abs(f["edges_foldAngle"][pilot_at])
    start = min(frames, key=lambda f: abs(angle(f) - FROM_DEG))
    sheet.start(np.array(start["vertices_coords"], float), angle(start))
    # Even functions of the angle: interpolated in its square, through Chebyshev's points.
    count, least = 14, 2.0
    squares = [(FROM_DEG**2 + least**2) / 2 + (FROM_DEG**2 - least**2) / 2 * math.cos(math.pi * (k + .5) / count)
               for k in range(count)]
    nodes, states = [FROM_DEG] + [math.sqrt(s) for s in squares], {}
    for node in nodes:
        sheet.go_to(node)
        states[node] = (sheet.points, sheet.rates)
    energy_of = lambda p: STIFFNESS / 2 * float(np.sum(sheet.stretch(p) ** 2))
    x = np.array(squares)
    to_unit = lambda s: (2 * s - FROM_DEG**2 - least**2) / (FROM_DEG**2 - least**2)
    fit = lambda y: np.polynomial.chebyshev.chebfit(to_unit(x), y, count - 1)
    value = lambda c, deg: np.polynomial.chebyshev.chebval(to_unit(np.asarray(deg) ** 2), c)
    lengths = fit(np.array([sheet.stretch(states[n][0]) / n**2 for n in nodes[1:]]))
    mass = fit(np.array([sheet.mass(*states[n]) for n in nodes[1:]]))
    energy = lambda deg: STIFFNESS / 2 * np.sum((value(lengths, deg) * np.asarray(deg) ** 2) ** 2, axis=0)
    start_energy = energy_of(states[FROM_DEG][0])
    compared.see("energy at 36 deg", told["energy_n_mm"][0], start_energy, where)
    # deg = 36 (1 - u^2): smooth at the start, where the sheet stands still
    u, weight = np.polynomial.legendre.leggauss(40)
    u, weight = (u + 1) / 2, weight / 2
    deg = FROM_DEG * (1 - u**2)
    speed = np.sqrt(2 * (start_energy - energy(deg)) / value(mass, deg))
    time_s = float(np.sum(weight * 2 * u * math.radians(FROM_DEG) / speed))
    compared.see("time to flat", told["deploy_time_s"], time_s, where)

    forces = told["forces"]
    corner = lambda joint: (int(joint["vertex"][1:]) - 1)
    for goal in (36.0, 20.0, 10.0):
        row = int(np.argmin(abs(np.array(forces["pilot_deg"]) - goal)))
        at = abs(forces["pilot_deg"][row])
        near = min(states, key=lambda n: abs(n - at))
        points, rates, jacobian = sheet.solve(states[near][0] + states[near][1] * math.radians(at - near), at)
        joints = []
        for joint in forces["ball_joints"]:
            v = corner(joint)
            joints.append((v, [k for k, f in enumerate(sheet.panels) if v in f][-1]))
        found, _ = sheet.ball_forces(points, jacobian, joints)
        moment = STIFFNESS * float(sheet.stretch(points) @ sheet.stretch_rates(points, rates))
        compared.see("moment that holds it", abs(forces["holding_n_mm"][row]), abs(moment), where)
        if joints:
            told_n = [np.linalg.norm(j["force_n"][row]) for j in forces["ball_joints"]]
            compared.see("forces of ball joints", told_n, found, where)

    # The advantage along the path, up to D.
    d_deg = told["deploys_from_deg"]
    wide = sheet.flat[:, None] - sheet.flat[None]
    wide = np.linalg.norm(wide, axis=2)
    span = np.unravel_index(np.argmax(wide > wide.max() * (1 - 1e-9)), wide.shape)
    history = acts["history"]
    angles = history["pilot_deg"]
    sheet.start(states[FROM_DEG][0], FROM_DEG)
    rows = {round(a): k for k, a in enumerate(angles)}
    stretches, sides = {}, sheet.sides()
    for path in (range(int(FROM_DEG), 0, -1), range(int(FROM_DEG), int(d_deg) + 2)):
        sheet.start(states[FROM_DEG][0], FROM_DEG)
        for at in path:
            try:
                sheet.go_to(at, 5.0 if at < d_deg - 5 else 0.25)
            except (RuntimeError, np.linalg.LinAlgError):
                break  # there is a fold limit
            if at < 180 and np.any(sheet.sides() != sides):
                break  # a crease has gone over to its other side
            stretches[at] = sheet.stretch(sheet.points)
            if at < FROM_DEG or at > d_deg or (at % 10 and at < d_deg - 3):
                continue
            apart, moving = [a[span[1]] - a[span[0]] for a in (sheet.points, sheet.rates)]
            turning = np.sum(abs(sheet.stretch_rates(sheet.points, sheet.rates)))
            advantage = turning / abs(apart @ moving / np.linalg.norm(apart))
            compared.see("mechanical advantage", history["mechanical_advantage"][rows[at]], advantage, where)
            told_n = [f["history_n"][rows[at]] for f in acts["forces"]]
            compared.see("elongations, mm", np.array(told_n) / STIFFNESS, stretches[at], where, 1)
    compared.see("D, deg", d_deg, deploys_from(stretches), where, 1)
    compared.sheets += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--each", type=int, default=200, help="candidates of each campaign [200]")
    parser.add_argument("--only", action="append", help="this campaign (again: and that one)")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    wrong = 0
    campaigns = pathlib.Path(__file__).resolve().parents[2] / "search" / "campaigns"
    for name, draws in CAMPAIGNS.items():
        if options.only and name not in options.only:
            continue
        catalogue = options.folder / (name + ".db")
        run(options.program, "search", campaigns / (name + ".json"), "--draws", draws, "--catalogue", catalogue,
            "--progress", "none")
        out = options.folder / name
        run(options.program, "export", catalogue, "--where",
            f"draw IN (SELECT draw FROM candidates ORDER BY draw LIMIT {options.each})", "--format", "fold",
            "--output", out)
        compared, lost = Compared(), []
        for file in sorted(out.glob("*.fold"))[:options.each]:
            try:
                compare(options.program, options.folder, json.loads(file.read_text()), compared, file.stem)
            except RuntimeError as error:
                lost.append(f"{file.stem}: {error}")
        print(f"{name}: {compared.sheets} sheets, {len(lost)} not compared")
        for what, (off, where) in compared.worst.items():
            beyond = not off <= ALLOWED[what]
            wrong += beyond
            print(f"  {what:24} {off:.2g}  ({where}){'  beyond ' + str(ALLOWED[what]) if beyond else ''}")
        wrong += len(lost)
        for line in lost[:5]:
            print("  " + line.strip()[:200])
        sys.stdout.flush()
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
