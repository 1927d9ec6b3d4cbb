#!/usr/bin/env python3
"""The paper's figures 12 and 13, how rare sheets are, and which metrics go together: figures.py [CATALOGUE]

In Python with `misalign`, NumPy, pandas and matplotlib; to be run as it is, or cell by cell (# %%) in an editor
that knows cells. The pictures go to results/figures/. The catalogue is one of candidates of 6 x 6 panels; the newest
in results/ that `scripts/run.sh` has made, if none is named.
"""

# %% What is asked for, before all that takes time
import argparse
import sys
from pathlib import Path

parser = argparse.ArgumentParser(description="Draws the paper's figures 12 and 13, how rare sheets are, and which metrics "
                                 "go together, into results/figures/, in half a minute.")
parser.add_argument("catalogue", metavar="CATALOGUE", nargs="?", type=Path,
                    help="of candidates of 6 x 6 panels [the newest of miura-6x6 in results/]")
asked = parser.parse_args([] if hasattr(sys, "ps1") else None)  # cell by cell there is no command line

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "build/release/python"))  # where the build leaves it; an installed one comes first
catalogues = [asked.catalogue] if asked.catalogue else sorted(
    (ROOT / "results").glob("miura-6x6-*.db"), key=lambda path: path.stat().st_mtime)[-1:]
if not catalogues:
    parser.error("there is no catalogue in results/ (of miura-6x6); run scripts/run.sh, or name one")

# %% What is needed
try:
    import misalign

    catalogue = misalign.Catalogue(catalogues[0])
except ImportError as error:
    parser.error(f"{error}; scripts/run.sh builds the package")
except misalign.Error as error:
    parser.error(str(error))
try:
    import matplotlib
    import pandas  # of which candidates() makes its table
except ImportError as error:
    parser.error(f"{error} (figures are drawn with it); install python3-matplotlib and python3-pandas, or their like")

import math

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

PICTURES = ROOT / "results/figures"
SHRINKS, GROWS, INK, PALE = "#c0392b", "#1f6fb2", "#222222", "#9a9a9a"
plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "figure.dpi": 100, "svg.fonttype": "none",
    "svg.hashsalt": "misalign", "axes.spines.top": False, "axes.spines.right": False, "text.color": INK,
    "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK})


def save(figure, name):
    """Writes the picture, the same bytes whenever nothing has changed."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(PICTURES / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)
    print(f"results/figures/{name}.svg")


def deployment_ratio(pilot_deg):
    """The paper's D: 1 flat, 0 folded."""
    return (180 - pilot_deg) / 180


# %% Table 1 of the paper, folded as far as it goes
table1 = misalign.read(ROOT / "search/patterns/table1.json")
folding = table1.fold()
folded = folding.pilot_deg <= folding.deploys_from_deg
grows = folding.length_mm[folded][-1] > folding.flat_mm
print(f"Table 1: deploys from {folding.deploys_from_deg:g} deg, fold limit {folding.fold_limit_deg:.3f} deg")


# %% Figure 12: the sheet with its holes and diagonals, and how its vertices are shifted
def draw_sheet(axes, pattern):
    flat_mm = pattern.vertices_mm + pattern.shifts_mm
    for number, facet in enumerate(pattern.facets):
        hole = number in pattern.holes
        axes.fill(*flat_mm[facet].T, facecolor="#eeeeee" if hole else "white", edgecolor=PALE, linewidth=0.4)
    for crease, valley in zip(pattern.creases, pattern.valley):
        axes.plot(*flat_mm[crease].T, color=INK, linewidth=0.8, dashes=(4, 2) if valley else (6, 2, 1, 2))
    axes.set_aspect("equal")
    axes.axis("off")
    return flat_mm


figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.8), layout="constrained")
flat_mm = draw_sheet(left, table1)
for number, diagonal in enumerate(table1.diagonals):
    from_mm, to_mm = flat_mm[diagonal]
    left.plot(*flat_mm[diagonal].T, color=GROWS if grows[number] else SHRINKS, linewidth=1)
    left.text(*(from_mm + 0.25 * (to_mm - from_mm)), f"$L_{{{number + 1}}}$", ha="center", va="center", fontsize=8,
              bbox={"facecolor": "#eeeeee", "edgecolor": "none", "pad": 0.5})
left.set_title("a  Diagonals of the holes: blue ones grow as it folds, red ones shrink")

flat_mm = draw_sheet(right, table1)
shifted = np.flatnonzero(np.abs(table1.shifts_mm).max(axis=1) > 0)
MAGNIFIED = 50
for vertex in shifted:
    right.annotate("", flat_mm[vertex] + MAGNIFIED * table1.shifts_mm[vertex], flat_mm[vertex],
                   arrowprops={"arrowstyle": "-|>", "color": SHRINKS, "shrinkA": 0, "shrinkB": 0})
    right.annotate(table1.vertex_labels[vertex], flat_mm[vertex], (-3, 3), textcoords="offset points", ha="right",
                   fontsize=8)
right.set_title(f"b  Shifts of {len(shifted)} vertices, magnified {MAGNIFIED} times; valleys dashed")
save(figure, "figure12")


# %% Figure 13: the sheet as it folds, and how the diagonals of each hole change
figure = plt.figure(figsize=(10, 5.6), layout="constrained")
states, histories = figure.subfigures(1, 2, width_ratios=(1, 2.4))
for place, pilot_deg in enumerate((36, 90, 144)):
    axes = states.add_subplot(3, 1, place + 1, projection="3d", proj_type="ortho")
    shape_mm = folding.vertices_mm[np.searchsorted(folding.pilot_deg, pilot_deg)]
    kept = [facet for number, facet in enumerate(table1.facets) if number not in table1.holes]
    for facet in kept:
        axes.plot(*shape_mm[np.append(facet, facet[0])].T, color=INK, linewidth=0.5)
    for number, diagonal in enumerate(table1.diagonals):
        axes.plot(*shape_mm[diagonal].T, color=GROWS if grows[number] else SHRINKS, linewidth=0.5)
    axes.set_box_aspect(np.ptp(shape_mm, axis=0), zoom=1.1)
    axes.view_init(elev=35, azim=-60)
    axes.axis("off")
    axes.set_title(f"D = {deployment_ratio(pilot_deg):.1f} (pilot {pilot_deg}°)", y=0.95)

ratio = deployment_ratio(folding.pilot_deg)
relative = folding.length_mm / folding.flat_mm
grid = histories.subplots(2, 4, sharex=True, sharey=True)
for hole, axes in enumerate(grid.flat):
    for number in (2 * hole, 2 * hole + 1):
        color = GROWS if grows[number] else SHRINKS
        axes.plot(ratio, relative[:, number], color=color, linewidth=1.2)
        axes.annotate(f"$L_{{{number + 1}}}$", (ratio[folded][-1], relative[folded][-1, number]), (2, 0),
                      textcoords="offset points", va="center", color=color)
    axes.axhline(1, color=PALE, linewidth=0.5, zorder=0)
    row, column = table1.places[table1.holes[hole]]
    axes.set_title(f"hole ({row}, {column})")
grid[0, 0].set(xlim=(1, 0), xticks=(1, 0.5, 0))
histories.supxlabel("deployment ratio D = (180° − pilot) / 180°: 1 flat, 0 folded", fontsize=9)
histories.supylabel("length relative to flat", fontsize=9)
save(figure, "figure13")


# %% How many draws deploy from an angle: full paths of few draws, thresholds of many
campaign = misalign.read(ROOT / "search/campaigns/miura-6x6.json")


def share_interval(hits, draws, z=1.96):
    """Wilson's 95 % interval of a share."""
    middle, width = hits + z * z / 2, z * math.sqrt(hits * (draws - hits) / draws + z * z / 4)
    return (middle - width) / (draws + z * z), (middle + width) / (draws + z * z)


FULL_PATHS, BLOCK = 20_000, 250_000
reached_deg = misalign.judge(campaign, campaign.shifts(range(FULL_PATHS))).deploys_from_deg
counts = [(angle, int((reached_deg >= angle).sum()), FULL_PATHS) for angle in range(5, 156, 5)]
for angle, draws in ((160, 500_000), (165, 1_000_000), (170, 1_500_000), (172, 1_500_000), (174, 1_500_000)):
    hits = sum(int(misalign.judge(campaign, campaign.shifts(range(lo, lo + BLOCK)), angle).sum())
               for lo in range(0, draws, BLOCK))
    counts.append((angle, hits, draws))
angles, hits, draws = np.array(counts).T
low, high = np.array([share_interval(*count[1:]) for count in counts]).T

figure, axes = plt.subplots(figsize=(6.5, 4), layout="constrained")
axes.fill_between(angles, low, high, color=GROWS, alpha=0.2, linewidth=0)
axes.plot(angles, hits / draws, color=GROWS, marker="o", markersize=3, linewidth=1)
axes.set(yscale="log", xlabel="deploys from at least, degrees of the pilot crease", ylabel="share of draws",
         xlim=(0, 180), title="6 × 6 panels, ±0.4 mm: share of draws by threshold, with 95 % intervals")
axes.grid(axis="y", color="#e5e5e5", linewidth=0.5)
for angle in (60, 120, 150, 170, 174):
    share = hits[angles == angle][0] / draws[angles == angle][0]
    axes.annotate(f"{angle}°: {share:.2g}", (angle, share), (-6, -4), textcoords="offset points", ha="right", va="top",
                  fontsize=8)
save(figure, "shares")


# %% Which metrics of candidates go together: Spearman's rank correlations
with catalogue:
    candidates = catalogue.candidates()

METRICS = ["deploys_from_deg", "fold_limit_deg", "miscut_margin_mm", "slope_min_mm_per_deg",
           "slope_between_min_mm_per_deg", "stroke_min", "stroke_max", "elongation_min", "elongation_max",
           "stretch_sq_mm2", "shifted_vertices", "increasing", "kawasaki_defect_deg", "singular_value_min",
           "certified_deg", "yield"]
table = candidates[[name for name in METRICS if name in candidates and candidates[name].nunique() > 1]]
correlation = table.astype(float).corr(method="spearman")

figure, axes = plt.subplots(figsize=(8.5, 6.5), layout="constrained")
axes.imshow(correlation, vmin=-1, vmax=1, cmap="RdBu")
axes.set_xticks(range(len(correlation)), correlation, rotation=40, ha="right", rotation_mode="anchor")
axes.set_yticks(range(len(correlation)), correlation)
axes.spines[:].set_visible(False)
axes.tick_params(length=0)
for (row, column), value in np.ndenumerate(correlation.to_numpy()):
    axes.text(column, row, f"{value:.2f}".replace("-", "−"), ha="center", va="center", fontsize=7,
              color="white" if abs(value) > 0.6 else INK)
axes.set_title(f"Spearman's rank correlation of the metrics of {len(table):,} candidates")
save(figure, "correlations")
