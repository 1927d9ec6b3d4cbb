"""Foldings, which are folding paths at stations."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from misalign import _figures


class Folding:
    """The folding path of a sheet, with a row for each station. Made by `Pattern.fold` and `Catalogue.replay`.

    `pilot_deg`        [S]: the stations
    `length_mm`        [S, G]: lengths of the diagonals
    `rate_mm_per_deg`  [S, G]: their rates of change with the pilot angle
    `fold_angle_deg`   [S, C]: fold angles of the creases: 0 flat, 180 closed, valleys positive
    `vertices_mm`      [S, V, 3]: the folded sheet, placed with the least distance from the flat one
    `flat_mm`          [G]: lengths of the diagonals when flat
    `shifts_mm`        [V, 2]: shifts of this sheet
    `fold_limit_deg`   largest pilot angle of the path, or the angle up to which it was followed
    `deploys_from_deg` D: the largest sample up to which there is no fault
    `first_fault`      the fault after D, one of `misalign.faults`; "none" at the end of the path
    `fault_deg`        the sample that shows it; None without one
    `where`            label of the crease or diagonal that shows it; None without one
    `bump_between_samples`  the first reversal and return of a diagonal between two samples up to D, or at the
                       first fault: {"from_deg", "where"}; None without one
    `accepted`         True if a campaign's sheet is a candidate; None for a pattern

    >>> folding = misalign.read("search/patterns/table1.json").fold()
    >>> folding.deploys_from_deg, folding.first_fault, folding.fault_deg, folding.where
    (156.0, 'fold_limit', 157.0, None)
    >>> elongation = folding.length_mm / folding.flat_mm - 1
    >>> f"{elongation.min():.3f} to {elongation.max():.3f}"
    '-0.052 to 0.027'
    """

    pilot_deg: npt.NDArray[np.float64]
    length_mm: npt.NDArray[np.float64]
    rate_mm_per_deg: npt.NDArray[np.float64]
    fold_angle_deg: npt.NDArray[np.float64]
    vertices_mm: npt.NDArray[np.float64]
    flat_mm: npt.NDArray[np.float64]
    shifts_mm: npt.NDArray[np.float64]
    fold_limit_deg: float
    deploys_from_deg: float
    first_fault: str
    fault_deg: float | None
    where: str | None
    bump_between_samples: dict[str, Any] | None
    accepted: bool | None

    def __init__(self, said: dict[str, Any]) -> None:
        verdict = json.loads(said.pop("verdict"))
        said.update({name: verdict.get(name) for name in
                     ("deploys_from_deg", "first_fault", "fault_deg", "where", "bump_between_samples", "accepted")})
        for name, value in said.items():
            setattr(self, name, value)

    def plot(self, axes: Any = None) -> Any:
        """Draws the elongations of the diagonals in percent, against the pilot angle in degrees; returns matplotlib's axes.

        `axes`  where to draw; None for a new figure in the style `misalign.style`

        A line for each diagonal, with a point for each station: blue if it is longer than flat at the last one, vermilion
        if not. A dotted line marks D. `misalign.Error` (1) without matplotlib.

        >>> axes = misalign.read("search/patterns/table1.json").fold().plot()
        >>> len(axes.lines), axes.get_xlabel(), axes.get_ylabel()  # 16 diagonals, and D
        (17, 'pilot angle (°)', 'elongation of the diagonals (%)')
        """
        return _figures.lengths(self, axes)

    def __repr__(self) -> str:
        return (f"<misalign.Folding: {len(self.pilot_deg)} stations, deploys from {self.deploys_from_deg:g} deg, "
                f"{self.first_fault}>")
