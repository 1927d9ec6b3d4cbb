#!/usr/bin/env python3
"""Writes README.md's tables from methods.csv and mesh.csv, each between its two markers:

<!-- table NAME -->
<!-- end -->

Standard library only. What a CSV does not hold is left out.
"""

import math
import os
import re

from draw import DEFAULT_TOLERANCE, HERE, read

# Columns of the table of tolerances.
CHOSEN = ("paper", "tangent", "hermite", "hermite-sparse", "adaptive", "adaptive-sparse", "tracker",
          "lanes", "function", "function-lanes", "paper-float", "tangent-float")


def significant(value, digits=3, most_decimals=9):
    """1234.5 as 1,234 (never in powers of ten), 0.6 as 0.600."""
    decimals = min(max(0, digits - 1 - math.floor(math.log10(value))), most_decimals)
    return f"{value:,.{decimals}f}"


def short(text):
    """6.943e-11 as 6.9e-11."""
    return re.sub(r"e([-+])0", r"e\1", f"{float(text):.1e}")


def microseconds(text):
    return significant(float(text), most_decimals=2)


def ms(row):
    return float(row["us_per_path"]) / 1000


def table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def against(row, paper):
    factor = ms(paper) / ms(row)
    if row is paper:
        return "1"
    return (f"{significant(factor, 2)} times as fast" if factor >= 1 else
            f"{significant(1 / factor, 2)} times as long")


def at_default(rows, spacing):
    rows = [row for row in rows if row["samples_deg"] == spacing and row["largest_error_mm"] and
            (abs(float(row["tolerance"]) / DEFAULT_TOLERANCE - 1) < 1e-6 or row["method"].startswith("level"))]
    paper = next(row for row in rows if row["method"] == "paper")
    return table(
        ["method", "ms a path", "against `paper`", "largest error, mm", "corrections",
         "evaluations", "failed"],
        [[f"`{row['method']}`", significant(ms(row)), against(row, paper),
          short(row["largest_error_mm"]), f"{float(row['corrections_per_path']):,.0f}",
          f"{float(row['evaluations_per_path']):,.0f}",
          f"{int(row['not_converged']) + int(row['elsewhere'])} of {row['paths']}"]
         for row in rows])


def by_tolerance(rows):
    rows = [row for row in rows if row["samples_deg"] == "1"]
    cells = {(row["method"], row["tolerance"]):
             f"{significant(ms(row))} / {short(row['largest_error_mm'])}"
             if row["largest_error_mm"] else "fails" for row in rows}
    methods = [name for name in CHOSEN if any(row["method"] == name for row in rows)]
    return table(["tolerance"] + [f"`{name}`" for name in methods],
                 [[tolerance.replace("e-0", "e-")] +
                  [cells.get((name, tolerance), "–") for name in methods]
                  for tolerance in dict.fromkeys(row["tolerance"] for row in rows)])


def by_size(rows):
    solvers = list(dict.fromkeys(row["linear_solver"] for row in rows))
    sizes = list(dict.fromkeys(row["panels_a_side"] for row in rows))
    found = {(row["panels_a_side"], row["linear_solver"]): row for row in rows}

    def cell(size, solver, column):
        row = found.get((size, solver))
        if not row:
            return "–"
        return microseconds(row[column]) + ("" if row["converged"] == "yes" else " (fails)")

    lines = []
    for size in sizes:
        row = next(row for row in rows if row["panels_a_side"] == size)
        lines.append([f"{size} × {size}", f"{int(row['unknowns']):,}",
                      microseconds(row["evaluate_us"])] +
                     [cell(size, solver, column)
                      for column in ("factorize_and_solve_us", "step_us") for solver in solvers])
    return table(["panels", "unknowns", "residual and Jacobian"] +
                 [f"{words}, {solver}" for words in ("factorize and solve", "a step")
                  for solver in solvers], lines)


def main():
    methods, mesh = read("methods.csv"), read("mesh.csv")
    tables = {"every-degree": at_default(methods, "1"), "every-tenth": at_default(methods, "10"),
              "tolerances": by_tolerance(methods), "sizes": by_size(mesh)}
    path = os.path.join(HERE, "README.md")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for name, lines in tables.items():
        text, count = re.subn(rf"(<!-- table {name} -->\n).*?(<!-- end -->)",
                              lambda block: f"{block[1]}\n{lines}\n\n{block[2]}", text,
                              flags=re.DOTALL)
        if count != 1:
            raise SystemExit(f"README.md: {count} tables {name}, not one")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
