"""Errors as sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from misalign import _misalign

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class Error(Exception):
    """The program's sentence on an error: the problem, its cause and a remedy.

    `exit_code` is that of `misalign`: 1 disk or memory, 2 wrong arguments, 3 a bad input file,
    5 a catalogue of a newer schema or one that was replaced, 6 a failed check.

    >>> try:
    ...     misalign.read("search/patterns/README.md")
    ... except misalign.Error as error:
    ...     print(error.exit_code)
    3
    """

    def __init__(self, sentence: str, exit_code: int = 1) -> None:
        super().__init__(sentence)
        self.exit_code = exit_code

    def __reduce__(self) -> tuple[type[Error], tuple[str, int]]:
        return type(self), (str(self), self.exit_code)


class UndecidedError(Error):
    """Some sheets could not be judged, for numerical reasons: they are neither accepted nor rejected.

    `undecided` has their numbers [K], `accepted` [N] the decisions on the others (False for these).
    Very rare; `judge` without a threshold gives them the fault "undecided".
    """

    def __init__(self, undecided: npt.NDArray[np.intp], accepted: npt.NDArray[np.bool_]) -> None:
        several = f"{undecided.size} sheets are" if undecided.size > 1 else "a sheet is"
        super().__init__(
            f"{several} undecided, sheet {undecided[0]} first (its path was lost for numerical reasons); "
            "see .undecided and .accepted of this error, or judge without a threshold", 6)
        self.undecided = undecided
        self.accepted = accepted

    def __reduce__(self) -> tuple[type[Error], tuple]:  # type: ignore[override, type-arg]
        return type(self), (self.undecided, self.accepted)


_misalign._use_error(Error)
