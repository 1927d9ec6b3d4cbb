#!/usr/bin/env python3
"""Draws methods.svg and mesh.svg from methods.csv and mesh.csv; prints the fitted exponents.

Standard library only. A method that has no entry in STYLES is drawn in black.
"""

import csv
import math
import os
from html import escape

HERE = os.path.dirname(os.path.abspath(__file__))

# Okabe and Ito's palette without its yellow, which is too pale for lines on white.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7")
GREY, PALE, INK = "#666666", "#E3E3E3", "#222222"

# Colour: where Newton starts, or whose solver it is. Dashes: what differs within the family.
SOLID, DASHED, DOTTED, DASH_DOTTED = "", "7 4", "2 3", "9 3 2 3"
STYLES = {
    "paper": (BLUE, SOLID, "previous solution (the paper)"),
    "paper-fd": (BLUE, DASHED, "previous, finite differences"),
    "paper-float": (BLUE, DOTTED, "previous, in single"),
    "paper-eigen-sparse": (SKY, SOLID, "previous, Eigen SparseLU"),
    "paper-sparse": (BLUE, DASH_DOTTED, "previous, fixed order"),
    "paper-10deg": (BLUE, SOLID, "previous, 10° steps"),
    "tangent": (GREEN, SOLID, "tangent"),
    "tangent-float": (GREEN, DOTTED, "tangent, in single"),
    "tangent-10deg": (GREEN, SOLID, "tangent, 10° steps"),
    "hermite": (RED, SOLID, "Hermite"),
    "hermite-mixed": (RED, DASHED, "Hermite, factors in single"),
    "hermite-sparse": (RED, DASH_DOTTED, "Hermite, fixed order"),
    "adaptive": (ORANGE, SOLID, "Hermite, adaptive steps"),
    "adaptive-tangent": (ORANGE, DASHED, "tangent, adaptive steps"),
    "adaptive-sparse": (ORANGE, DASH_DOTTED, "adaptive, fixed order"),
    "tracker": (BLACK, SOLID, "the search's own tracker"),
    "tracker-10deg": (BLACK, SOLID, "tracker, 10° steps"),
    "lanes": (BLACK, DASHED, "tracker in eight lanes"),
    "lanes-10deg": (BLACK, DASHED, "eight lanes, 10° steps"),
    "function": (GREY, SOLID, "path as a function"),
    "function-lanes": (GREY, DASHED, "function in eight lanes"),
    "kinsol": (PURPLE, SOLID, "KINSOL"),
    "kinsol-newton": (PURPLE, DASHED, "KINSOL, a Jacobian a step"),
    "kinsol-dq": (PURPLE, DOTTED, "KINSOL, finite differences"),
    "dense LU": (BLUE, SOLID, "step, dense LU"),
    "Eigen SparseLU": (SKY, SOLID, "step, Eigen SparseLU"),
    "fixed order": (RED, SOLID, "step, fixed order"),
}
# Curves that end far from the frame's right side are named at their end: dx, dy, anchor.
NAMED_IN_PLACE = {"paper-float": (4, -10, "end"), "tangent-float": (0, 18, "middle")}
DEFAULT_TOLERANCE = 1e-12
FIT_FROM = 150  # unknowns: from 10 x 10 on, where the leading power rules
TIMES_MS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
STEP_BAND_MM = 8e-11  # kStepBand_widths of a panel of 80 mm: what a verdict sees
# In-frame words stand on a white rim, clear of the lines behind them.
RIM = 'paint-order="stroke" stroke="#ffffff" stroke-width="4" stroke-linejoin="round"'
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def style(name):
    return STYLES.get(name, (BLACK, SOLID, name))


def read(name):
    with open(os.path.join(HERE, name), newline="") as file:
        return list(csv.DictReader(file))


def power(exponent):
    return "10" + str(exponent).translate(SUPERSCRIPTS)


def plain(value):
    return f"{value:g}"


class Figure:
    def __init__(self, width, height):
        self.width, self.height = width, height
        self.parts = []

    def add(self, element):
        self.parts.append(element)

    def text(self, x, y, words, size=13, colour=INK, anchor="start", extra=""):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" '
                 f'text-anchor="{anchor}" {extra}>{escape(words)}</text>')

    def line(self, x1, y1, x2, y2, colour, width=1.0, dash=""):
        self.add(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
                 f'stroke="{colour}" stroke-width="{width}" stroke-dasharray="{dash or "none"}"/>')

    def polyline(self, points, colour, dash):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2" '
                 f'stroke-linejoin="round" stroke-dasharray="{dash or "none"}"/>')

    def dot(self, x, y, colour, hollow=False, radius=3.0):
        fill = "#ffffff" if hollow else colour
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{fill}" '
                 f'stroke="{colour}" stroke-width="1.5"/>')

    def write(self, name, title):
        with open(os.path.join(HERE, name), "w", encoding="utf-8") as file:
            file.write(
                f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" '
                f'height="{self.height}" viewBox="0 0 {self.width} {self.height}" role="img" '
                f'font-family="Helvetica, Arial, \'DejaVu Sans\', sans-serif">\n'
                f"<title>{escape(title)}</title>\n"
                f'<rect width="{self.width}" height="{self.height}" fill="#ffffff"/>\n'
                + "\n".join(self.parts) + "\n</svg>\n")


class Axes:
    """A logarithmic frame. x_range and y_range are (from, to); from may be the larger."""

    def __init__(self, figure, left, top, width, height, x_range, y_range):
        self.figure = figure
        self.left, self.top, self.width, self.height = left, top, width, height
        self.x_range = [math.log10(v) for v in x_range]
        self.y_range = [math.log10(v) for v in y_range]

    def x(self, value):
        a, b = self.x_range
        return self.left + (math.log10(value) - a) / (b - a) * self.width

    def y(self, value):
        a, b = self.y_range
        return self.top + self.height - (math.log10(value) - a) / (b - a) * self.height

    def frame(self, x_ticks, y_ticks, x_words, y_words):
        f, right, bottom = self.figure, self.left + self.width, self.top + self.height
        for value, words in x_ticks:
            f.line(self.x(value), self.top, self.x(value), bottom, PALE)
            f.text(self.x(value), bottom + 18, words, 12, GREY, "middle")
        for value, words in y_ticks:
            f.line(self.left, self.y(value), right, self.y(value), PALE)
            f.text(self.left - 8, self.y(value) + 4, words, 12, GREY, "end")
        f.line(self.left, bottom, right, bottom, GREY)
        f.line(self.left, self.top, self.left, bottom, GREY)
        f.text(self.left + self.width / 2, bottom + 40, x_words, 13, INK, "middle")
        middle = self.top + self.height / 2
        f.text(self.left - 50, middle, y_words, 13, INK, "middle",
               f'transform="rotate(-90 {self.left - 50:.1f} {middle:.1f})"')

    def curve(self, points, colour, dash):
        self.figure.polyline([(self.x(x), self.y(y)) for x, y in points], colour, dash)


def spread(wanted, gap, lowest, highest):
    """Heights as near to the wanted ones (ascending) as a gap between neighbours allows."""
    placed = []
    for height in wanted:
        placed.append(max(height, placed[-1] + gap if placed else lowest))
    limit = highest
    for i in reversed(range(len(placed))):
        placed[i] = min(placed[i], limit)
        limit = placed[i] - gap
    # Half of what was pushed down goes back up where there is room.
    for i in range(len(placed)):
        floor = placed[i - 1] + gap if i else lowest
        placed[i] = max(floor, min(placed[i], (placed[i] + wanted[i]) / 2))
    return placed


def label_column(axes, ends):
    """Words right of the frame, each with a thin line to its curve's end (x, y, name)."""
    f = axes.figure
    ends = sorted(ends, key=lambda end: end[1])
    heights = spread([y for _, y, _ in ends], 17, axes.top + 4, axes.top + axes.height)
    column = axes.left + axes.width + 44
    for (x, y, name), height in zip(ends, heights):
        colour, dash, words = style(name)
        f.add(f'<polyline points="{x + 5:.1f},{y:.1f} {column - 32:.1f},{height:.1f} '
              f'{column - 28:.1f},{height:.1f}" fill="none" stroke="{colour}" '
              f'stroke-width="0.7" opacity="0.7"/>')
        f.line(column - 28, height, column - 5, height, colour, 2, dash)
        f.text(column, height + 4, words, 12)


def methods_panel(axes, rows, title):
    f = axes.figure
    f.text(axes.left, axes.top - 12, title, 14, extra='font-weight="bold"')
    axes.frame([(10.0 ** e, power(e)) for e in range(-12, 1, 2)],
               [(v, plain(v)) for v in TIMES_MS
                if axes.y_range[0] <= math.log10(v) <= axes.y_range[1]],
               "largest error of any diagonal, mm (more precise to the right)",
               "time per path, ms")
    band = axes.x(STEP_BAND_MM)
    f.line(band, axes.top, band, axes.top + axes.height, GREY, 1.2, "5 3")
    f.text(band - 6, axes.top + 14, "direction band of a verdict", 11.5, GREY, "end", RIM)
    ends = []
    for name in dict.fromkeys(row["method"] for row in rows):
        colour, dash, _ = style(name)
        points = [(float(row["largest_error_mm"]), float(row["us_per_path"]) / 1000,
                   float(row["tolerance"]), int(row["not_converged"]) + int(row["elsewhere"]))
                  for row in rows if row["method"] == name and row["largest_error_mm"]]
        if not points:
            continue
        axes.curve([(x, y) for x, y, _, _ in points], colour, dash)
        for x, y, tolerance, failures in points:
            f.dot(axes.x(x), axes.y(y), colour, hollow=failures > 0, radius=2.4)
            if abs(tolerance / DEFAULT_TOLERANCE - 1) < 1e-6:
                f.add(f'<circle cx="{axes.x(x):.1f}" cy="{axes.y(y):.1f}" r="6" fill="none" '
                      f'stroke="{INK}" stroke-width="1.2"/>')
        x, y = axes.x(points[-1][0]), axes.y(points[-1][1])
        if name in NAMED_IN_PLACE:
            dx, dy, anchor = NAMED_IN_PLACE[name]
            f.text(x + dx, y + dy, style(name)[2], 12, anchor=anchor, extra=RIM)
        else:
            ends.append((x, y, name))
    label_column(axes, ends)


def draw_methods(rows):
    f = Figure(960, 1080)
    title = "Work and precision: following one 6 × 6 sheet from 1° to 150°"
    f.text(30, 34, title, 18, extra='font-weight="bold"')
    f.text(30, 56, "One dot a closure tolerance, 1e-3 to 1e-14 from left to right; ringed: 1e-12, "
           "the default. Hollow: some paths failed.", 13, GREY)
    for spacing, top, height, words in (("1", 104, 440, "Lengths wanted at every degree"),
                                        ("10", 634, 360, "Lengths wanted at every tenth degree")):
        panel = [row for row in rows if row["samples_deg"] == spacing]
        times = [float(row["us_per_path"]) / 1000 for row in panel]
        y_range = (max(v for v in TIMES_MS if v <= min(times)),
                   min(v for v in TIMES_MS if v >= max(times)))
        methods_panel(Axes(f, 90, top, 610, height, (1, 3e-13), y_range), panel, words)
    f.write("methods.svg", title)


def exponent(points):
    """Slope of log y over log x by least squares, and the factor in front."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    slope = (sum((x - mx) * (y - my) for x, y in zip(xs, ys)) /
             sum((x - mx) ** 2 for x in xs))
    return slope, math.exp(my - slope * mx)


def draw_mesh(rows):
    f = Figure(900, 560)
    title = "Cost of a 1° step against the size of the sheet"
    f.text(30, 34, title, 18, extra='font-weight="bold"')
    f.text(30, 56, "60° to 70°, three Newton corrections a step. Lines: powers of the number of "
           "unknowns fitted from 10×10 on.", 13, GREY)
    axes = Axes(f, 90, 84, 560, 400, (12, 7000), (0.3, 3e5))
    by_size = sorted({(int(row["panels_a_side"]), int(row["unknowns"])) for row in rows})
    axes.frame([(u, str(u)) for _, u in by_size],
               [(10.0 ** e, power(e)) for e in range(0, 6)],
               "unknowns", "time, µs")
    for panels, unknowns in by_size:
        f.text(axes.x(unknowns), axes.top - 6, f"{panels}×{panels}", 11, GREY, "middle")

    solvers = list(dict.fromkeys(row["linear_solver"] for row in rows))
    series = [(name, *style(name), [(float(r["unknowns"]), float(r["step_us"])) for r in rows
                                    if r["linear_solver"] == name]) for name in solvers]
    last = solvers[-1]  # one that goes to the largest size
    series.append(("residual and Jacobian", GREY, DASHED, "residual and Jacobian, once",
                   [(float(r["unknowns"]), float(r["evaluate_us"])) for r in rows
                    if r["linear_solver"] == last]))
    labels = []
    print("cost = factor * unknowns^exponent, least squares of the logarithms")
    for name, colour, dash, words, points in series:
        slope, factor = exponent([(x, y) for x, y in points if x > FIT_FROM])
        overall, _ = exponent(points)
        print(f"  {name}: exponent {slope:.2f} from 10x10 on, {overall:.2f} over all sizes")
        ends = [x for x, _ in points if x > FIT_FROM]
        axes.curve([(x, factor * x ** slope) for x in (ends[0], ends[-1])], colour, dash)
        for x, y in points:
            f.dot(axes.x(x), axes.y(y), colour)
        labels.append((axes.y(points[-1][1]), axes.x(ends[-1]) + 12, words, colour,
                       f"exponent {slope:.2f} ({overall:.2f} over all sizes)"))
    labels.sort()
    heights = spread([label[0] for label in labels], 34, axes.top, axes.top + axes.height)
    for y, (_, x, words, colour, exponents) in zip(heights, labels):
        f.text(x, y - 2, words, 12.5, colour, extra=RIM)
        f.text(x, y + 14, exponents, 12, GREY, extra=RIM)
    f.write("mesh.svg", title)


if __name__ == "__main__":
    draw_methods(read("methods.csv"))
    draw_mesh(read("mesh.csv"))
