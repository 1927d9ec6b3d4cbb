"""Verdicts on many sheets at once."""

from __future__ import annotations

from typing import overload

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

    `deploys_from_deg`  [N], float64: D, the largest sample up to which everything is in order
    `first_fault`       [N], uint8: what ends that, an index into `misalign.faults` (which has the names that
                        `Folding.first_fault` says); `fault` is an older name of the same array
    `where`             [N], int32: the diagonal that shows it (of over_folded and assignment_flipped the
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
def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike, threshold_deg: None = None) -> Verdicts: ...
@overload
def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike,
          threshold_deg: float) -> npt.NDArray[np.bool_]: ...


def judge(pattern: Pattern | Campaign, shifts_mm: npt.ArrayLike,
          threshold_deg: float | None = None) -> Verdicts | npt.NDArray[np.bool_]:
    """Judges N sheets, in lanes: each the pattern with these shifts instead of its own.

    `pattern`        a campaign's sheets are judged as its draws are, and fastest
    `shifts_mm`      [N, V, 2]: x and y of every vertex; any kind of number, of which doubles that lie one
                     after another are not copied
    `threshold_deg`  a whole multiple of `sample_deg`: asks only which sheets deploy from there. Most are
                     rejected before their path is followed, a thousand times faster than all verdicts

    Without a threshold `Verdicts`, each on its full path; with one a bool array [N]: accepted or not.
    Verdicts are those of the program, whatever the machine. Those of members of the parallel family, all of whose creases
    close at 180 degrees at once, end at the sample before, as those of `Pattern.fold` do.

    Works on one core and without Python's lock: threads judge side by side. Ctrl-C ends it within a
    second. What is made ready for a pattern and a threshold (a tenth of a second, less on small sheets) is
    kept for the next call, for the last four.

    `misalign.Error` (2) for another shape, shifts that are not finite or so large that a facet is not
    convex any more, and no such threshold. `misalign.UndecidedError` where a threshold is asked for and a sheet
    cannot be judged.

    >>> campaign = misalign.read("search/campaigns/miura-4x4.json")
    >>> shifts_mm = campaign.shifts(range(200))
    >>> verdicts = misalign.judge(campaign, shifts_mm)
    >>> accepted = misalign.judge(campaign, shifts_mm, threshold_deg=100)
    >>> bool((accepted == (verdicts.deploys_from_deg >= 100)).all())
    True
    """
    if threshold_deg is None:
        return Verdicts(*_misalign.verdicts(pattern._sheet, shifts_mm))
    standings = _misalign.accepted(pattern._sheet, shifts_mm, threshold_deg)
    if standings.max(initial=0) > 1:
        raise UndecidedError(np.flatnonzero(standings == 2), standings == 1)
    return standings.view(np.bool_)
