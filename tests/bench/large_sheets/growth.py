#!/usr/bin/env python3
"""Draws milliseconds of a path over the number of panels from the table of `large_sheets`: growth.py TABLE SVG"""

import math
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

CURVES = {  # column: label, colour, line
    "vertices, ms": ("vertex coordinates, Gauss-Newton", "#CC79A7", "-"),
    "SparseLU, ms": ("close steps, Eigen SparseLU", "#56B4E9", "-"),
    "close steps, ms": ("close steps, fixed order", "#D55E00", "-"),
    "close in lanes, ms": ("the same in eight lanes", "#D55E00", "--"),
    "function, ms": ("path as a function", "#222222", "-"),
    "function in lanes, ms": ("the same in eight lanes", "#222222", "--"),
}


def main(table, svg):
    with open(table, encoding="utf-8") as file:
        rows = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in file if line.startswith("|")]
    head, rows = rows[0], rows[1:]
    panels = [math.prod(int(side) for side in row[0].split("x")) for row in rows]
    figure, axes = plt.subplots(figsize=(7, 4.6), layout="constrained")
    for column, (label, colour, line) in CURVES.items():
        times_ms = [float(row[head.index(column)]) for row in rows]
        power = math.log(times_ms[-1] / times_ms[0]) / math.log(panels[-1] / panels[0])
        axes.loglog(panels, times_ms, line, color=colour, marker="o", markersize=4, label=f"{label}: power {power:.2f}")
    axes.set_xlabel("panels")
    axes.set_ylabel("processor time of a path to 60°, ms")
    axes.set_xticks(panels, [row[0].replace(" x ", " × ") for row in rows], fontsize=8)
    axes.minorticks_off()
    axes.grid(color="#E3E3E3")
    axes.legend(frameon=False, fontsize=8)
    figure.savefig(svg, metadata={"Date": None})


main(*sys.argv[1:])
