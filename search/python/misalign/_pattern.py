"""Patterns, which are sheets with holes."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from misalign import _misalign
from misalign._folding import Folding


class Pattern:
    """A sheet with its holes, and shifts of its own: what a pattern file holds. Made by `misalign.read`.

    Vertices and facets are numbered from 0, vertex 0 is called "A1". Arrays cannot be written to. A pickle or a
    copy holds all of it, and needs no file.

    `name`             of the file, without its ending, or of the campaign
    `vertices_mm`      [V, 2]: x and y of the correct, flat sheet, without shifts
    `shifts_mm`        [V, 2]: of the file; the sheet that is cut has its vertices at their sum
    `facets`           [F, 4]: vertices, counter-clockwise; `places` [F, 2]: row and column of each
    `holes`            facets that are taken out
    `creases`          [C, 2]: vertices; `valley` [C]: whether it is one, or a mountain, seen from +z
    `pilot`            the crease whose fold angle is prescribed
    `diagonals`        [G, 2]: vertices; two of each hole, in the order of the holes
    `interior`         vertices that are not on the perimeter
    `vertex_labels`, `crease_labels`, `diagonal_labels`: such as "A1", "A2-A9"
    `sample_deg`       the samples, by which sheets are judged, are its multiples
    `end_deg`          up to this pilot angle
    `between_samples`  whether going back between two samples is a fault: False, True (by cubics), "exact"
    `exported`         what an exported candidate's file says of it, None for other patterns

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
    exported: dict[str, Any] | None

    def __init__(self, sheet: _misalign.Sheet) -> None:
        self._sheet = sheet
        said = sheet.describe()
        said["valley"] = np.array(said["valley"], dtype=bool)
        said["exported"] = json.loads(said["exported"])
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
        """Follows the folding path of the sheet, past faults, as far as it goes.

        `stations`   pilot angles in degrees, ascending, 0 for flat and others from 0.01 to 180,
                     at which to look at it; every sample if there are none. Beyond `end_deg` they let the path go on to the last
                     of them. Rows beyond the path's end (`Folding.fold_limit_deg`) are NaN.
        `shifts_mm`  [V, 2], instead of the pattern's own

        Besides the stations every sample is solved: the verdict is by samples. Numbers are those of
        `misalign fold --json` and `misalign replay --json` with the same stations. `misalign.Error` (2) for
        stations that do not ascend, and for shifts that are too large, not finite or of another shape.

        >>> folding = misalign.read("search/patterns/table1.json").fold([0, 45, 90.5])
        >>> folding.length_mm.shape, folding.vertices_mm.shape
        ((3, 16), (3, 49, 3))
        >>> bool((folding.length_mm[0] == folding.flat_mm).all())
        True
        """
        return Folding(_misalign.fold(self._sheet, shifts_mm, stations))
