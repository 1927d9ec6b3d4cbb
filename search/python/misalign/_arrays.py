"""Converts the program's JSON to arrays instead of lists of numbers, and back."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from misalign._error import Error


def _plain(value: Any) -> Any:
    """Converts NumPy's numbers, truth values and arrays for JSON."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise Error(f"{value!r}: is of the type {type(value).__name__}, which a file cannot hold; give numbers, texts, lists and dicts", 2)


def text(said: Any) -> str:
    """Writes JSON, also of NumPy's numbers and arrays."""
    try:
        return json.dumps(said, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:  # a key that is no text, a cycle, or a number that is not finite
        raise Error(f"cannot be written as JSON: {error}; give finite numbers, and texts as keys", 2) from error


def arrays(said: Any) -> Any:
    """Converts lists of numbers in JSON to arrays, with NaN for null."""
    if isinstance(said, dict):
        return {name: arrays(value) for name, value in said.items()}
    if not isinstance(said, list):
        return said
    values = [arrays(value) for value in said]
    if values and all(isinstance(value, int) and not isinstance(value, bool) for value in values):
        return np.array(values, dtype=np.int64)
    if values and all(value is None or isinstance(value, (int, float)) for value in values):
        return np.array(values, dtype=np.float64)
    return values
