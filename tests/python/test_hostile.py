"""What is wrong is a sentence, never a crash and never an answer."""

import functools
import inspect
import os
import pickle
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np

from fixture import CATALOGUE, PACKAGE, SMALL, TABLE1

import misalign


class Sentences(unittest.TestCase):
    def refused(self, exit_code, words, call, *arguments, **named):
        with self.assertRaisesRegex(misalign.Error, words) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.exit_code, exit_code, str(caught.exception))
        self.assertRegex(str(caught.exception), "; |: ")

    def test_files(self):
        self.refused(3, "none.json", misalign.read, "none.json")
        self.refused(2, "is a catalogue", misalign.read, CATALOGUE)
        self.refused(3, "none.db", misalign.Catalogue, "none.db")
        self.refused(3, "", misalign.Catalogue, TABLE1)
        with open("bad.json", "w", encoding="utf-8") as file:
            file.write('{"family": "miura", "rows": 2.5, "columns": "x"}')
        self.refused(3, "rows = 2.5", misalign.read, "bad.json")
        self.refused(3, "", misalign.read, os.curdir)
        with self.assertRaises(TypeError):
            misalign.read(3)

    def test_what_is_no_file(self):
        """A name ends at no zero, and what is there is named."""
        for bad in (CATALOGUE + "\0x", "\0", CATALOGUE + "\0"):
            self.refused(3, "its name contains a zero byte", misalign.Catalogue, bad)
            self.refused(3, "cannot be opened", misalign.read, bad)
        os.mkfifo("pipe.db")
        self.refused(3, "pipe.db: is a pipe", misalign.Catalogue, "pipe.db")
        self.refused(3, "is a directory", misalign.Catalogue, os.curdir)
        os.symlink("circle.db", "circle.db")
        self.refused(3, "links go round in a circle", misalign.Catalogue, "circle.db")

    def test_masks(self):
        """What is masked is no number, whatever lies under the mask."""
        campaign = misalign.read(SMALL)
        catalogue = misalign.Catalogue(CATALOGUE)
        shifts_mm = campaign.shifts(range(3))
        masked = np.ma.masked_array(shifts_mm, mask=np.zeros(shifts_mm.shape, dtype=bool))
        np.testing.assert_array_equal(misalign.judge(campaign, masked, 100), misalign.judge(campaign, shifts_mm, 100))
        masked[1, 6, 0] = np.ma.masked
        for bad in (masked, list(masked), [list(sheet) for sheet in masked], (masked[1],)):
            for threshold in (None, 100):
                self.refused(2, "^shifts_mm: has masked entries", misalign.judge, campaign, bad, threshold)
        self.refused(2, "^shifts_mm: has masked", campaign.pattern.fold, shifts_mm=masked[1])
        draws = np.ma.masked_array([0, 1], mask=[False, True])
        for call in (catalogue.shifts, catalogue.histories, campaign.shifts):
            self.refused(2, "^draws: has masked", call, draws)
            self.refused(2, "^draws: has masked", call, [0, np.ma.masked])
        for call in (catalogue.replay, catalogue.springs):
            self.refused(2, "^draws: has masked", call, draws[1])
        self.refused(2, "^stations: has masked", campaign.pattern.fold, np.ma.masked_less([10., 20.], 15))
        self.assertEqual(len(campaign.shifts(np.ma.masked_array([0, 1]))), 2)

    def test_shifts(self):
        campaign = misalign.read(SMALL)
        good = np.zeros((5, 25, 2))
        for bad, words in ((np.nan, "sheet 3 vertex A7 is shifted by .nan"), (np.inf, "not both finite"),
                           (90.0, r"sheet 3 the shifts make the facet \[\d,\d\] nonconvex"),
                           (1e300, "nonconvex"), (-np.inf, "not both finite")):
            for vertex in (6, 0):  # an inner one, and one of the perimeter
                shifts_mm = good.copy()
                shifts_mm[3, vertex, 0] = bad
                for threshold in (None, 100):
                    self.refused(2, words.replace("A7", f"A{vertex + 1}"), misalign.judge, campaign, shifts_mm,
                                 threshold)
                self.refused(2, "shifts_mm", campaign.pattern.fold, shifts_mm=shifts_mm[3])
        for shape in ((25, 2), (5, 25), (5, 24, 2), (5, 25, 3), (5, 2, 25), ()):
            self.refused(2, r"has the shape .* 25 vertices", misalign.judge, campaign, np.zeros(shape))
            self.refused(2, "shape", campaign.pattern.fold, shifts_mm=np.zeros((1, *shape)))
        for kind in (complex, str, object, bool):
            self.refused(2, "no numbers", misalign.judge, campaign, np.zeros((5, 25, 2)).astype(kind))
        for nested in ([[1, 2], [3]], "abc", None, {}):
            with self.assertRaises((misalign.Error, ValueError)):
                misalign.judge(campaign, nested)

    def test_thresholds(self):
        campaign = misalign.read(SMALL)
        shifts_mm = campaign.shifts(range(3))
        for bad, words in ((0, "whole multiple"), (-10, "multiple"), (99.5, "try 100"), (181, "within the path"),
                           (np.nan, "multiple"), (np.inf, "threshold_deg=inf"), (1e300, "within the path")):
            self.refused(2, words, misalign.judge, campaign, shifts_mm, bad)
        with self.assertRaises(TypeError):
            misalign.judge(campaign, shifts_mm, "150")

    def test_stations(self):
        pattern = misalign.read(TABLE1)
        for bad in ([], [10, 5], [10, 10], [-1], [1e-6], [181], [np.nan], [[1, 2]], ["a"]):
            self.refused(2, "stations", pattern.fold, bad)

    def test_numbers_of_every_call(self):
        """What the program refuses, every function refuses, by the parameter's name."""
        pattern, catalogue, campaign = misalign.read(TABLE1), misalign.Catalogue(CATALOGUE), misalign.read(SMALL)
        needed = {"draw": 1, "draws": [1], "amplitude_mm": 0.05, "shifts_mm": pattern.shifts_mm, "stations": [30], "name": "x"}
        numbers = (np.nan, np.inf, -np.inf, -1, 1e308, -1e308, "much", [1, 2, 3], {}, 10**400)
        ranges = ([1], [1, 2, 3], [np.nan, 2], [1, np.inf], [-1, 5], [5, 1], [1, 1e308], ["a", "b"], 3)
        lists = ([np.nan, 2], [1, np.inf], [-1, 5], [1, 1e308], ["a", "b"], 3)
        methods = [getattr(owner, name) for owner in (pattern, catalogue, campaign) for name in dir(owner)
                   if not name.startswith("_") and inspect.ismethod(getattr(owner, name))]
        tried = 0
        functions = [functools.partial(misalign.judge, campaign, campaign.shifts([0])), functools.partial(misalign.view, pattern)]
        for call in [*methods, *functions]:
            signature = inspect.signature(call).parameters
            base = {name: needed[name] for name, one in signature.items() if one.default is one.empty and name in needed}
            for name, one in signature.items():
                kind = str(one.annotation)
                is_range = kind.startswith("Sequence[float]")
                if not is_range and kind.split(" ")[0] not in ("float", "int"):
                    continue
                for bad in lists if name == "rates_n_per_mm" else ranges if is_range else numbers:
                    with self.subTest(call=str(call), name=name, bad=str(bad)[:20]):
                        with self.assertRaises((misalign.Error, TypeError, ValueError, OverflowError)) as caught:
                            call(**{**base, name: bad})
                        if isinstance(caught.exception, misalign.Error):
                            self.assertEqual(caught.exception.exit_code, 2)
                            self.assertIn(name.removesuffix("_n_per_mm"), str(caught.exception))
                        tried += 1
        self.assertGreater(tried, 250)

    def test_what_no_memory_holds(self):
        """NumPy refuses to copy it: its error, not null."""
        endless = np.broadcast_to(np.float32(90), (2**45,))
        with self.assertRaises(MemoryError):
            misalign.read(TABLE1).fold(endless)
        with self.assertRaises(MemoryError):
            misalign.read(SMALL).shifts(np.broadcast_to(np.int8(1), (2**45,)))

    def test_private_classes_made_from_nothing(self):
        from misalign import _misalign
        catalogue, sheet = (kind.__new__(kind) for kind in (_misalign.Catalogue, _misalign.Sheet))
        zeros = np.zeros((1, 25, 2))
        for call in (catalogue.sheet, lambda: catalogue.query("best"), lambda: catalogue.candidates("", None, None, []),
                     lambda: catalogue.shifts([0]), lambda: catalogue.histories([0]), lambda: catalogue.replay(0, None),
                     lambda: catalogue.pattern(0), lambda: catalogue.springs(0),
                     lambda: catalogue.tolerance(0, 0.1, 1, 1, None), sheet.describe, lambda: sheet.shifts([0]),
                     lambda: _misalign.fold(sheet, None, None), lambda: _misalign.verdicts(sheet, zeros),
                     lambda: _misalign.verdicts(None, zeros), lambda: _misalign.accepted(None, zeros, 100),
                     lambda: _misalign.card(None, "{}", 1, 1), lambda: _misalign.Sheet(), lambda: _misalign.Catalogue(None)):
            with self.assertRaises((TypeError, RuntimeError, misalign.Error)):
                call()

    def test_draws(self):
        catalogue = misalign.Catalogue(CATALOGUE)
        for bad in ([-1], [1.5], [[1]], ["a"], [2**63], [2**64], None):
            for call in (catalogue.histories, catalogue.shifts, catalogue.campaign.shifts):
                self.refused(2, "draws", call, bad)
        self.assertEqual(catalogue.campaign.shifts([]).shape, (0, 25, 2))
        self.assertEqual(catalogue.campaign.shifts(2**63 - 1).shape, (1, 25, 2))
        self.assertEqual(catalogue.histories([])[1].shape, (0, 180, 4))
        for bad in (-1, 1.5, "a", 2**63, 2**64, [1, 2], None):
            for one in (catalogue.replay, catalogue.springs, lambda draw: catalogue.tolerance(draw, 0.1)):
                self.refused(2, "draw", one, bad)

    def test_choices(self):
        catalogue = misalign.Catalogue(CATALOGUE)
        self.refused(2, "^where=x >: is no condition", catalogue.candidates, "x >")
        self.refused(2, "no condition", catalogue.candidates, "1) UNION SELECT (1")
        self.refused(2, "^by=nothing: is no column", catalogue.candidates, by="nothing")
        self.refused(2, "no column", catalogue.candidates, by="draw; DROP TABLE candidate")
        self.refused(2, "did you mean best", catalogue.query, "bets")
        self.refused(2, "refused", catalogue.query, "SELECT 1; SELECT 2")
        self.refused(2, "amplitude_mm=50: must be below", catalogue.tolerance, 1, 50)
        for bad in ((1, -0.1), (1, np.nan), (1, 0.1, 0), (1, 0.1, 10, 0)):
            self.refused(2, "", catalogue.tolerance, *bad)

    def test_a_campaign_that_splits(self):
        campaign = misalign.read("search/campaigns/miura-8x8-rare.json")
        self.assertTrue(campaign.is_splitting)
        self.refused(2, "splitting campaign", campaign.shifts, [1])

    def test_without_pandas(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            self.refused(1, "pandas is missing", misalign.Catalogue(CATALOGUE).candidates)

    def test_without_numpy(self):
        code = "import sys; sys.modules['numpy'] = None; import misalign"
        done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(PACKAGE)},
                              capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr.splitlines()[-1], "^ImportError: misalign: NumPy is missing, .*; install it")

    def test_errors_travel(self):
        error = misalign.Error("a sentence; do this", 3)
        copy = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(copy), copy.exit_code), (str(error), 3))
        undecided = misalign.UndecidedError(np.array([2]), np.array([True, False, False]))
        self.assertEqual(pickle.loads(pickle.dumps(undecided)).undecided.tolist(), [2])


if __name__ == "__main__":
    unittest.main()
