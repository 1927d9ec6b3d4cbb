"""Campaigns, which draw shifts of a pattern."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from misalign import _misalign
from misalign._pattern import Pattern


class Campaign:
    """The contents of a campaign file: which sheets are drawn, and which are accepted. Made by `misalign.read`.

    `name`, `identity`, `seed`
    `pattern`        the sheet without shifts, with the campaign's sampling
    `threshold_deg`  the D that a draw must reach to be accepted
    `amplitude_mm`   amplitude a of the shifts; `levels`: "ternary" (-a, 0, a) or "uniform" (on [-a, a])
    `vertices`       numbers of the shifted vertices
    `is_splitting`   True for a splitting search
    `configuration`  every key of the file, with defaults

    A pickle or a copy is complete, and needs no file.

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
        """Returns the shifts of these draws, [N, V, 2] in mm: seed and number alone determine them.

        `misalign.Error` (2) for a number that no draw has, and for a splitting campaign, whose numbers are no draws (use
        `Catalogue.shifts`).

        >>> campaign = misalign.read("search/campaigns/miura-4x4.json")
        >>> shifts_mm = campaign.shifts(range(1000))
        >>> int(misalign.judge(campaign, shifts_mm, campaign.threshold_deg).sum())
        392
        """
        return self._sheet.shifts(draws)
