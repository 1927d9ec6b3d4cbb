#!/usr/bin/env python3
"""What foretells the share of miscut copies that deploy: Spearman's rank correlation of every column
of candidates.csv with it, as table.md and correlations.svg.

Standard library only. One correlation in each campaign; the mean of those is what counts, since no
threshold or size is to be foretold. Its 95 % interval is of 300 bootstrap samples (seed 1), the
candidates of each campaign drawn again with replacement.
"""

import csv
import math
import os
import random
from html import escape

HERE = os.path.dirname(os.path.abspath(__file__))
SAMPLES = 300
# What was measured of the copies, and what names a row.
OUTCOMES = {"campaign", "from_deg", "amplitude_mm", "copies", "draw", "share"}
LOST = "lost_to_"  # and these: copies by what was the matter with them
# Nearly all rows are empty, or all are equal.
EMPTY = {"bump_deg", "increasing", "decreasing", "deploys_from_sample"}
# Not kept in a catalogue: measured here for comparison.
TRIED = ("margin_", "fold_limit_margin", "over_folded_margin", "least_margin", "share_foretold")


def ranks(values):
    order = sorted(range(len(values)), key=values.__getitem__)
    result = [0.0] * len(values)
    k = 0
    while k < len(order):
        end = k
        while end + 1 < len(order) and values[order[end + 1]] == values[order[k]]:
            end += 1
        for place in order[k:end + 1]:
            result[place] = (k + end) / 2
        k = end + 1
    return result


def spearman(a, b):
    a, b = ranks(a), ranks(b)
    mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
    ab = sum((x - mean_a) * (y - mean_b) for x, y in zip(a, b))
    aa = sum((x - mean_a) ** 2 for x in a)
    bb = sum((y - mean_b) ** 2 for y in b)
    return ab / math.sqrt(aa * bb) if aa > 0 and bb > 0 else 0.0


def read_campaigns():
    campaigns = {}
    with open(os.path.join(HERE, "candidates.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if None in row or None in row.values():
                raise SystemExit(f"draw {row['draw']}: not one value a column; make candidates.csv again")
            lost = sum(float(row[c]) for c in row if c.startswith(LOST))
            if abs(float(row["share"]) * float(row["copies"]) + lost - float(row["copies"])) > 0.5:
                raise SystemExit(f"draw {row['draw']}: copies that deploy and those lost are not all")
            name = f"{row['campaign']} from {row['from_deg']}°"
            campaigns.setdefault(name, []).append(row)
    return campaigns


def numbers(rows, column):
    return [float(row[column]) if row[column] else -math.inf for row in rows]


def study(campaigns):
    """[(column, mean, low, high, [each campaign's])], the best first."""
    columns = [c for c in next(iter(campaigns.values()))[0]
               if c not in OUTCOMES | EMPTY and not c.startswith(LOST)]
    data = [{c: numbers(rows, c) for c in columns + ["share"]} for rows in campaigns.values()]
    chance = random.Random(1)
    means = {c: [] for c in columns}
    for _ in range(SAMPLES):
        sums = dict.fromkeys(columns, 0.0)
        for some in data:
            size = len(some["share"])
            again = [chance.randrange(size) for _ in range(size)]
            share = [some["share"][k] for k in again]
            for c in columns:
                sums[c] += spearman([some[c][k] for k in again], share)
        for c in columns:
            means[c].append(sums[c] / len(data))
    table = []
    for c in columns:
        each = [spearman(some[c], some["share"]) for some in data]
        spread = sorted(means[c])
        table.append((c, sum(each) / len(each), spread[int(0.025 * SAMPLES)],
                      spread[int(0.975 * SAMPLES)], each))
    return sorted(table, key=lambda entry: -abs(entry[1]))


def write_table(campaigns, table):
    lines = ["# Rank correlations with the share of copies that deploy", "",
             "| metric | mean (95 %) | " + " | ".join(campaigns) + " |",
             "|---|---|" + "---|" * len(campaigns)]
    for column, mean, low, high, each in table:
        lines.append(f"| `{column}` | {mean:.2f} ({low:.2f} to {high:.2f}) | "
                     + " | ".join(f"{value:.2f}" for value in each) + " |")
    with open(os.path.join(HERE, "table.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    for name, rows in campaigns.items():
        share = sum(float(row["share"]) for row in rows) / len(rows)
        lost = {c[len(LOST):]: sum(float(row[c]) for row in rows) for c in rows[0] if c.startswith(LOST)}
        print(f"{name}: {len(rows)} candidates, mean share {share:.3f}, lost to",
              ", ".join(f"{cause} {count:.0f}" for cause, count in sorted(lost.items())))


def text(x, y, words, anchor="start", size=12, fill="#222222"):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" '
            f'fill="{fill}">{escape(words)}</text>')


def bars(table, left, top, width, step):
    """Means as bars from 0 to 1, their intervals as lines."""
    out = []
    for tick in range(0, 11, 2):
        x = left + width * tick / 10
        out.append(f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{top + step * len(table):.1f}" '
                   'stroke="#E3E3E3"/>')
        out.append(text(x, top + step * len(table) + 15, f"{tick / 10:g}", "middle", 11))
    for k, (column, mean, low, high, _) in enumerate(table):
        y = top + step * k + step / 2
        colour = "#D55E00" if column == "miscut_margin_mm" else (
            "#9DBFD6" if column.startswith(TRIED) else "#0072B2")
        out.append(f'<rect x="{left}" y="{y - 6:.1f}" width="{width * abs(mean):.1f}" height="12" '
                   f'fill="{colour}"/>')
        ends = sorted((abs(low), abs(high))) if low * high > 0 else (0, max(-low, high))
        out.append(f'<line x1="{left + width * ends[0]:.1f}" y1="{y:.1f}" '
                   f'x2="{left + width * ends[1]:.1f}" y2="{y:.1f}" stroke="#222222"/>')
        out.append(text(left - 8, y + 4, column, "end"))
    out.append(text(left + width / 2, top + step * len(table) + 34,
                    "|rank correlation| with the share that deploys", "middle"))
    return out


def scatter(campaigns, column, left, top, width, height):
    out = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" '
           'stroke="#999999"/>']
    values = [v for rows in campaigns.values() for v in numbers(rows, column) if v > 0]
    low, high = math.log10(min(values)), math.log10(max(values))
    colours = ["#0072B2", "#E69F00", "#009E73", "#CC79A7"]
    for colour, rows in zip(colours, campaigns.values()):
        for value, share in zip(numbers(rows, column), numbers(rows, "share")):
            if value <= 0:
                continue
            x = left + width * (math.log10(value) - low) / (high - low)
            y = top + height * (1 - share)
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.2" fill="{colour}" '
                       'fill-opacity="0.7"/>')
    for power in range(math.ceil(low), math.floor(high) + 1):
        x = left + width * (power - low) / (high - low)
        out.append(f'<line x1="{x:.1f}" y1="{top + height}" x2="{x:.1f}" y2="{top + height + 4}" '
                   'stroke="#999999"/>')
        out.append(text(x, top + height + 16, f"{10.0 ** power:g}", "middle", 11))
    for share in (0, 0.5, 1):
        out.append(text(left - 6, top + height * (1 - share) + 4, f"{100 * share:g} %", "end", 11))
    out.append(text(left + width / 2, top + height + 34, column, "middle"))
    return out


def draw(campaigns, table):
    shown = [entry for entry in table if abs(entry[1]) >= 0.15]
    step, left = 19, 250
    height = max(step * len(shown) + 110, 640)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="1060" height="{height}" '
           f'viewBox="0 0 1060 {height}" font-family="sans-serif">',
           f'<rect width="1060" height="{height}" fill="#FFFFFF"/>',
           text(20, 28, "What foretells the share of miscut copies that deploy", size=17)]
    out += bars(shown, left, 50, 400, step)
    out.append(text(20, height - 28, "orange: in the catalogue, new; blue: in the catalogue; "
                    "pale: tried here. Lines: 95 % intervals.", size=11, fill="#555555"))
    for k, column in enumerate(("miscut_margin_mm", "slope_min_mm_per_deg")):
        out += scatter(campaigns, column, 750, 60 + 270 * k, 290, 200)
    colours = ["#0072B2", "#E69F00", "#009E73", "#CC79A7"]
    for k, (name, rows) in enumerate(campaigns.items()):
        y = height - 60 - 16 * (len(campaigns) - 1 - k)
        out.append(f'<circle cx="26" cy="{y - 4}" r="4" fill="{colours[k]}"/>')
        out.append(text(36, y, f"{name}: {len(rows)} candidates", size=11))
    with open(os.path.join(HERE, "correlations.svg"), "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n</svg>\n")


def main():
    campaigns = read_campaigns()
    table = study(campaigns)
    write_table(campaigns, table)
    draw(campaigns, table)


main()
