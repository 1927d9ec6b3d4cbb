"""Patterns, which are sheets with holes."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from misalign import _figures, _misalign
from misalign._arrays import arrays, text
from misalign._folding import Folding
from misalign._numbers import number


def _design(from_deg: float | None = None, stiffness_n_per_mm: float | None = None,
            stroke_limit: float | None = None, friction_n_mm_per_mm: float | None = None,
            thickness_mm: float | None = None, miscut_mm: float | None = None,
            preload_n: float | None = None, fill: dict[str, Any] | None = None,
            diameter_mm: float | None = None) -> str:
    """Returns the design of a call, which overrides the pattern's."""
    for name, value in list(locals().items()):
        if name != "fill" and value is not None:
            number(name, value)
    springs = {"stiffness_n_per_mm": stiffness_n_per_mm, "stroke_limit": stroke_limit, "preload_n": preload_n,
               "diameter_mm": diameter_mm}
    said: dict[str, Any] = {"from_deg": from_deg, "thickness_mm": thickness_mm, "miscut_mm": miscut_mm}
    said["springs"] = {key: value for key, value in springs.items() if value is not None} or None
    said["fill"] = fill
    if friction_n_mm_per_mm is not None:
        said["hinges"] = {"friction_n_mm_per_mm": friction_n_mm_per_mm}
    return text({key: value for key, value in said.items() if value is not None})


def _said(text: str) -> dict[str, Any]:
    said: dict[str, Any] = arrays(json.loads(text))
    return said


class Pattern:
    """A sheet with its holes and shifts: the contents of a pattern file. Made by `misalign.read`.

    Vertices and facets are numbered from 0; vertex 0 is called "A1". Arrays are read only. A pickle or a
    copy is complete, and needs no file.

    `name`             name of the file without its ending, or of the campaign
    `vertices_mm`      [V, 2]: x and y of the flat sheet without shifts
    `shifts_mm`        [V, 2]: shifts of the vertices; the sum of both is the sheet to cut
    `facets`           [F, 4]: vertices, counter-clockwise; `places` [F, 2]: their rows and columns
    `holes`            facets that are taken out; `panels` [P, 4]: vertices of the others
    `creases`          [C, 2]: vertices; `valley` [C]: True for valleys, False for mountains, seen from +z
    `pilot`            the crease whose fold angle is prescribed
    `diagonals`        [G, 2]: vertices; two diagonals per hole, in the holes' order
    `interior`         vertices not on the perimeter
    `vertex_labels`, `crease_labels`, `diagonal_labels`: such as "A1", "A2-A9"
    `sample_deg`       angle between samples, at which sheets are judged
    `end_deg`          largest pilot angle of the samples
    `between_samples`  faults between two samples: False to ignore them, True to find them on cubics, "exact" on the path
    `design`           material, springs, hinges and use: every key of the block `design` of files
    `reading`          sentences on how an ambiguous mesh file was read
    `exported`         values in an exported candidate's file; None for other patterns

    >>> pattern = misalign.read("search/patterns/table1.json")
    >>> pattern.vertices_mm.shape, len(pattern.holes), pattern.crease_labels[pattern.pilot]
    ((49, 2), 8, 'A2-A9')
    >>> pattern.shifts_mm[pattern.vertex_labels.index("A10")].tolist()
    [0.4, 0.0]
    """

    name: str
    vertices_mm: npt.NDArray[np.float64]
    shifts_mm: npt.NDArray[np.float64]
    facets: npt.NDArray[np.int32]
    panels: npt.NDArray[np.int32]
    places: npt.NDArray[np.int32]
    holes: npt.NDArray[np.int32]
    creases: npt.NDArray[np.int32]
    valley: npt.NDArray[np.bool_]
    pilot: int
    diagonals: npt.NDArray[np.int32]
    interior: npt.NDArray[np.int32]
    vertex_labels: list[str]
    crease_labels: list[str]
    diagonal_labels: list[str]
    sample_deg: float
    end_deg: float
    between_samples: bool | str
    design: dict[str, Any]
    reading: list[str]
    exported: dict[str, Any] | None

    def __init__(self, sheet: _misalign.Sheet) -> None:
        self._sheet = sheet
        said = sheet.describe()
        said["valley"] = np.array(said["valley"], dtype=bool)
        said["exported"] = json.loads(said["exported"])
        said["design"] = json.loads(said["design"])
        del said["campaign"]
        for name, value in said.items():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
            setattr(self, name, value)

    def __repr__(self) -> str:
        return f"<misalign.Pattern {self.name}: {len(self.vertices_mm)} vertices, {len(self.holes)} holes>"

    def __reduce__(self) -> tuple[type[Pattern], tuple[_misalign.Sheet]]:
        return type(self), (self._sheet,)

    def fold(self, stations: npt.ArrayLike | None = None, shifts_mm: npt.ArrayLike | None = None) -> Folding:
        """Follows the folding path of the sheet to its end, past faults.

        `stations`   pilot angles in degrees, ascending, 0 for flat and others from 0.01 to 180; None for every sample.
                     Stations beyond `end_deg` extend the path. Rows beyond the path's end (`Folding.fold_limit_deg`)
                     are NaN.
        `shifts_mm`  [V, 2], replace the pattern's

        Every sample is solved too, since the verdict depends on samples. Values are those of
        `misalign fold --json` and `misalign replay --json` with the same stations. `misalign.Error` (2) for
        stations that do not ascend, and for shifts that are too large, not finite or of another shape.

        >>> folding = misalign.read("search/patterns/table1.json").fold([0, 45, 90.5])
        >>> folding.length_mm.shape, folding.vertices_mm.shape
        ((3, 16), (3, 49, 3))
        >>> bool((folding.length_mm[0] == folding.flat_mm).all())
        True
        """
        return Folding(_misalign.fold(self._sheet, shifts_mm, stations))

    def with_shifts(self, shifts_mm: npt.ArrayLike, name: str | None = None) -> Pattern:
        """Returns the pattern with other shifts, [V, 2] in mm, and the same sampling and design.

        `misalign.Error` (2) as from `fold`.

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> other = pattern.with_shifts(pattern.shifts_mm / 2, "half as far")
        >>> float(abs(other.shifts_mm).max()), other.fold().deploys_from_deg > 100
        (0.2, True)
        """
        return Pattern(_misalign.with_shifts(self._sheet, shifts_mm, self.name if name is None else name))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a file that every command of the program and `misalign.read` can read.

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> pattern.write("again.json")
        >>> bool((misalign.read("again.json").shifts_mm == pattern.shifts_mm).all())
        True
        """
        _misalign.write(self._sheet, os.fspath(path))

    def plot(self, pilot_deg: float | None = None, axes: Any = None, magnified: float = 50,
             colours: Any = None) -> Any:
        """Draws the crease pattern with its holes, diagonals and shifts, or the folded sheet; returns matplotlib's axes.

        `pilot_deg`  pilot angle of the folded sheet, in a space; None for the crease pattern
        `axes`       where to draw, in mm (3-D for a folded sheet); None for a new figure in the style `misalign.style`
        `magnified`  factor of the arrows that show the shifts, up to 1000000; 0 for none
        `colours`    colours of the folded sheet's panels [P], any that matplotlib takes; None for paper in a light from above

        Diagonals are blue if they are longer at the end of the path than flat, vermilion if not. `misalign.Error`: 1 without
        matplotlib, 2 for an angle beyond the path's end, and for what is no such number.

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> len(pattern.plot().patches) == len(pattern.facets)
        True
        >>> pattern.plot(pilot_deg=120).get_title()
        'pilot angle 120°'
        """
        magnified = number("magnified", magnified, 0, 1e6)
        if pilot_deg is None:
            return _figures.flat_sheet(self, axes, magnified)
        return _figures.folded_sheet(self, axes, pilot_deg, colours)

    def animate(self, from_deg: float | None = None, to_deg: float = 0, frames: int = 60, interval_ms: float = 50,
                axes: Any = None) -> Any:
        """Animates the deploying sheet; returns matplotlib's `FuncAnimation`, which shows, saves and becomes HTML.

        `from_deg`, `to_deg`  pilot angles of the first and of the last frame, degrees, the first the larger; None for D
        `frames`              number of frames, at equal steps of the angle of at least 0.01 degrees
        `interval_ms`         time between frames, from 1 to 60000 ms
        `axes`                3-D axes, in mm; None for a new figure in the style `misalign.style`

        The motion is that of the folding path, not in time. `misalign.Error`: 1 without matplotlib, 2 for angles beyond the
        path's end or in the wrong order, for less than two frames, and for what is no such number.

        >>> animation = misalign.read("search/patterns/table1.json").animate(from_deg=120, frames=3)
        >>> animation.save("table1.gif", writer="pillow")  # in a notebook: IPython.display.HTML(animation.to_jshtml())
        """
        return _figures.motion(self, from_deg, to_deg, frames, interval_ms, axes)

    def contact(self, from_deg: float | None = None, trim_mm: float | None = None, diameter_mm: float | None = None,
                end_mm: float | None = None, offset_ends: bool = False,
                fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Studies contact of its panels and springs, and largest thickness: the JSON of `misalign contact`.

        `from_deg`  pilot angle between which and flat the sheet is used; None for the design's, or D
        `trim_mm`   trim of the plates' corners
        `diameter_mm` diameter of the springs, of which those that touch are found; None for the design's: without
                    one springs are not judged
        `end_mm`    length left out at each end of a spring; None for two diameters
        `offset_ends` True to find faces and layers of the springs in which none touch
        `fill`      the holes' filling, as the key `fill` of a design, with its `diameter_mm`; None for the design's

        All studies raise `misalign.Error`: 2 for values that do not fit the sheet, 1 if its path is lost or its panels
        are too thin to bend.

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> pattern.contact(from_deg=90)["thickness"]["reaches_deg"]
        90.0
        >>> len(pattern.contact(from_deg=90, diameter_mm=5)["springs"]["springs"]["touching"])
        8
        """
        return _said(_misalign.contact(self._sheet, _design(from_deg, fill=fill, diameter_mm=diameter_mm), trim_mm,
                                       end_mm, offset_ends))

    def actuators(self, from_deg: float | None = None, stiffness_n_per_mm: float | None = None,
                  stroke_limit: float | None = None, preload_n: float | None = None,
                  fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Studies the filling of its holes: the JSON of `misalign actuators`, with arrays for lists of numbers.

        Values not given are the design's. `fill`: the holes' filling, as the key `fill` of a design.

        >>> springs = misalign.read("search/patterns/table1.json").actuators(from_deg=140, stiffness_n_per_mm=2)
        >>> len(springs["forces"]), springs["history"]["energy_n_mm"].shape
        (16, (157,))
        >>> plates = misalign.read("search/patterns/table1.json").actuators(from_deg=140, fill={"kind": "plate"})
        >>> plates["fill"]["shear_mpa"], plates["history"]["energy_n_mm"][36] > 0
        (0.5, True)
        """
        return _said(_misalign.actuators(self._sheet, _design(
            from_deg, stiffness_n_per_mm, stroke_limit, preload_n=preload_n, fill=fill)))

    def choose_springs(self, from_deg: float | None = None, friction_n_mm_per_mm: float | None = None,
                       most_rate_n_per_mm: float = 50, rates_n_per_mm: Sequence[float] = (), free_within: float = 0.05,
                       pull_only: bool = False, one_a_hole: bool = False, never_both: Sequence[str] = (),
                       most_springs: int | None = None, fewest_margin: float | None = None,
                       equal_lengths_share: float | None = None) -> dict[str, Any]:
        """Chooses rates and free lengths of its springs: the JSON of `misalign actuators --choose`.

        Values not given are the design's.

        `most_rate_n_per_mm`, `rates_n_per_mm`  largest rate, N/mm, and rates to choose from; () for any
        `free_within`          largest difference of a free length from flat, as a share
        `pull_only`, `one_a_hole`, `never_both`  True for springs that always pull; for one a hole at most; pairs of
                               diagonals that do not both carry springs: `["A3-A9,A4-A8"]`
        `most_springs`         largest number of springs
        `fewest_margin`        as few springs as have this static margin over the friction
        `equal_lengths_share`  equal free lengths where this share of the friction overcome remains

        >>> chosen = misalign.read("search/patterns/table1.json").choose_springs(one_a_hole=True, most_rate_n_per_mm=1)
        >>> springs = chosen["choice"]["fill"]["single"]
        >>> chosen["choice"]["drives"], sum(spring["stiffness_n_per_mm"] > 0 for spring in springs) <= 8
        (True, True)
        """
        return _said(_misalign.choose_springs(
            self._sheet, _design(from_deg, None, None, friction_n_mm_per_mm), most_rate_n_per_mm=most_rate_n_per_mm,
            rates_n_per_mm=list(rates_n_per_mm), free_within=free_within, pull_only=pull_only, one_a_hole=one_a_hole,
            never_both=[never_both] if isinstance(never_both, str) else list(never_both), most_springs=most_springs, fewest_margin=fewest_margin,
            equal_lengths_share=equal_lengths_share))

    def buy_springs(self, springs: str | os.PathLike[str] | None = None, from_deg: float | None = None,
                    friction_n_mm_per_mm: float | None = None, static_margin: float | None = None,
                    thickness_mm: float | None = None, least: str = "types", push: bool = False,
                    link_step_mm: float = 1, least_link_mm: float = 5) -> dict[str, Any]:
        """Chooses springs to buy, each with a link of wire: the JSON of `misalign actuators --buy`.

        Values not given are the design's.

        `springs`        a table of springs, a CSV file; None for common springs
        `static_margin`  margin over the friction; None for the design's, or 1
        `thickness_mm`   with a thickness the margin is that of panels that bend
        `least`          "types": as few types as can be, then the least price; "price": the least price
        `push`           True if springs that push may be taken, too
        `link_step_mm`, `least_link_mm`  links are multiples of the first, and not shorter than the second

        >>> bought = misalign.read("search/patterns/table1.json").buy_springs(from_deg=120)["bought"]
        >>> bought["drives"], len(bought["groups"]) <= len(bought["springs"]), bought["fill"]["kind"]
        (True, True, 'springs')
        """
        return _said(_misalign.buy_springs(
            self._sheet, _design(from_deg, None, None, friction_n_mm_per_mm, thickness_mm),
            springs=None if springs is None else os.fspath(springs), static_margin=static_margin, least=least,
            push=push, link_step_mm=link_step_mm, least_link_mm=least_link_mm))

    def judged_by(self, by: str, fill: dict[str, Any] | None = None) -> Pattern:
        """Returns the pattern judged by another criterion: "diagonals", or "energy" of a filling.

        `fill`  the filling whose total energy has to fall to flat, as the key `fill` of campaigns' `accept`; None for
                springs of 50 N/mm

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> by_energy = pattern.judged_by("energy").fold().deploys_from_deg
        >>> by_energy >= pattern.judged_by("diagonals").fold().deploys_from_deg == pattern.fold().deploys_from_deg
        True
        """
        accept: dict[str, Any] = {"by": by}
        if fill is not None:
            accept["fill"] = fill
        return Pattern(_misalign.judged_by(self._sheet, text(accept)))

    def deploy(self, from_deg: float | None = None, stiffness_n_per_mm: float | None = None,
               friction_n_mm_per_mm: float | None = None, thickness_mm: float | None = None,
               preload_n: float | None = None, bend: bool | None = None,
               fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Studies its motion after release: the JSON of `misalign deploy`, with arrays for lists of numbers.

        Values not given are the design's. `bend`: True to add bending panels, under "bent"; None to do so if the design
        names a material. `fill`: the holes' filling, as the key `fill` of a design.

        >>> let_go = misalign.read("search/patterns/table1.json").deploy(from_deg=90)
        >>> let_go["outcome"], let_go["critical_friction_n_mm_per_mm"] > 0
        ('passed_flat', True)
        """
        return _said(_misalign.deploy(self._sheet, _design(
            from_deg, stiffness_n_per_mm, None, friction_n_mm_per_mm, thickness_mm, preload_n=preload_n, fill=fill),
            bend))

    def gradient(self, stations: npt.ArrayLike) -> dict[str, Any]:
        """Returns exact gradients by the vertices' flat coordinates at fixed pilot angles, by the adjoint method.

        `stations`  pilot angles in degrees, ascending, 0 for flat; NaN beyond the path's end

        Arrays: `length_mm` [S, G] and `length_by_mm` [S, G, V, 2] of the diagonals, `fold_deg` [S, C] and `fold_by_mm`
        [S, C, V, 2] of the creases (degrees per mm), `slope_mm_per_rad` [S, G] and `slope_by_mm` [S, G, V, 2] of the
        diagonals by the pilot's angle, `folded_mm` [S, V, 3] and `folded_by_mm` [S, V, 3, V, 2] of the folded sheet, its
        first panel held where it lies on the flat sheet whose A1 is moved to the origin (NaN flat; `fold` lays its shapes over
        the flat sheet as it is), `fold_limit_by_mm` [V, 2], None if it folds to 180 degrees.

        >>> found = misalign.read("search/patterns/table1.json").gradient([36, 90])
        >>> found["length_by_mm"].shape, found["fold_by_mm"].shape, found["fold_limit_by_mm"].shape
        ((2, 16, 49, 2), (2, 28, 49, 2), (49, 2))
        >>> found["slope_by_mm"].shape, found["folded_by_mm"].shape
        ((2, 16, 49, 2), (2, 49, 3, 49, 2))
        """
        found: dict[str, Any] = _misalign.gradient(self._sheet, stations)
        return found

    def optimise(self, goal: str = "critical_friction_n_mm_per_mm", amplitude_mm: float | None = None,
                 deploys_from_deg: float | None = None, ternary: bool = False, from_deg: float | None = None,
                 stiffness_n_per_mm: float | None = None, stroke_limit: float | None = None,
                 preload_n: float | None = None, thickness_mm: float | None = None, grid_mm: float | None = None,
                 within_family: bool = False, subject_to: Sequence[str] = (),
                 stiffness_within: Sequence[float] = (), preload_within: Sequence[float] = (),
                 rest_deg: float | None = None, miscut_mm: float | None = None, trials: int = 200, rim: bool = False,
                 keep_card: bool = False) -> tuple[Pattern, dict[str, Any]]:
        """Optimises this sheet; returns the optimum and the JSON of `misalign optimise`.

        `goal`              objective, any that `misalign optimise --help` lists
        `amplitude_mm`      bound of the shifts in x and y; None for the largest of its shifts
        `deploys_from_deg`  D that it must keep; None for its D
        `ternary`           shifts of 0 and ± the amplitude alone
        `grid_mm`           grid of the shifts; those of this sheet are rounded to it
        `rim`               True to shift the rim's vertices, too
        `within_family`     True for members of the base's parallel family alone
        `keep_card`         True to keep the requirements that its card meets: stress, margins, buckling, clearances
        `subject_to`        constraints: `"stroke_max <= 0.06"`, `"miscut_margin_mm >= 0.1"`, `"shape_max_mm <= 0.5"`
        `stiffness_within`, `preload_within`  bounds of the springs' stiffness and preload, which are optimised too
        `rest_deg`          pilot angle at which springs are relaxed; None for flat
        `miscut_mm`, `trials`  cutting error, None for the design's, and number of copies, for yields

        >>> better, said = misalign.read("search/patterns/table1.json").optimise(deploys_from_deg=150, ternary=True)
        >>> said["after_n_mm_per_mm"] > 5 * said["before_n_mm_per_mm"], better.fold().deploys_from_deg >= 150
        (True, True)
        """
        said: dict[str, Any] = json.loads(_misalign.optimise(
            self._sheet, _design(from_deg, stiffness_n_per_mm, stroke_limit, None, thickness_mm, preload_n=preload_n),
            goal=goal, amplitude_mm=amplitude_mm, deploys_from_deg=deploys_from_deg, ternary=ternary, grid_mm=grid_mm,
            rim=rim, within_family=within_family, keep_card=keep_card, subject_to=list(subject_to),
            stiffness_within=list(stiffness_within), preload_within=list(preload_within), rest_deg=rest_deg, miscut_mm=miscut_mm, trials=trials))
        return Pattern(_misalign.read_document(text(said["pattern"]), "optimised")), said

    def card(self, trials: int = 1000, jobs: int = 1, fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Judges the sheet by the requirements of its design: the JSON of `misalign card --no-remedies`.

        `trials`, `jobs`  number of miscut copies and of copies with play, and of threads
        `fill`            the holes' filling, as the key `fill` of a design; None for the design's

        >>> card = misalign.read("search/patterns/table1.json").card()
        >>> card["passes"], [line["key"] for line in card["lines"] if line["passes"] is False]
        (False, ['spring_clearance_mm'])
        """
        return _said(_misalign.card(self._sheet, _design(fill=fill), trials, jobs))

    def tolerance(self, amplitude_mm: float | None = None, trials: int = 1000, jobs: int = 1,
                  from_deg: float | None = None, fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Studies the yield of miscut copies: the JSON of `misalign tolerance` for a pattern.

        `amplitude_mm`  largest cutting error of a vertex in x and in y; None for the design's `miscut_mm`
        `from_deg`      D that copies must reach; None for the design's, or the sheet's
        `jobs`          number of threads; the result does not depend on it
        `fill`          the holes' filling, as the key `fill` of a design; None for the design's. Where it is relaxed
                        half open, `stops` says where copies stop

        >>> pattern = misalign.read("search/patterns/table1.json")
        >>> pattern.tolerance(0.01, trials=20, from_deg=90)["from_threshold"]["copies"]
        20
        >>> pattern.tolerance(0.01, trials=20, from_deg=120, fill={"kind": "springs", "rest_deg": 60})["stops"]["stopped"]
        20
        """
        if amplitude_mm is not None:
            _misalign.check_design("amplitude_mm", "miscut_mm", amplitude_mm)
        return _said(_misalign.tolerance(self._sheet, _design(from_deg, miscut_mm=amplitude_mm, fill=fill), trials,
                                          jobs))

    def certify(self, from_deg: float | None = None, contact: bool = False, criterion: str | None = None,
                fill: dict[str, Any] | None = None) -> dict[str, Any]:
        """Makes a certificate up to an angle: the "certificate" in the JSON of `misalign certify`.

        `from_deg`  pilot angle to certify; None for the design's, or D
        `contact`   True to prove also that no panels meet
        `criterion` "diagonals", each of which is monotone, or "energy", whose total falls to flat; None for that by
                    which the sheet is judged
        `fill`      the filling of that energy, as the key `fill` of a design; None for the design's

        >>> misalign.read("search/patterns/table1.json").certify(from_deg=20)["certified_deg"]
        20.0
        >>> misalign.read("search/patterns/table1.json").certify(from_deg=20, criterion="energy")["by"]
        'energy'
        """
        return _said(_misalign.certify(self._sheet, _design(from_deg, fill=fill), contact, criterion))
