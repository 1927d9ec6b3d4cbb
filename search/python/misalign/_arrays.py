"""JSON of the program with arrays in the place of lists of numbers, and the other way round."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from misalign._error import Error


def _plain(value: Any) -> Any:
    """What NumPy has for JSON's numbers, truth values and lists."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise Error(f"{value!r}: is a {type(value).__name__}, which a file cannot hold; give numbers, texts, lists and dicts", 2)


def text(said: Any) -> str:
    """As JSON, with NumPy's numbers and arrays in it."""
    try:
        return json.dumps(said, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:  # a key that is none, a circle, or no finite number
        raise Error(f"cannot be written as JSON: {error}; give finite numbers, and texts as keys", 2) from error


def arrays(said: Any) -> Any:
    """JSON with its lists of numbers as arrays, where null is NaN."""
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
