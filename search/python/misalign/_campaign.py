"""Campaigns, which draw shifts of a pattern."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from misalign import _misalign
from misalign._pattern import Pattern


class Campaign:
    """What a campaign file says: which sheets are drawn, and which are accepted. Made by `misalign.read`.

    `name`, `identity`, `seed`
    `pattern`        the correct sheet, sampled as the campaign's draws are
    `threshold_deg`  D that an accepted draw reaches
    `amplitude_mm`   the size of the shifts; `levels`: "ternary" (-a, 0, a) or "uniform" (on [-a, a])
    `vertices`       those that are shifted
    `is_splitting`   whether populations climb instead of plain draws
    `configuration`  every key of the file, resolved

    A pickle or a copy holds all of it, and needs no file.

    >>> campaign = misalign.read("search/campaigns/miura-4x4.json")
    >>> campaign.threshold_deg, campaign.amplitude_mm, campaign.levels
    (150.0, 0.4, 'ternary')
    """

    name: str
    identity: str
    seed: int
    threshold_deg: float
    amplitude_mm: float
    levels: str
    vertices: npt.NDArray[np.int32]
    is_splitting: bool
    configuration: dict[str, Any]

    def __init__(self, sheet: _misalign.Sheet) -> None:
        self._sheet = sheet
        said = sheet.describe()["campaign"]
        said["configuration"] = json.loads(said["configuration"])
        for name, value in said.items():
            setattr(self, name, value)
        self.pattern = Pattern(sheet)

    def __repr__(self) -> str:
        return f"<misalign.Campaign {self.name} ({self.identity[:8]})>"

    def __reduce__(self) -> tuple[type[Campaign], tuple[_misalign.Sheet]]:
        return type(self), (self._sheet,)

    def shifts(self, draws: npt.ArrayLike | range) -> npt.NDArray[np.float64]:
        """The shifts of these draws, [N, V, 2] in mm: seed and number alone determine them.

        `misalign.Error` (2) for what is no number of a draw, and of a splitting campaign, whose numbers
        are none (`Catalogue.shifts` has its candidates').

        >>> campaign = misalign.read("search/campaigns/miura-4x4.json")
        >>> shifts_mm = campaign.shifts(range(1000))
        >>> int(misalign.judge(campaign, shifts_mm, campaign.threshold_deg).sum())
        392
        """
        return self._sheet.shifts(draws)
