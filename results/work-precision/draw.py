#!/usr/bin/env python3
"""Draws methods.svg and mesh.svg from methods.csv and mesh.csv, with matplotlib; prints the fitted exponents.

A method that has no entry in STYLES is drawn in black.
"""

import csv
import math
import os
import statistics

HERE = os.path.dirname(os.path.abspath(__file__))

# Okabe and Ito's palette without its yellow, which is too pale for lines on white.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7")
GREY, PALE, INK = "#666666", "#E3E3E3", "#222222"

# Colour: where Newton starts, or whose solver it is. Dashes: what differs within the family.
SOLID, DASHED, DOTTED, DASH_DOTTED = "-", (0, (3.5, 2)), (0, (1, 1.5)), (0, (4.5, 1.5, 1, 1.5))
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
    "level": (SKY, SOLID, "each sample from a level"),
    "level-float": (SKY, DOTTED, "from a level, in single"),
    "level-lanes": (SKY, DASHED, "from a level, eight lanes"),
    "kinsol": (PURPLE, SOLID, "KINSOL"),
    "kinsol-newton": (PURPLE, DASHED, "KINSOL, a Jacobian a step"),
    "kinsol-dq": (PURPLE, DOTTED, "KINSOL, finite differences"),
    "dense LU": (BLUE, SOLID, "step, dense LU"),
    "Eigen SparseLU": (SKY, SOLID, "step, Eigen SparseLU"),
    "fixed order": (RED, SOLID, "step, fixed order"),
}
# Curves that end far from the frame's right side are named at their end: dx and dy in points, alignment.
NAMED_IN_PLACE = {"paper-float": (3, 7, "right"), "tangent-float": (0, -14, "center"), "level": (0, 7, "center"),
                  "level-float": (0, 8, "center"), "level-lanes": (0, 7, "center")}
DEFAULT_TOLERANCE = 1e-12
FIT_FROM = 150  # unknowns: from 10 x 10 on, where the leading power rules
TIMES_MS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
STEP_BAND_MM = 8e-11  # kStepBand_widths of a panel of 80 mm: what a verdict sees
PX = 0.75  # a pixel's points


def style(name):
    return STYLES.get(name, (BLACK, SOLID, name))


def read(name):
    with open(os.path.join(HERE, name), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def figure_of(width_px, height_px, title, words):
    import matplotlib  # what only reads tables needs none

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({
        "font.size": 13 * PX, "svg.fonttype": "none", "svg.hashsalt": "misalign", "text.color": INK,
        "axes.labelcolor": INK, "axes.edgecolor": GREY,
        "axes.spines.top": False, "axes.spines.right": False, "xtick.color": GREY, "ytick.color": GREY,
        "xtick.labelsize": 12 * PX, "ytick.labelsize": 12 * PX, "axes.grid": True, "grid.color": PALE,
        "axes.axisbelow": True, "lines.linewidth": 2 * PX, "xtick.major.size": 0, "ytick.major.size": 0,
        "xtick.minor.size": 0, "ytick.minor.size": 0, "xtick.major.pad": 6, "ytick.major.pad": 6})
    figure = plt.figure(figsize=(width_px / 96, height_px / 96))
    figure.text(30 / width_px, 1 - 34 / height_px, title, size=18 * PX, weight="bold")
    figure.text(30 / width_px, 1 - 56 / height_px, words, color=GREY)
    return figure


def axes_of(figure, box_px, x_range, y_range, x_ticks, y_ticks, x_words, y_words):
    """A logarithmic frame. box_px is (left, top, width, height); ranges are (from, to), ticks values with words."""
    width, height = figure.get_size_inches() * 96
    left, top, wide, high = box_px
    axes = figure.add_axes((left / width, 1 - (top + high) / height, wide / width, high / height))
    axes.loglog()
    axes.set(xlim=x_range, ylim=y_range, xlabel=x_words, ylabel=y_words)
    for axis, ticks in ((axes.xaxis, x_ticks), (axes.yaxis, y_ticks)):
        axis.set_ticks([value for value, _ in ticks], [words for _, words in ticks])
        axis.set_ticks([], minor=True)
    return axes


def power(exponent):
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def save(figure, name):
    """Writes the picture, the same bytes whenever nothing has changed."""
    figure.savefig(os.path.join(HERE, name), metadata={"Date": None})


def place_of(axes, x, y):
    """In the frame: from 0 to 1, rightwards and upwards."""
    return axes.transAxes.inverted().transform(axes.transData.transform((x, y)))


def spread(wanted, gap):
    """Places from 0 to 1 as near to the wanted ones (ascending) as a gap between neighbours allows."""
    placed = []
    for height in wanted:
        placed.append(max(height, placed[-1] + gap if placed else 0))
    limit = 1
    for i in reversed(range(len(placed))):
        placed[i] = min(placed[i], limit)
        limit = placed[i] - gap
    # Half of what was pushed on goes back where there is room.
    for i in range(len(placed)):
        floor = placed[i - 1] + gap if i else 0
        placed[i] = max(floor, min(placed[i], (placed[i] + wanted[i]) / 2))
    return placed


def label_column(axes, ends, width_px, height_px):
    """Words right of the frame, each with a thin line to its curve's end (x, y, name)."""
    ends = sorted(ends, key=lambda end: -end[1])
    depths = spread([1 - place_of(axes, x, y)[1] for x, y, _ in ends], 17 / height_px)
    outside = {"transform": axes.transAxes, "clip_on": False}
    for (x, y, name), depth in zip(ends, depths):
        height = 1 - depth
        colour, dash, words = style(name)
        at = place_of(axes, x, y)
        axes.plot([at[0] + 5 / width_px, 1 + 12 / width_px, 1 + 16 / width_px], [at[1], height, height], color=colour,
                  linewidth=0.7 * PX, alpha=0.7, **outside)
        axes.plot([1 + 16 / width_px, 1 + 39 / width_px], [height, height], color=colour, linestyle=dash, **outside)
        axes.text(1 + 44 / width_px, height, words, size=12 * PX, verticalalignment="center", transform=axes.transAxes)


def methods_panel(figure, box_px, rows, title):
    times_ms = [float(row["us_per_path"]) / 1000 for row in rows]
    shown_ms = [v for v in TIMES_MS if max(t for t in TIMES_MS if t <= min(times_ms)) <= v
                <= min(t for t in TIMES_MS if t >= max(times_ms))]
    axes = axes_of(figure, box_px, (1, 3e-13), (shown_ms[0], shown_ms[-1]),
                   [(10.0 ** e, power(e)) for e in range(-12, 1, 2)], [(v, f"{v:g}") for v in shown_ms],
                   "largest error of any diagonal, mm (more precise to the right)", "time per path, ms")
    axes.set_title(title, loc="left", size=14 * PX, weight="bold")
    axes.axvline(STEP_BAND_MM, color=GREY, linewidth=1.2 * PX, linestyle=(0, (5, 3)))
    axes.annotate("direction band of a verdict", (STEP_BAND_MM, 1), (-5, -4), xycoords=axes.get_xaxis_transform(),
                  textcoords="offset points", horizontalalignment="right", verticalalignment="top", color=GREY,
                  size=11.5 * PX)
    ends = []
    for name in dict.fromkeys(row["method"] for row in rows):
        colour, dash, words = style(name)
        points = [(float(row["largest_error_mm"]), float(row["us_per_path"]) / 1000,
                   float(row["tolerance"]), int(row["not_converged"]) + int(row["elsewhere"]))
                  for row in rows if row["method"] == name and row["largest_error_mm"]]
        if not points:
            continue
        axes.plot([p[0] for p in points], [p[1] for p in points], "o", color=colour, linestyle=dash, markersize=6 * PX)
        failing = [p for p in points if p[3] > 0]
        axes.plot([p[0] for p in failing], [p[1] for p in failing], "o", color=colour, markersize=6 * PX,
                  markerfacecolor="white")
        default = [p for p in points if abs(p[2] / DEFAULT_TOLERANCE - 1) < 1e-6]
        axes.plot([p[0] for p in default], [p[1] for p in default], "o", color=INK, markersize=12 * PX,
                  fillstyle="none", markeredgewidth=1.2 * PX)
        end = points[-1][:2]
        if name in NAMED_IN_PLACE:
            dx, dy, alignment = NAMED_IN_PLACE[name]
            axes.annotate(words, end, (dx, dy), textcoords="offset points", size=12 * PX,
                          horizontalalignment=alignment)
        else:
            ends.append((*end, name))
    label_column(axes, ends, box_px[2], box_px[3])


def draw_methods(rows):
    figure = figure_of(960, 1080, "Work and precision: following one 6 × 6 sheet from 1° to 150°",
                       "One dot a closure tolerance, 1e-3 to 1e-14 from left to right; ringed: 1e-12, the default. "
                       "Hollow: some paths failed.")
    for spacing, top, height, words in (("1", 104, 440, "Lengths wanted at every degree"),
                                        ("10", 634, 360, "Lengths wanted at every tenth degree")):
        methods_panel(figure, (90, top, 610, height), [row for row in rows if row["samples_deg"] == spacing], words)
    save(figure, "methods.svg")


def exponent(points):
    """Slope of log y over log x by least squares, and the factor in front."""
    slope, offset = statistics.linear_regression(*zip(*((math.log(x), math.log(y)) for x, y in points)))
    return slope, math.exp(offset)


def draw_mesh(rows):
    figure = figure_of(900, 560, "Cost of a 1° step against the size of the sheet",
                       "60° to 70°, three Newton corrections a step. Lines: powers of the number of unknowns fitted "
                       "from 10×10 on.")
    by_size = sorted({(int(row["panels_a_side"]), int(row["unknowns"])) for row in rows})
    axes = axes_of(figure, (90, 84, 560, 400), (12, 7000), (0.3, 3e5), [(u, str(u)) for _, u in by_size],
                   [(10.0 ** e, power(e)) for e in range(0, 6)], "unknowns", "time, µs")
    for panels, unknowns in by_size:
        axes.text(unknowns, 1.01, f"{panels}×{panels}", size=11 * PX, color=GREY, horizontalalignment="center",
                  transform=axes.get_xaxis_transform())
    solvers = list(dict.fromkeys(row["linear_solver"] for row in rows))
    series = [(name, *style(name), [(float(r["unknowns"]), float(r["step_us"])) for r in rows
                                    if r["linear_solver"] == name]) for name in solvers]
    series.append(("residual and Jacobian", GREY, DASHED, "residual and Jacobian, once",
                   [(float(r["unknowns"]), float(r["evaluate_us"])) for r in rows
                    if r["linear_solver"] == solvers[-1]]))  # which goes to the largest size
    labels = []
    print("cost = factor * unknowns^exponent, least squares of the logarithms")
    for name, colour, dash, words, points in series:
        fitted = [(x, y) for x, y in points if x > FIT_FROM]
        slope, factor = exponent(fitted)
        overall, _ = exponent(points)
        print(f"  {name}: exponent {slope:.2f} from 10x10 on, {overall:.2f} over all sizes")
        ends = [fitted[0][0], fitted[-1][0]]
        axes.plot(ends, [factor * x ** slope for x in ends], color=colour, linestyle=dash)
        axes.plot([x for x, _ in points], [y for _, y in points], "o", color=colour, markersize=7 * PX)
        labels.append((place_of(axes, *points[-1])[1], ends[-1], words, colour,
                       f"exponent {slope:.2f} ({overall:.2f} over all sizes)"))
    labels.sort()
    for height, (_, x, words, colour, exponents) in zip(spread([label[0] for label in labels], 34 / 400), labels):
        for word, dy, size, ink in ((words, 2, 12.5, colour), (exponents, -10, 12, GREY)):
            axes.annotate(word, (x, height), (9, dy), xycoords=axes.get_xaxis_transform(), textcoords="offset points",
                          size=size * PX, color=ink, annotation_clip=False)
    save(figure, "mesh.svg")


if __name__ == "__main__":
    draw_methods(read("methods.csv"))
    draw_mesh(read("mesh.csv"))
