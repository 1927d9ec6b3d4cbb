"""Finds origami that simple springs deploy, with the solver and catalogues of the program `misalign`.

Results are bit for bit those of the program, from the same code. `misalign search` runs campaigns;
this package reads their catalogues, and judges and folds any sheet.

>>> import numpy as np
>>> import misalign
>>> pattern = misalign.read("search/patterns/table1.json")
>>> folding = pattern.fold()
>>> folding.deploys_from_deg
156.0
>>> folding.length_mm.shape  # stations, diagonals
(156, 16)
>>> misalign.judge(pattern, np.stack([pattern.shifts_mm, -pattern.shifts_mm]), threshold_deg=150).tolist()
[True, False]

Angles are in degrees and lengths in mm, as the ends of names say. In shapes N counts
sheets, S stations (pilot angles), V vertices, F facets, C creases, G diagonals. D is an angle, as everywhere: `deploys_from_deg`.

Figures are matplotlib's: `plot` of a pattern, a folding and a catalogue, `animate` of a pattern. `style` is the path of their
style: `matplotlib.pyplot.style.use(misalign.style)`.
"""

try:
    import numpy as _numpy  # noqa: F401
except ImportError as _error:
    raise ImportError("misalign: NumPy is missing, which it needs for arrays (a separate package); install it for this "
                      "Python, such as Debian's python3-numpy") from _error

from misalign._campaign import Campaign
from misalign._catalogue import Catalogue
from misalign._error import Error, UndecidedError
from misalign._figures import style
from misalign._folding import Folding
from misalign._judge import Verdicts, faults, judge
from misalign._misalign import __version__
from misalign._pattern import Pattern
from misalign._read import read
from misalign._view import View, view

__all__ = ["Campaign", "Catalogue", "Error", "Folding", "Pattern", "UndecidedError", "Verdicts", "View",
           "__version__", "faults", "judge", "read", "style", "view"]
