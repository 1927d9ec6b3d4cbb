#!/usr/bin/env python3
"""Static CalculiX beside `misalign deploy --panels bend`: static.py PROGRAM DIRECTORY run|table|cases [SHEET or CASE...]
static.py PROGRAM DIRECTORY check PATTERN.json MM N_PER_MM PRELOAD_N DEG...

Each case is a sheet folded without stress to an angle, with springs on its diagonals that are relaxed on the flat sheet,
and panels that bend: the deck of `misalign export --format inp` with a static step instead of its motion. What is held is
the sum over the creases of length times fold angle, to first order, by one equation over the corners of all panels. `run`
leaves DIRECTORY/CASE.json of each case; with a preload (-f, N) springs have that force at flat. `table` computes the
program's energies at the sum that ccx's state has, and prints the comparison.
"""
import json
import os
import random
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
SHEETS = sorted(path.stem for path in (HERE / "sheets").glob("*.json"))
MESH = 4
# Springs pull from the start on, so one increment is all; its residuals rise before they fall.
PATIENCE = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n30,40,9,100,10,4,,10\n"
LONGEST_S = 150


def cases():
    """A hundred of the 60 a sheet, drawn before the first run: name, sheet, mm, N/mm, degrees, N. Then sixteen with a
    preload, of about what is best for each thickness."""
    draw, found = random.Random(38), []
    every = [(t, k, a) for t in (0.5, 1, 2, 4) for k in (5, 20, 50) for a in (10, 20, 36, 60, 90)]
    for i, sheet in enumerate(SHEETS):
        for t, k, a in draw.sample(every, 13 if i % 2 == 0 else 12):
            found.append((f"{sheet}-t{t:g}-k{k:g}-a{a:g}", sheet, t, k, a, 0))
    draw = random.Random(39)
    preloaded = [(t, k, a, 0.05 * t ** 3) for t in (1, 2, 4) for k in (5, 20) for a in (10, 20, 36)]
    for sheet in SHEETS:
        for t, k, a, n in draw.sample(preloaded, 2):
            found.append((f"{sheet}-t{t:g}-k{k:g}-a{a:g}-f{n:g}", sheet, t, k, a, n))
    return found


class Deck:
    """The parts of an exported deck that are needed here."""

    def __init__(self, text, preload=0):
        def preloaded(match):
            head, f1, u1, f2, u2 = match.groups()
            more = preload * np.sign(float(f1) + float(f2))  # those that are longer than flat pull
            return f"{head}{float(f1) + more!r},{u1}\n{float(f2) + more!r},{u2}\n"

        if preload:
            text = re.sub(r"(\*SPRING.*\n\n)(.*),(.*)\n(.*),(.*)\n", preloaded, text)
        self.head = text[: text.index("*STEP")]
        nodes = re.search(r"\*NODE, NSET=NALL\n((?:\d.*\n)+)", text)[1].split()
        self.at = {int(n): np.array([float(v) for v in xyz]) for n, *xyz in (line.split(",") for line in nodes)}
        corners = re.search(r"\*NSET, NSET=CORNERS\n((?:\d.*\n)+)", text)[1].split()
        self.panels = [[int(n) for n in line.split(",")] for line in corners]
        self.node_of, places = {}, []  # each corner's first node at the same place
        for node in sum(self.panels, []):
            same = [n for n in places if np.linalg.norm(self.at[n] - self.at[node]) < 1e-5]
            self.node_of[node] = same[0] if same else node
            if not same:
                places.append(node)
        self.vertices = places
        self.springs = []  # nodes, stiffness, how far it is pulled at the start
        for a, b, f1, u1, f2, u2 in re.findall(
                r"TYPE=SPRINGA.*\n\d+,(\d+),(\d+)\n\*SPRING.*\n\n(.*),(.*)\n(.*),(.*)\n", text):
            stiffness = (float(f2) - float(f1)) / (float(u2) - float(u1))
            self.springs.append((self.node_of[int(a)], self.node_of[int(b)], stiffness,
                                 float(f1) / stiffness - float(u1)))
        self.folds = []  # two panels, and the length of the crease between them
        for i, one in enumerate(self.panels):
            for j in range(i):
                both = {self.node_of[n] for n in one} & {self.node_of[n] for n in self.panels[j]}
                if len(both) == 2:
                    a, b = both
                    self.folds.append((j, i, np.linalg.norm(self.at[a] - self.at[b])))

    def turned(self, moved):
        """Sum of length times fold angle (mm) with vertices moved by these; between the panels' mean normals."""
        normals = []
        for panel in self.panels:
            p = [self.at[self.node_of[n]] + moved[self.node_of[n]] for n in panel]
            normal = np.cross(p[2] - p[0], p[3] - p[1])
            normals.append(normal / np.linalg.norm(normal))
        return sum(length * np.arctan2(np.linalg.norm(np.cross(normals[i], normals[j])), normals[i] @ normals[j])
                   for i, j, length in self.folds)

    def still(self):
        return {n: np.zeros(3) for n in self.vertices}

    def gradient(self):
        gradient, step, moved = {}, 1e-4, self.still()
        for n in self.vertices:
            for d in range(3):
                moved[n][d] = step
                above = self.turned(moved)
                moved[n][d] = -step
                gradient[n, d + 1] = (above - self.turned(moved)) / (2 * step)
                moved[n][d] = 0
        return gradient

    def supports(self):
        """Of the first panel: as many as hold it still."""
        a, b, _, d = self.panels[0]
        along, other = self.at[b] - self.at[a], self.at[d] - self.at[a]
        free = int(np.argmax(abs(along)))
        normal = int(np.argmax(abs(np.cross(along, other))))
        return [(a, 1), (a, 2), (a, 3)] + [(b, k + 1) for k in range(3) if k != free] + [(d, normal + 1)]

    def static(self):
        held = self.supports()
        terms = sorted(((g, at) for at, g in self.gradient().items() if at not in held and abs(g) > 1e-9),
                       key=lambda term: -abs(term[0]))
        text = self.head + f"*EQUATION\n{len(terms)}\n"
        for first in range(0, len(terms), 4):
            text += ",".join(f"{n},{d},{g:.12e}" for g, (n, d) in terms[first:first + 4]) + "\n"
        text += "*BOUNDARY\n" + "".join(f"{n},{d},{d}\n" for n, d in held)
        text += "*STEP, NLGEOM, INC=300\n" + PATIENCE + "*STATIC\n1.,1.,1e-3,1.\n"
        return text + "*NODE PRINT, NSET=CORNERS\nU\n*EL PRINT, ELSET=PANELS, TOTALS=ONLY\nELSE\n*END STEP\n"

    def read(self, dat):
        """The last state: its time, energies and what it has turned by."""
        blocks = re.split(r"\n displacements .* time +(\S+)\n", dat)
        if len(blocks) < 3:
            return None
        moved = self.still()
        for node, *u in re.findall(r"^ +(\d+) +(\S+) +(\S+) +(\S+)$", blocks[-1], re.M):
            moved[self.node_of[int(node)]] = np.array([float(v) for v in u])
        strain = re.search(r"internal energy.*\n\n +(\S+)", blocks[-1])
        if not strain:
            return None
        pulled = 0
        for a, b, stiffness, start in self.springs:
            longer = np.linalg.norm(self.at[a] + moved[a] - self.at[b] - moved[b]) - np.linalg.norm(self.at[a] - self.at[b])
            pulled += stiffness / 2 * (start + longer) ** 2
        rigid = sum(stiffness / 2 * start ** 2 for _, _, stiffness, start in self.springs)
        return {"time": float(blocks[-2]), "panels_n_mm": float(strain[1]), "springs_n_mm": pulled,
                "rigid_n_mm": rigid, "rigid_turned_mm": self.turned(self.still()), "turned_mm": self.turned(moved),
                "largest_mm": max(np.linalg.norm(u) for u in moved.values())}


def state_of(program, directory, path, t, k, a, n):
    """What CalculiX finds; its files are taken away again."""
    directory.mkdir(parents=True, exist_ok=True)
    subprocess.run([program, "export", path, "--format", "inp", "--from", str(a), "--mesh", str(MESH), "--thickness", str(t),
                    "--stiffness", str(k), "--preload", "0", "--output", directory], check=True, capture_output=True)
    deck = Deck((directory / f"{Path(path).stem}.inp").read_text(), n)
    job = directory / "static"
    job.with_suffix(".inp").write_text(deck.static())
    done = subprocess.run(["timeout", str(LONGEST_S), "ccx", "static"], cwd=directory,
                          env=os.environ | {"OMP_NUM_THREADS": "1"}, capture_output=True, text=True)
    dat = job.with_suffix(".dat")
    found = deck.read(dat.read_text()) if dat.exists() else None
    if not found or found["time"] < 1 - 1e-9:
        found = {"time": found["time"] if found else 0, "failed": done.stdout[-300:]}
    for file in directory.iterdir():
        file.unlink()
    directory.rmdir()
    return found


def run(program, directory, chosen):
    rank = {name: sum(other[1] == sheet for other in cases()[:i]) for i, (name, sheet, *_) in enumerate(cases())}
    for name, sheet, *case in sorted(cases(), key=lambda case: rank[case[0]]):  # a case of each sheet, and again
        result = directory / f"{name}.json"
        if result.exists() or (chosen and not {sheet, name} & set(chosen)):
            continue
        found = state_of(program, directory / name, HERE / "sheets" / f"{sheet}.json", *case)
        result.write_text(json.dumps(found) + "\n")
        print(name, found, flush=True)


def told(program, path, t, k, a, n):
    """The program's energy, its change by the creases' sum, and its method."""
    out = subprocess.run([program, "deploy", path, "--panels", "bend", "--json", "--from", str(a), "--thickness", str(t),
                          "--stiffness", str(k), "--preload", str(n)], check=True, capture_output=True, text=True).stdout
    bent = json.loads(out)["bent"]
    return bent["bent_energy_n_mm"], bent["margins"][0]["available_n_mm_per_mm"], bent["method"], bent["angles_not_converged"]


def compare(program, path, found, t, k, a, n):
    """A row of the table, the method, and by what share the program is off."""
    energy, moment, method, unsure = told(program, path, t, k, a, n)
    energy += moment * (found["turned_mm"] - found["rigid_turned_mm"])
    calculix = found["panels_n_mm"] + found["springs_n_mm"]
    off = energy / calculix - 1
    sure = f" ({unsure} angles not converged)" if unsure else ""
    return (f"| {Path(path).stem} | {t:g} | {k:g} | {n:g} N | {a:g}° | {found['rigid_n_mm']:.4g} | {calculix:.5g} | {energy:.5g} "
            f"| {method}{sure} | {100 * off:+.1f} % |"), method, off


HEAD = "| sheet | t mm | k N/mm | at flat | from | rigid N mm | CalculiX | program | method | off |\n" + 10 * "|---" + "|"


def check(program, directory, path, t, k, n, *angles):
    """One sheet at some angles."""
    print(HEAD)
    for a in angles:
        found = state_of(program, directory / "check", path, t, k, a, n)
        print(f"ccx did not converge at {a:g}°" if "failed" in found else compare(program, path, found, t, k, a, n)[0],
              flush=True)


def table(program, directory):
    print(HEAD)
    off, lost, missing = {}, [], []
    for name, sheet, t, k, a, n in cases():
        result = directory / f"{name}.json"
        found = json.loads(result.read_text()) if result.exists() else None
        if not found or "failed" in found:
            (lost if found else missing).append(name)
            continue
        row, method, share = compare(program, HERE / "sheets" / f"{sheet}.json", found, t, k, a, n)
        off.setdefault("preload" if n else method, []).append((share, name))
        print(row)
    off["all"] = sum(off.values(), [])
    print()
    for method, each in off.items():
        worst = max(each, key=lambda one: abs(one[0]))
        rms = np.sqrt(np.mean([one[0] ** 2 for one in each]))
        print(f"{method}: {len(each)} cases, rms {100 * rms:.2f} %, most {100 * worst[0]:+.1f} % ({worst[1]})")
    print(f"\nCalculiX did not converge: {len(lost)}: " + ", ".join(lost))
    print(f"\nnot run: {len(missing)}: " + ", ".join(missing))


if __name__ == "__main__":
    program, directory, what, *chosen = sys.argv[1:]
    Path(directory).mkdir(parents=True, exist_ok=True)
    if what == "cases":
        print("\n".join(name for name, *_ in cases()))
    elif what == "run":
        run(str(Path(program).resolve()), Path(directory).resolve(), chosen)
    elif what == "check":
        check(str(Path(program).resolve()), Path(directory).resolve(), Path(chosen[0]).resolve(), *map(float, chosen[1:]))
    elif what == "table":
        table(str(Path(program).resolve()), Path(directory).resolve())
