"""Numbers of a call, refused by the parameter's name."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from misalign._error import Error


def _refuse(name: str, value: Any, why: str) -> Error:
    try:
        shown = str(value)
    except ValueError:  # Python writes no integer of more than some thousand digits
        shown = ""
    return Error(f"{name}={shown}: {why}" if 0 < len(shown) <= 100 else f"{name}: {why}", 2)


def number(name: str, value: Any, least: float = -math.inf, most: float = math.inf) -> float:
    """Returns the value of a parameter, if it is a finite number within these bounds."""
    is_number = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    try:
        found = float(value) if is_number else math.nan
    except OverflowError:
        found = math.inf
    if not math.isfinite(found):
        raise _refuse(name, value, "is no finite number; give one")
    if found < least:
        raise _refuse(name, value, f"is too small; give at least {least:.9g}")
    if found > most:
        raise _refuse(name, value, f"is too large; give at most {most:.9g}")
    return found


def whole(name: str, value: Any, least: int, most: int) -> int:
    """Returns the value of a parameter, if it is a whole number within these bounds, and of an integer type."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise _refuse(name, value, "is no whole number; give one")
    number(name, value, least, most)
    return int(value)


def pilot_angle(name: str, value: Any) -> float:
    """Returns the value of a parameter, if it is a pilot angle at which sheets are folded, in degrees."""
    found = number(name, value, 0, 180)
    if 0 < found < 0.01:
        raise _refuse(name, value, "is too close to flat; give 0, or at least 0.01")
    return found
