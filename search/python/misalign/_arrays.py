"""JSON of the program with arrays in the place of lists of numbers."""

from __future__ import annotations

from typing import Any

import numpy as np


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
