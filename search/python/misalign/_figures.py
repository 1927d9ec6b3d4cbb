"""Figures of sheets, foldings and catalogues, by matplotlib."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from misalign._error import Error
from misalign._numbers import number, pilot_angle, whole

if TYPE_CHECKING:
    from misalign._catalogue import Catalogue
    from misalign._folding import Folding
    from misalign._pattern import Pattern

style = os.path.join(os.path.dirname(os.path.abspath(__file__)), "figures.mplstyle")

# Okabe and Ito's colours, as in the style.
BLUE, VERMILION, ORANGE, HOLE, EDGE, PAPER = "#0072B2", "#D55E00", "#E69F00", "#dddddd", "#999999", "#f4e3bd"

# Ends of columns' names, the longest first.
UNITS = {"_n_mm_per_mm": "N mm/mm", "_mm_per_deg": "mm/°", "_deg_per_s": "°/s", "_per_m": "1/m", "_n_mm": "N mm",
         "_mm2": "mm²", "_mm": "mm", "_deg": "°", "_s": "s"}


def pyplot() -> Any:
    """Returns the module `matplotlib.pyplot`."""
    try:
        import matplotlib.pyplot as plt  # type: ignore[import]
    except ImportError as error:
        raise Error("matplotlib is missing, which figures need (a separate package); install it, such as Debian's "
                    "python3-matplotlib") from error
    return plt


@contextmanager
def _axes(axes: Any, **options: Any) -> Iterator[Any]:
    """Gives the caller's axes as they are, or those of a new figure in the style."""
    plt = pyplot()
    if axes is not None:
        if not isinstance(axes, plt.Axes):
            raise Error(f"axes: are of the type {type(axes).__name__}, not axes; make some with matplotlib.pyplot.subplots", 2)
        if options.get("projection") == "3d" and not hasattr(axes, "get_zlim"):
            raise Error('axes: are not those of a space; make them with projection="3d"', 2)
        yield axes
        return
    with plt.style.context(style):
        yield plt.figure().add_subplot(**options)


def lengths(folding: Folding, axes: Any) -> Any:
    """Draws the diagonals' elongations along the path."""
    elongation = 100 * (folding.length_mm / folding.flat_mm - 1)
    known = elongation[~np.isnan(elongation).any(axis=1)]
    lengthens = known[-1] > 0 if len(known) else np.zeros(len(folding.flat_mm), dtype=bool)
    with _axes(axes) as axes:
        for grows, color, label in ((True, BLUE, "lengthen as it folds"), (False, VERMILION, "shorten")):
            for count, number in enumerate(np.flatnonzero(lengthens == grows)):
                axes.plot(folding.pilot_deg, elongation[:, number], color=color, gid=f"diagonal-{number}",
                          label="_again" if count else label)
        axes.axvline(folding.deploys_from_deg, color="black", linestyle=":", linewidth=1,
                     label=f"deploys from {folding.deploys_from_deg:g}°")
        axes.set(xlabel="pilot angle (°)", ylabel="elongation of the diagonals (%)")
        axes.legend()
    return axes


def flat_sheet(pattern: Pattern, axes: Any, magnified: float) -> Any:
    """Draws the crease pattern, with shifts as arrows."""
    flat_mm = pattern.vertices_mm + pattern.shifts_mm
    folding = pattern.fold()
    lengthens = folding.length_mm[-1] > folding.flat_mm
    with _axes(axes) as axes:
        for number, facet in enumerate(pattern.facets):
            axes.fill(*flat_mm[facet].T, facecolor=HOLE if number in pattern.holes else "white", edgecolor=EDGE, linewidth=0.5)
        pilot = flat_mm[pattern.creases[pattern.pilot]]
        axes.plot(*pilot.T, color=ORANGE, linewidth=5, alpha=0.7, solid_capstyle="butt", label="pilot crease")
        for edges, label, looks in (
                (pattern.creases[~pattern.valley], "mountains", {"color": "black", "linewidth": 0.9, "dashes": (6, 2, 1, 2)}),
                (pattern.creases[pattern.valley], "valleys", {"color": "black", "linewidth": 0.9, "dashes": (4, 2)}),
                (pattern.diagonals[lengthens], "lengthen as it folds", {"color": BLUE}),
                (pattern.diagonals[~lengthens], "shorten", {"color": VERMILION})):
            for count, edge in enumerate(edges):
                axes.plot(*flat_mm[edge].T, label="_again" if count else label, **looks)
        shifted = np.flatnonzero(np.abs(pattern.shifts_mm).max(axis=1) > 0)
        if magnified and len(shifted):
            axes.quiver(*flat_mm[shifted].T, *(magnified * pattern.shifts_mm[shifted]).T, angles="xy", scale_units="xy",
                        scale=1, width=0.005, zorder=3, label=f"shifts, × {magnified:g}")
        axes.set_aspect("equal")
        axes.axis("off")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3)
    return axes


def _shades(corners_mm: npt.NDArray[np.float64], color: str) -> npt.NDArray[np.float64]:
    """Returns colours of panels [P, 4] in a light from above, by the normals of their corners [P, 4, 3]."""
    from matplotlib.colors import to_rgba  # type: ignore[import]
    normals = np.cross(corners_mm[:, 2] - corners_mm[:, 0], corners_mm[:, 3] - corners_mm[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    light = np.abs(normals @ np.array([0.36, -0.48, 0.8]))
    shaded = np.tile(to_rgba(color), (len(normals), 1))
    shaded[:, :3] *= (0.6 + 0.4 * light)[:, np.newaxis]
    return shaded


def space(axes: Any, points_mm: npt.NDArray[np.float64]) -> None:
    """Sets the limits of 3-D axes round points [..., 3], with one scale in x, y and z."""
    points_mm = points_mm.reshape(-1, 3)
    least, most = points_mm.min(axis=0), points_mm.max(axis=0)
    sides = np.maximum(most - least, 0.02 * (most - least).max())
    middle = (least + most) / 2
    axes.set(**{f"{axis}lim": (middle[k] - sides[k] / 2, middle[k] + sides[k] / 2) for k, axis in enumerate("xyz")})
    axes.set_box_aspect(sides, zoom=1.08)
    axes.view_init(elev=35, azim=-60)
    axes.axis("off")


def panels(pattern: Pattern, axes: Any, shape_mm: npt.NDArray[np.float64], colours: Any = None) -> Any:
    """Adds the panels of a folded sheet to 3-D axes, in one colour or each in its own; returns their collection."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import]
    corners_mm = shape_mm[pattern.panels]
    colours = _shades(corners_mm, PAPER) if colours is None else colours
    return axes.add_collection3d(Poly3DCollection(corners_mm, facecolors=colours, edgecolors="#444444", linewidths=0.5,
                                                  clip_on=False))


def _shapes_mm(pattern: Pattern, stations_deg: npt.NDArray[np.float64], name: str) -> npt.NDArray[np.float64]:
    """Returns the folded sheet [S, V, 3] at stations that ascend."""
    folding = pattern.fold(stations_deg)
    if np.isnan(folding.vertices_mm).any():
        most_deg = np.floor(100 * folding.fold_limit_deg) / 100
        raise Error(f"{name}={stations_deg[-1]:g}: lies beyond the path's end; give at most {most_deg:g}", 2)
    return folding.vertices_mm


def folded_sheet(pattern: Pattern, axes: Any, pilot_deg: float, colours: Any) -> Any:
    """Draws the folded sheet."""
    pilot_deg = pilot_angle("pilot_deg", pilot_deg)
    shape_mm = _shapes_mm(pattern, np.array([pilot_deg]), "pilot_deg")[0]
    with _axes(axes, projection="3d") as axes:
        panels(pattern, axes, shape_mm, colours)
        space(axes, shape_mm)
        axes.set_title(f"pilot angle {pilot_deg:g}°")
    return axes


def motion(pattern: Pattern, from_deg: float | None, to_deg: float, frames: int, interval_ms: float, axes: Any) -> Any:
    """Animates the sheet from one pilot angle down to another."""
    pyplot()
    to_deg, frames = pilot_angle("to_deg", to_deg), whole("frames", frames, 2, 18001)
    interval_ms = number("interval_ms", interval_ms, 1, 60000)
    from_deg = pattern.fold().deploys_from_deg if from_deg is None else pilot_angle("from_deg", from_deg)
    if not from_deg > to_deg:
        raise Error(f"from_deg={from_deg:g}: is not above to_deg={to_deg:g}, to which the sheet deploys", 2)
    if (from_deg - to_deg) / (frames - 1) < 0.01:
        raise Error(f"frames={frames}: makes steps of less than 0.01 degrees; give fewer, or angles farther apart", 2)
    from matplotlib.animation import FuncAnimation  # type: ignore[import]
    stations_deg = np.linspace(to_deg, from_deg, frames)
    shapes_mm = _shapes_mm(pattern, stations_deg, "from_deg")[::-1]
    with _axes(axes, projection="3d") as axes:
        sheet = panels(pattern, axes, shapes_mm[0])
        space(axes, shapes_mm)
        title = axes.set_title("")

    def show(frame: int) -> tuple[Any, Any]:
        corners_mm = shapes_mm[frame][pattern.panels]
        sheet.set_verts(corners_mm)
        sheet.set_facecolor(_shades(corners_mm, PAPER))
        title.set_text(f"pilot angle {stations_deg[-1 - frame]:.0f}°")
        return sheet, title

    return FuncAnimation(axes.figure, show, frames=frames, interval=interval_ms)


def axis_label(column: str) -> str:
    """Returns a column's name as the label of an axis, with its unit; functions of sheets as they are written.

    >>> from misalign._figures import axis_label
    >>> axis_label("miscut_margin_mm"), axis_label("stroke_max"), axis_label("energy_n_mm(draw, 140)")
    ('miscut margin (mm)', 'stroke max', 'energy_n_mm(draw, 140)')
    """
    if "(" in column:
        return column
    if column == "deploys_from_deg":
        return "D (°)"
    for end, unit in UNITS.items():
        if column.endswith(end):
            return f"{column.removesuffix(end).replace('_', ' ')} ({unit})"
    return column.replace("_", " ")


def candidates(catalogue: Catalogue, x: str, y: str, colour: str, where: str | None, limit: int | None, axes: Any) -> Any:
    """Draws candidates as points."""
    pyplot()
    table = catalogue.candidates(where, limit=limit, columns=dict.fromkeys((x, y, colour)))
    with _axes(axes) as axes:
        points = axes.scatter(table[x].astype(float), table[y].astype(float), c=table[colour].astype(float), s=8)
        axes.set(xlabel=axis_label(x), ylabel=axis_label(y))
        axes.figure.colorbar(points, ax=axes, label=axis_label(colour))
    return axes
