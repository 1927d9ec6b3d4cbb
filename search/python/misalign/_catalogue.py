"""Catalogues, which hold the results of campaigns."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from misalign import _figures, _misalign
from misalign._arrays import arrays
from misalign._campaign import Campaign
from misalign._error import Error
from misalign._folding import Folding
from misalign._pattern import Pattern

if TYPE_CHECKING:
    import pandas  # type: ignore[import]


def _frame(columns: dict[str, Any]) -> pandas.DataFrame:
    try:
        import pandas
    except ImportError as error:
        raise Error("pandas is missing, which tables need (a separate package); install it, such as Debian's "
                    "python3-pandas") from error
    return pandas.DataFrame(columns)


def _reopened(kind: type[Catalogue], path: str, identity: str) -> Catalogue:
    catalogue = kind(path)
    if catalogue.campaign.identity != identity:
        raise Error(f"{path}: holds another campaign than at the time of the pickle (it was replaced); open it again with "
                    "misalign.Catalogue", 5)
    return catalogue


class Catalogue:
    """A campaign's catalogue, read only; a search may write it meanwhile.

    `path`      path of the file
    `campaign`  its `Campaign`

    Every call opens the file again and reads it at one moment, so that threads and forks may share a catalogue. `close`,
    or the end of a `with`, refuses further calls. `misalign.Error`: 3 if the file is missing, of another program, or
    damaged; 5 if its schema is newer, or it is another file than the opened one; 2 for impossible requests.

    >>> with misalign.Catalogue("miura-4x4.db") as catalogue:
    ...     best = catalogue.candidates(limit=3)
    ...     steps, length_mm = catalogue.histories(best.draw)
    >>> length_mm.shape  # draws, stations, diagonals
    (3, 180, 4)
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self._catalogue: _misalign.Catalogue | None = _misalign.Catalogue(self.path)
        self.campaign = Campaign(self._catalogue.sheet())

    def __enter__(self) -> Catalogue:
        self._opened()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<misalign.Catalogue {self.path}: {self.campaign.name}>"

    def __reduce__(self) -> tuple[Any, tuple[type[Catalogue], str, str]]:
        return _reopened, (type(self), self.path, self.campaign.identity)

    def close(self) -> None:
        """Refuses further calls; `campaign` can still be used. Closing twice does nothing."""
        self._catalogue = None

    def _opened(self) -> _misalign.Catalogue:
        if self._catalogue is None:
            raise Error(f"{self.path}: is closed; open it again with misalign.Catalogue", 2)
        return self._catalogue

    def candidates(self, where: str | None = None, by: str | None = None, limit: int | None = None,
                   columns: Iterable[str] = ()) -> pandas.DataFrame:
        """Returns the view `candidates`, with a row for each accepted draw, the best first.

        `where`    SQL condition on its columns, and on functions of sheets, such as "thickness_mm > 0.5"
        `by`       column or function to sort by, the largest first; otherwise the order of the query `best`
        `limit`    largest number of rows
        `columns`  further columns, from functions of sheets: "thickness_mm", or "thickness_mm(draw, 140)"

        Functions are computed on all cores, with the campaign's design (`misalign query --help` lists them).

        Columns are those of `schema/catalogue.sql`; NULL becomes NaN.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> table = catalogue.candidates(where="stroke_max < 0.05", by="miscut_margin_mm", limit=10)
        >>> bool(table.miscut_margin_mm.is_monotonic_decreasing)
        True
        >>> stiff = catalogue.candidates("D > 160 AND shifted_vertices < 5", limit=3, columns=["energy_n_mm(draw, 140)"])
        >>> bool((stiff["energy_n_mm(draw, 140)"] > 0).all())
        True
        """
        return _frame(self._opened().candidates(where or "", by, limit, list(columns)))

    def plot(self, x: str = "stroke_max", y: str = "miscut_margin_mm", colour: str = "deploys_from_deg",
             where: str | None = None, limit: int | None = None, axes: Any = None) -> Any:
        """Draws candidates as points; returns matplotlib's axes.

        `x`, `y`, `colour`  columns of `candidates`, or functions of sheets such as "thickness_mm(draw, 140)"
        `where`, `limit`    those of `candidates`
        `axes`              where to draw; None for a new figure in the style `misalign.style`

        Numbers are those of the table, in its units. `misalign.Error`: 1 without matplotlib or pandas, others as from
        `candidates`.

        >>> axes = misalign.Catalogue("miura-4x4.db").plot(y="D", where="stroke_max < 0.05", limit=100)
        >>> axes.get_xlabel(), len(axes.collections[0].get_offsets())
        ('stroke max', 100)
        """
        return _figures.candidates(self, x, y, colour, where, limit, axes)

    def query(self, name_or_sql: str = "best") -> pandas.DataFrame:
        """Returns the rows of a named query (`schema/queries/README.md`), or of any SELECT.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> rows = catalogue.query("SELECT count(*) AS candidates FROM candidate")
        >>> len(catalogue.candidates()) == rows.candidates[0]
        True
        """
        return _frame(self._opened().query(name_or_sql))

    def shifts(self, draws: npt.ArrayLike | range) -> npt.NDArray[np.float64]:
        """Returns the shifts of these draws, [N, V, 2] in mm; in a splitting campaign of its candidates alone.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> draws = catalogue.candidates().draw
        >>> bool(misalign.judge(catalogue.campaign, catalogue.shifts(draws), 150).all())
        True
        """
        return self._opened().shifts(draws)

    def histories(self, draws: npt.ArrayLike | range) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Returns lengths of the diagonals along the paths of these draws, accepted or not.

        Two arrays: the stations [S] in degrees, which are the samples, and the lengths [N, S, G] in mm, NaN beyond
        the end of a path. A draw takes some 10 kB; a thousand draws take a second.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> stations_deg, length_mm = catalogue.histories([0, 1, 2])
        >>> solved = catalogue.replay(1).length_mm
        >>> bool((length_mm[1, :len(solved)] == solved).all())
        True
        """
        return self._opened().histories(draws)

    def replay(self, draw: int, stations: npt.ArrayLike | None = None) -> Folding:
        """Folds any draw again from its number, like `misalign replay`, with the stations of `Pattern.fold`.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> best = int(catalogue.candidates(limit=1).draw[0])
        >>> catalogue.replay(best).accepted
        True
        """
        return Folding(self._opened().replay(draw, stations))

    def pattern(self, draw: int) -> Pattern:
        """Returns the sheet of a draw, with the campaign's sampling and design, as `misalign export` writes it.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> sheet = catalogue.pattern(int(catalogue.candidates(limit=1).draw[0]))
        >>> sheet.fold().deploys_from_deg >= catalogue.campaign.threshold_deg
        True
        """
        return Pattern(self._opened().pattern(draw))

    def springs(self, draw: int) -> dict[str, Any]:
        """Studies springs on the diagonals of a draw: the JSON of `misalign actuators`, with arrays for lists of numbers.

        `["history"]` has a row for the flat sheet and for each sample: `pilot_deg`, `energy_n_mm`, `moment_n_mm`
        about the pilot crease, `mechanical_advantage`, and each diagonal's `force_n`.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> springs = catalogue.springs(int(catalogue.candidates(limit=1).draw[0]))
        >>> springs["history"]["energy_n_mm"].shape
        (181,)
        """
        said: dict[str, Any] = arrays(json.loads(self._opened().springs(draw)))
        return said

    def tolerance(self, draw: int, amplitude_mm: float, trials: int = 1000, jobs: int = 1,
                  from_deg: float | None = None) -> dict[str, Any]:
        """Returns the yield of miscut copies of a draw, as `misalign tolerance --json`.

        `amplitude_mm`  largest cutting error of a vertex in x and in y
        `trials`        number of copies
        `jobs`          number of threads; the result does not depend on it
        `from_deg`      D that copies must reach; None for the design's, or the campaign's threshold

        Unlike the program, it stores nothing in the catalogue.

        >>> catalogue = misalign.Catalogue("miura-4x4.db")
        >>> best = int(catalogue.candidates(limit=1).draw[0])
        >>> catalogue.tolerance(best, amplitude_mm=0.01, trials=100)["trials"]
        100
        """
        said: dict[str, Any] = arrays(json.loads(
            self._opened().tolerance(draw, amplitude_mm, trials, jobs, from_deg)))
        return said
