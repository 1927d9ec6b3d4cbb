"""Verdicts on many sheets at once."""

from __future__ import annotations

import json
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from misalign import _misalign
from misalign._campaign import Campaign
from misalign._error import UndecidedError
from misalign._pattern import Pattern

#: Names of the faults, by their numbers in `Verdicts.first_fault`.
faults: tuple[str, ...] = _misalign.faults


class Verdicts:
    """Verdicts on N sheets. Made by `misalign.judge`.

    `deploys_from_deg`  [N], float64: D, the largest sample up to which there is no fault
    `first_fault`       [N], uint8: the fault after D, an index into `misalign.faults` (with the names of
                        `Folding.first_fault`); `fault` is an older name of the same array
    `where`             [N], int32: the diagonal that shows it (for over_folded and assignment_flipped the
                        crease) by its number in the pattern, or -1

    >>> pattern = misalign.read("search/patterns/table1.json")
    >>> verdicts = misalign.judge(pattern, -pattern.shifts_mm[np.newaxis])
    >>> misalign.faults[verdicts.first_fault[0]], pattern.diagonal_labels[verdicts.where[0]]
    ('not_monotone', 'A33-A39')
    """

    def __init__(self, deploys_from_deg: npt.NDArray[np.float64], first_fault: npt.NDArray[np.uint8],
                 where: npt.NDArray[np.int32]) -> None:
        self.deploys_from_deg = deploys_from_deg
        self.first_fault = first_fault
        self.where = where

    @property
    def fault(self) -> npt.NDArray[np.uint8]:
        return self.first_fault

    def __len__(self) -> int:
        return len(self.first_fault)

    def __repr__(self) -> str:
        return f"<misalign.Verdicts on {len(self)} sheets>"


@overload
def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike, threshold_deg: None = None, *,
          by: Literal["diagonals", "energy"] | None = None,
          fill: dict[str, Any] | None = None) -> Verdicts: ...
@overload
def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike, threshold_deg: float, *,
          by: Literal["diagonals", "energy"] | None = None,
          fill: dict[str, Any] | None = None) -> npt.NDArray[np.bool_]: ...


def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike,
          threshold_deg: float | None = None, *,
          by: Literal["diagonals", "energy"] | None = None,
          fill: dict[str, Any] | None = None) -> Verdicts | npt.NDArray[np.bool_]:
    """Judges N sheets in lanes: the pattern with each of these shifts instead of its own.

    `pattern`        a campaign's sheets are judged as its draws are, and fastest
    `shifts_mm`      [N, V, 2]: x and y of every vertex, of any numeric type; contiguous doubles
                     are not copied
    `threshold_deg`  a whole multiple of `sample_deg`, to judge only whether sheets deploy from it. Most are
                     rejected before their path is followed, a thousand times faster than all verdicts
    `by`             "diagonals": every diagonal is monotone. "energy": the energy of the filling falls to
                     flat at every sample, without a margin. None: as the campaign's draws are judged
    `fill`           filling for "energy", as in `accept.fill` of a campaign: `{"kind": "springs",
                     "stiffness_n_per_mm": 50}` (the default) or `{"kind": "plate", "prestretch": 1.1}`,
                     relaxed flat and equal in all holes

    Returns `Verdicts`, each on its full path, or with a threshold a bool array [N]: accepted or not.
    Verdicts are those of the program on any machine. For members of the parallel family, whose creases all
    close at 180 degrees at once, they end at the sample before, as in `Pattern.fold`.

    Uses one core without Python's lock, so that threads can judge in parallel. Ctrl-C ends it within a
    second. The model of a pattern and a threshold (a tenth of a second to build, less for small sheets) is
    cached for further calls, for the last four.

    `misalign.Error` (2) for another shape, shifts that are not finite, shifts with which a facet is not
    convex, impossible thresholds, and a filling without `by="energy"`. `misalign.UndecidedError` if a threshold is given and a sheet
    cannot be judged.

    >>> campaign = misalign.read("search/campaigns/miura-4x4.json")
    >>> shifts_mm = campaign.shifts(range(200))
    >>> verdicts = misalign.judge(campaign, shifts_mm)
    >>> accepted = misalign.judge(campaign, shifts_mm, threshold_deg=100)
    >>> bool((accepted == (verdicts.deploys_from_deg >= 100)).all())
    True
    >>> driven = misalign.judge(campaign, shifts_mm, threshold_deg=100, by="energy")
    >>> bool(driven[accepted].all() and driven.sum() > accepted.sum())
    True
    """
    sheet = pattern._sheet
    if by is not None or fill is not None:
        accept = {"by": by or "diagonals", "fill": fill}
        sheet = _misalign.judged_by(sheet, json.dumps(accept))
    if threshold_deg is None:
        return Verdicts(*_misalign.verdicts(sheet, shifts_mm))
    standings = _misalign.accepted(sheet, shifts_mm, threshold_deg)
    if standings.max(initial=0) > 1:
        raise UndecidedError(np.flatnonzero(standings == 2), standings == 1)
    return standings.view(np.bool_)
