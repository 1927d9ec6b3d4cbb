"""Reads files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from misalign import _misalign
from misalign._arrays import text
from misalign._campaign import Campaign
from misalign._pattern import Pattern


def read(path: str | os.PathLike[str] | Mapping[str, Any]) -> Pattern | Campaign:
    """Reads a file, or a dict with the same contents: a `Campaign`, or a `Pattern` (pattern file, FOLD file, exported candidate).

    `misalign.Error` (3) with every fault of the file, (2) for a catalogue, which `misalign.Catalogue` opens.

    >>> misalign.read("search/patterns/table1.json")
    <misalign.Pattern table1: 49 vertices, 8 holes>
    >>> misalign.read("search/campaigns/miura-4x4.json").name
    'miura-4x4'
    >>> misalign.read({"family": "miura", "rows": 4, "columns": 4, "displacements_mm": {"A7": [0.4, 0]}})
    <misalign.Pattern sheet: 25 vertices, 2 holes>
    """
    if isinstance(path, Mapping):
        sheet = _misalign.read_document(text(path), "sheet")
        return Campaign(sheet) if sheet.describe()["campaign"] else Pattern(sheet)
    sheet = _misalign.read(os.fspath(path))
    return Campaign(sheet) if sheet.describe()["campaign"] else Pattern(sheet)
