"""Reads what files hold."""

from __future__ import annotations

import os

from misalign import _misalign
from misalign._campaign import Campaign
from misalign._pattern import Pattern


def read(path: str | os.PathLike[str]) -> Pattern | Campaign:
    """What a file holds: a `Campaign`, or a `Pattern` (a pattern file, a FOLD file, or an exported candidate).

    `misalign.Error` (3) with every fault of the file, (2) for a catalogue, which `misalign.Catalogue` opens.

    >>> misalign.read("search/patterns/table1.json")
    <misalign.Pattern table1: 49 vertices, 8 holes>
    >>> misalign.read("search/campaigns/miura-4x4.json").name
    'miura-4x4'
    """
    sheet = _misalign.read(os.fspath(path))
    return Campaign(sheet) if sheet.describe()["campaign"] else Pattern(sheet)
