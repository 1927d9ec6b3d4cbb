#!/usr/bin/env python3
"""Tables of elastic.md and its pictures, from what elastic.sh left: elastic.py DIRECTORY.

Standard library only.
"""

import json
import os
import sys
from html import escape

HERE = os.path.dirname(os.path.abspath(__file__))
# Okabe and Ito's palette.
BLACK, ORANGE, GREEN, BLUE, RED, PURPLE = "#000000", "#E69F00", "#009E73", "#0072B2", "#D55E00", "#CC79A7"
INK, PALE = "#222222", "#E3E3E3"
OUTER = (0, 5)  # rows and columns of the perimeter's panels


def read(runs, name):
    path = os.path.join(runs, name, "table1-stress.json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def largest(run, perimeter):
    return max((panel["outside_discs_mpa"], panel["panel"]) for panel in run["panels"]
               if any(k in OUTER for k in panel["panel"]) == perimeter)


def stress_row(name, run):
    outside, anywhere = run["largest_outside_discs"], run["largest_anywhere_mesh_dependent"]
    first = max(mpa for t, mpa in zip(run["stress"]["time_s"], run["stress"]["outside_discs_mpa"]) if t < 0.00201)
    outer_mpa, outer = largest(run, True)
    return (f"| {name} | {run['motion']['time_s'][-1] * 1e3:.3g} ms | {first:.1f} | {outside['stress_mpa']:.1f} | "
            f"{outside['time_s'] * 1e3:.2f} ms | {outside['panel']} ({outside['x_mm']:.0f}, {outside['y_mm']:.0f}) | "
            f"{outer_mpa:.1f} {outer} | {anywhere['stress_mpa']:.1f} {anywhere['panel']} | "
            f"{len(run['motion']['time_s']) - 1} | {run['cpu_s']:.0f} | {run['memory_mb']:.0f} |")


def stress_table(runs, names):
    print("| run | until | within 2 ms | outside discs | after | panel (x, y mm) | of the perimeter | anywhere | "
          "increments | CPU s | MB |\n" + "|---" * 11 + "|")
    for name in names:
        run = read(runs, name)
        if run:
            print(stress_row(name, run))
    print()


def at(times, values, time):
    """Straight between rows; None beyond them."""
    for k in range(1, len(times)):
        if times[k - 1] <= time <= times[k]:
            share = (time - times[k - 1]) / (times[k] - times[k - 1])
            return values[k - 1] + share * (values[k] - values[k - 1])
    return None


def passed(times, values, angle):
    """When the angle falls below for the first time."""
    for k in range(1, len(times)):
        if values[k] < angle <= values[k - 1]:
            return times[k - 1] + (values[k - 1] - angle) / (values[k - 1] - values[k]) * (times[k] - times[k - 1])
    return None


def stiff_table(runs):
    print("| E, GPa | 30° after | 20° | 10° | largest difference to 95 ms | springs keep | increments | CPU s |\n"
          + "|---" * 8 + "|")
    shown = lambda time: f"{time:.5f} s" if time else "–"
    rigid = None
    for e_gpa in (70, 700, 7000, 70000, 700000):
        run = read(runs, f"stiff-{e_gpa}")
        if not run:
            continue
        motion, rigid = run["motion"], run["rigid_motion"]
        times, angles = motion["time_s"], motion["pilot_deg"]
        apart = max(abs(angle - at(rigid["time_s"], rigid["pilot_deg"], time))
                    for time, angle in zip(times, angles) if time <= 0.095)
        early = [n for t, n in zip(times, motion["springs_n_mm"]) if 0.001 <= t <= 0.01]
        kept = sum(early) / len(early) / motion["springs_n_mm"][0]
        print(f"| {e_gpa} | " + " | ".join(shown(passed(times, angles, angle)) for angle in (30, 20, 10)) +
              f" | {apart:.2f}° | {100 * kept:.0f} % | {len(times) - 1} | {run['cpu_s']:.0f} |")
    if rigid:
        print("| rigid | " + " | ".join(shown(passed(rigid["time_s"], rigid["pilot_deg"], angle))
                                       for angle in (30, 20, 10)) + " | | | | |")
    print()


def stop_table(runs):
    print("| E, GPa | from | mean over the last tenth | least | most | energy left, N mm | increments | CPU s |\n"
          + "|---" * 8 + "|")
    for e_gpa in (70, 7000):
        for start in (15, 36):
            run = read(runs, f"stop-{start}-{e_gpa}")
            if not run:
                continue
            motion = run["motion"]
            times = motion["time_s"]
            last = [angle for time, angle in zip(times, motion["pilot_deg"]) if time >= 0.9 * times[-1]]
            left = sum(motion[key][-1] for key in ("springs_n_mm", "bending_n_mm", "kinetic_n_mm"))
            print(f"| {e_gpa} | {start}° | {sum(last) / len(last):.3f}° | {min(last):.3f}° | {max(last):.3f}° | "
                  f"{left:.1e} | {len(times) - 1} | {run['cpu_s']:.0f} |")
    print()


class Picture:
    """A frame with straight axes, curves and a name at each curve's end."""

    def __init__(self, x_range, y_range, x_name, y_name, x_marks, y_marks):
        self.x_range, self.y_range = x_range, y_range
        self.left, self.top, self.width, self.height = 62, 16, 560, 300
        self.parts = []
        for mark in x_marks:
            x = self.x(mark)
            self.line([(x, self.top), (x, self.top + self.height)], PALE, 1)
            self.text(x, self.top + self.height + 18, f"{mark:g}", anchor="middle")
        for mark in y_marks:
            y = self.y(mark)
            self.line([(self.left, y), (self.left + self.width, y)], PALE, 1)
            self.text(self.left - 8, y + 4, f"{mark:g}", anchor="end")
        self.text(self.left + self.width / 2, self.top + self.height + 38, x_name, anchor="middle")
        middle = self.top + self.height / 2
        self.text(16, middle, y_name, anchor="middle", extra=f'transform="rotate(-90 16 {middle:.1f})"')

    def x(self, value):
        return self.left + self.width * (value - self.x_range[0]) / (self.x_range[1] - self.x_range[0])

    def y(self, value):
        return self.top + self.height * (self.y_range[1] - value) / (self.y_range[1] - self.y_range[0])

    def text(self, x, y, words, colour=INK, anchor="start", extra=""):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="13" fill="{colour}" text-anchor="{anchor}" '
                          f'{extra}>{escape(words)}</text>')

    def line(self, points, colour, width, dash=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}" '
                          f'stroke-linejoin="round" stroke-dasharray="{dash or "none"}"/>')

    def curve(self, xs, ys, colour, name, dash="", name_at=None):
        points = [(x, y) for x, y in zip(xs, ys) if self.x_range[0] <= x <= self.x_range[1]]
        self.line([(self.x(x), self.y(y)) for x, y in points], colour, 1.8, dash)
        self.text(self.left + self.width + 8, self.y(name_at if name_at is not None else points[-1][1]) + 4, name, colour)

    def write(self, name, title):
        with open(os.path.join(HERE, name), "w", encoding="utf-8") as file:
            file.write('<svg xmlns="http://www.w3.org/2000/svg" width="760" height="366" viewBox="0 0 760 366" '
                       'role="img" font-family="Helvetica, Arial, \'DejaVu Sans\', sans-serif">\n'
                       f'<title>{escape(title)}</title>\n<rect width="760" height="366" fill="#ffffff"/>\n'
                       + "\n".join(self.parts) + "\n</svg>\n")


def draw_stress(runs):
    picture = Picture((0, 6), (0, 18), "time, ms", "largest von Mises stress outside discs, MPa",
                      range(7), range(0, 17, 4))
    for name, words, colour, dash, where in (
            ("mesh-2", "2 × 2, 0.4 ms", ORANGE, "", 13), ("mesh-4", "4 × 4, 0.4 ms", BLUE, "", 11.5),
            ("step-5e-5", "4 × 4, 0.05 ms - -", BLUE, "5 3", 10), ("mesh-8", "8 × 8, 0.4 ms", BLACK, "", 8.5),
            ("mesh-8-step-1e-4", "8 × 8, 0.1 ms - -", BLACK, "5 3", 7), ("mesh-16", "16 × 16, 0.4 ms", RED, "", 5.5)):
        run = read(runs, name)
        if run:
            stress = run["stress"]
            picture.curve([1e3 * t for t in stress["time_s"]], stress["outside_discs_mpa"], colour, words, dash, where)
    picture.write("elastic-stress.svg", "Largest stress outside discs after a start at 36 degrees, by mesh and time step")


def draw_stiff(runs):
    picture = Picture((0, 100), (0, 38), "time, ms", "angle of the pilot crease, degrees",
                      range(0, 101, 20), range(0, 37, 6))
    rigid = None
    for e_gpa, colour, where in ((70, PURPLE, 34.5), (700, RED, 31), (7000, ORANGE, 17), (70000, GREEN, 6.5),
                                 (700000, BLUE, 4)):
        run = read(runs, f"stiff-{e_gpa}")
        if run:
            motion, rigid = run["motion"], run["rigid_motion"]
            picture.curve([1e3 * t for t in motion["time_s"]], motion["pilot_deg"], colour, f"{e_gpa} GPa", "", where)
    if rigid:
        picture.curve([1e3 * t for t in rigid["time_s"]], rigid["pilot_deg"], BLACK, "rigid - -", "5 3", 1.5)
    picture.write("elastic-stiff.svg", "The pilot's angle after a start at 36 degrees, by Young's modulus")


def main():
    runs = sys.argv[1]
    stress_table(runs, [f"mesh-{n}" for n in (2, 4, 8, 16)] + [f"step-{s}" for s in ("4e-4", "2e-4", "1e-4", "5e-5")]
                 + ["mesh-8-step-1e-4", "mesh-20-disc-0"] + [f"first-mesh-{n}" for n in (4, 8, 12, 16)])
    stress_table(runs, sorted((name for name in os.listdir(runs) if name.startswith("start-") and "." not in name),
                              key=lambda name: (int(name.split("-")[3]), float(name.split("-")[1]))))
    stiff_table(runs)
    stop_table(runs)
    draw_stress(runs)
    draw_stiff(runs)


main()
