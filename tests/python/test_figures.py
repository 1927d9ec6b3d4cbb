"""Figures show the numbers of the interface, and pages are those of the program."""

import html
import json
import os
import re
import subprocess
import sys
import unittest
import warnings
from unittest import mock

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

from fixture import CATALOGUE, PACKAGE, PROGRAM, TABLE1, program, program_json

import misalign

MATPLOTLIB = {name: None for name in ("matplotlib", "matplotlib.pyplot", "matplotlib.animation", "mpl_toolkits.mplot3d.art3d")}
PAGE_DATA = re.compile(r'<script type="application/json" id="report-data">(.*?)</script>', re.S)


def ends(line):
    return [tuple(point) for point in np.transpose(line.get_data())]


class Figures(unittest.TestCase):
    def setUp(self):
        self.pattern = misalign.read(TABLE1)

    def tearDown(self):
        plt.close("all")

    def test_a_folding(self):
        """Against the program's JSON: a line for each diagonal, in its order of sign."""
        said = program_json("fold", TABLE1)
        lines = {line.get_gid(): line for line in self.pattern.fold().plot().lines}
        colours = set()
        for number, diagonal in enumerate(said["diagonals"]):
            line = lines.pop(f"diagonal-{number}")
            self.assertEqual(line.get_xdata().tolist(), said["samples_deg"])
            wanted = [100 * (length / diagonal["flat_mm"] - 1) for length in diagonal["length_mm"]]
            np.testing.assert_allclose(line.get_ydata(), wanted, atol=1e-11)
            colours.add((wanted[-1] > 0, line.get_color()))
        self.assertEqual(len(colours), 2)
        [mark] = lines.values()
        self.assertEqual(set(mark.get_xdata()), {said["verdict"]["deploys_from_deg"]})

    def test_a_folding_beyond_its_end(self):
        folding = self.pattern.fold([0, 90, 170])
        axes = folding.plot()
        self.assertEqual(np.isnan(axes.lines[0].get_ydata()).tolist(), [False, False, True])
        self.assertNotEqual(axes.lines[0].get_color(), axes.lines[15].get_color())  # by the last known row
        self.assertEqual(len(self.pattern.fold([170]).plot().lines), 17)

    def test_a_crease_pattern(self):
        said = self.pattern
        axes = said.plot(magnified=30)
        flat_mm = said.vertices_mm + said.shifts_mm
        for number, (patch, facet) in enumerate(zip(axes.patches, said.facets)):
            np.testing.assert_array_equal(patch.get_xy()[:4], flat_mm[facet])
            self.assertEqual(patch.get_facecolor()[:3] == (1, 1, 1), number not in said.holes)
        drawn = {}
        for line in axes.lines:
            drawn.setdefault(frozenset(ends(line)), []).append(line)
        folded = said.fold()
        for crease, valley in zip(said.creases, said.valley):
            dashes = {str(line._dash_pattern[1]) for line in drawn[frozenset(map(tuple, flat_mm[crease]))] if line.get_linewidth() < 1}
            self.assertEqual([dashes.count(",") for dashes in dashes], [1 if valley else 3])
        for diagonal, lengthens in zip(said.diagonals, folded.length_mm[-1] > folded.flat_mm):
            [line] = drawn[frozenset(map(tuple, flat_mm[diagonal]))]
            self.assertEqual(line.get_color(), "#0072B2" if lengthens else "#D55E00")
        self.assertEqual(len(axes.lines), len(said.creases) + len(said.diagonals) + 1)  # and the pilot
        arrows = axes.collections[0]
        shifted = np.flatnonzero(np.abs(said.shifts_mm).max(axis=1) > 0)
        np.testing.assert_allclose(np.column_stack([arrows.U, arrows.V]), 30 * said.shifts_mm[shifted])
        np.testing.assert_array_equal(arrows.get_offsets(), flat_mm[shifted])
        self.assertEqual(len(self.pattern.plot(magnified=0).collections), 0)

    def corners(self, collection):
        """Corners of panels [P, 4, 3] that a collection draws."""
        return collection._vec[:3].T.reshape(-1, 4, 3)

    def test_a_folded_sheet(self):
        axes = self.pattern.plot(pilot_deg=75.5)
        shape_mm = self.pattern.fold([75.5]).vertices_mm[0]
        np.testing.assert_array_equal(self.corners(axes.collections[0]), shape_mm[self.pattern.panels])
        for name, k in (("x", 0), ("y", 1), ("z", 2)):
            least, most = getattr(axes, f"get_{name}lim")()
            self.assertTrue(least <= shape_mm[:, k].min() + 1e-9 and shape_mm[:, k].max() <= most + 1e-9)
        red = self.pattern.plot(pilot_deg=75.5, colours=["red"] * len(self.pattern.panels)).collections[0]
        self.assertEqual({tuple(colour) for colour in red.get_facecolor()}, {(1, 0, 0, 1)})

    def test_an_animation(self):
        animation = self.pattern.animate(from_deg=120, to_deg=30, frames=4)
        [axes] = animation._fig.axes
        shapes_mm = self.pattern.fold([30, 60, 90, 120]).vertices_mm
        for frame, (angle_deg, shape_mm) in enumerate(zip((120, 90, 60, 30), shapes_mm[::-1])):
            animation._func(frame)
            np.testing.assert_array_equal(self.corners(axes.collections[0]), shape_mm[self.pattern.panels])
            self.assertEqual(axes.get_title(), f"pilot angle {angle_deg}°")
        animation.save("sheet.gif", writer="pillow", dpi=40)
        with Image.open("sheet.gif") as image:
            self.assertEqual(image.n_frames, 4)

    def test_an_animation_begins_at_D(self):
        animation = self.pattern.animate(frames=2)
        animation._func(0)
        self.assertEqual(animation._fig.axes[0].get_title(), "pilot angle 156°")
        animation.save("two.gif", writer="pillow", dpi=40)

    def test_a_catalogue(self):
        catalogue = misalign.Catalogue(CATALOGUE)
        axes = catalogue.plot("stroke_max", "energy_n_mm(draw, 140)", "fold_limit_deg", where="D > 160", limit=20)
        rows = program_json("query", CATALOGUE, "SELECT stroke_max, energy_n_mm(draw, 140) AS energy, fold_limit_deg FROM "
                            "candidates WHERE D > 160 ORDER BY deploys_from_deg DESC, miscut_margin_mm DESC")
        points = {(row["stroke_max"], row["energy"], row["fold_limit_deg"]) for row in rows}
        drawn = axes.collections[0]
        found = {(x, y, colour) for (x, y), colour in zip(drawn.get_offsets().tolist(), drawn.get_array().tolist())}
        self.assertEqual(len(found), 20)
        self.assertLessEqual(found, points)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("stroke max", "energy_n_mm(draw, 140)"))
        with self.assertRaises(misalign.Error):
            catalogue.plot(x="no_column")

    def test_axes_of_the_caller(self):
        figure, axes = plt.subplots()
        self.assertIs(self.pattern.fold().plot(axes), axes)
        self.assertIs(self.pattern.plot(axes=axes), axes)
        self.assertIs(misalign.Catalogue(CATALOGUE).plot(axes=axes, limit=5), axes)
        with self.assertRaisesRegex(misalign.Error, '^axes: .* projection="3d"$'):
            self.pattern.plot(pilot_deg=90, axes=axes)

    def test_the_style(self):
        """It has no unknown keys, ends with the figure, and its colours differ in lightness too."""
        before = dict(matplotlib.rcParams)
        self.assertEqual(self.pattern.fold().plot().figure.get_size_inches().tolist(), [6.3, 3.9])
        self.assertEqual(dict(matplotlib.rcParams), before)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with plt.style.context(misalign.style):
                colours = plt.rcParams["axes.prop_cycle"].by_key()["color"]
        self.assertEqual(len(set(colours)), 7)

    def test_numbers_that_cannot_be(self):
        for call, words in (
                (lambda: self.pattern.plot(pilot_deg=170), "pilot_deg=170: lies beyond the path's end; give at most 156.34$"),
                (lambda: self.pattern.animate(from_deg=170), "from_deg=170: lies beyond"),
                (lambda: self.pattern.animate(from_deg=20, to_deg=30), "from_deg=20: is not above to_deg=30"),
                (lambda: self.pattern.animate(frames=1), "frames=1: is too small; give at least 2$"),
                (lambda: self.pattern.animate(frames=18000), "frames=18000: makes steps of less than 0.01 degrees"),
                (lambda: self.pattern.animate(frames=10**9), "frames=1000000000: is too large; give at most 18001$"),
                (lambda: self.pattern.animate(frames=True), "frames=True: is no whole number"),
                (lambda: self.pattern.animate(interval_ms=0), "interval_ms=0: is too small; give at least 1$"),
                (lambda: self.pattern.animate(to_deg=0.001), "to_deg=0.001: is too close to flat; give 0, or at least 0.01$"),
                (lambda: self.pattern.plot(pilot_deg=1e-6), "pilot_deg=1e-06: is too close to flat"),
                (lambda: self.pattern.plot(pilot_deg=True), "pilot_deg=True: is no finite number"),
                (lambda: self.pattern.plot(magnified=1e9), "magnified=1000000000.0: is too large; give at most 1000000$"),
                (lambda: self.pattern.plot(90, magnified=-1), "magnified=-1: is too small; give at least 0$"),
                (lambda: self.pattern.plot(axes=3), "axes: are of the type int, not axes; make some with"),
                (lambda: self.pattern.actuators(from_deg=10**400), "from_deg: is no finite number; give one$")):
            with self.assertRaisesRegex(misalign.Error, f"^{words}") as caught:
                call()
            self.assertEqual(caught.exception.exit_code, 2)

    def test_without_matplotlib(self):
        calls = (self.pattern.plot, lambda: self.pattern.plot(90), self.pattern.animate, self.pattern.fold().plot,
                 misalign.Catalogue(CATALOGUE).plot)
        with mock.patch.dict(sys.modules, MATPLOTLIB):
            for call in calls:
                with self.assertRaisesRegex(misalign.Error, "^matplotlib is missing, .*install it, such as Debian's "
                                                            "python3-matplotlib$"):
                    call()

    def test_nothing_is_imported_before_its_time(self):
        """matplotlib takes half a second."""
        done = subprocess.run([sys.executable, "-c", "import misalign, sys; print('matplotlib' in sys.modules)"], check=True,
                              env={**os.environ, "PYTHONPATH": str(PACKAGE)}, capture_output=True, text=True)
        self.assertEqual(done.stdout.strip(), "False")


class Views(unittest.TestCase):
    def setUp(self):
        self.path = mock.patch.dict(os.environ, PATH=os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"])
        self.path.start()
        self.addCleanup(self.path.stop)

    def test_the_page_is_that_of_the_program(self):
        program("report", TABLE1, "--output", "table1.html")
        with open("table1.html", encoding="utf-8") as file:
            page = file.read()
        shown = misalign.view(misalign.read(TABLE1), height_px=555)
        ours, theirs = [json.loads(PAGE_DATA.search(text)[1]) for text in (shown.page, page)]
        for of_a_file in ("catalogue", "commands", "written_at"):
            del ours[of_a_file], theirs[of_a_file]
        self.assertEqual(ours, theirs)
        self.assertEqual(re.sub(PAGE_DATA, "", shown.page), re.sub(PAGE_DATA, "", page))

    def test_the_page_has_the_shifts_of_the_sheet(self):
        pattern = misalign.read(TABLE1)
        half = misalign.view(pattern.with_shifts(pattern.shifts_mm / 2, "half"))
        [sheet] = json.loads(PAGE_DATA.search(half.page)[1])["details"]
        self.assertEqual(sheet["draw"], "half")
        self.assertEqual({name: shift for name, shift in zip(pattern.vertex_labels, (pattern.shifts_mm / 2).tolist()) if any(shift)},
                         sheet["displacements_mm"])

    def test_the_frame_holds_the_whole_page(self):
        shown = misalign.view(misalign.read(TABLE1), height_px=555)
        frame = re.fullmatch(r'<iframe title="sheet" sandbox="allow-scripts allow-downloads" srcdoc="([^"]*)" '
                             r'style="[^"]*height: 555px[^"]*"></iframe>', shown._repr_html_())
        self.assertEqual(html.unescape(frame[1]), shown.page)

    def test_a_name_that_is_no_file(self):
        pattern = misalign.read(TABLE1)
        for name in ("../half <b>\"as\" far/.", "...", "x" * 300):
            self.assertIn("<!doctype html>", misalign.view(pattern.with_shifts(pattern.shifts_mm / 2, name)).page)

    def test_errors(self):
        with self.assertRaisesRegex(misalign.Error, "is no pattern; give one") as caught:
            misalign.view(TABLE1)
        self.assertEqual(caught.exception.exit_code, 2)
        for height, words in ((0, "=0: is too small; give at least 1$"), (-1, "=-1: is too small"), (10**7, "=10000000: is too large"),
                              (10**400, ": is no finite number"), (10**5000, ": is no finite number"), (1.5, "=1.5: is no whole"),
                              (True, "=True: is no whole"), ("9", "=9: is no whole")):
            with self.assertRaisesRegex(misalign.Error, f"^height_px{words}") as caught:
                misalign.view(misalign.read(TABLE1), height)
            self.assertEqual(caught.exception.exit_code, 2)

    def test_without_the_program(self):
        from misalign import _view
        with mock.patch.object(_view, "__file__", "/nowhere/misalign/_view.py"), mock.patch.dict(os.environ, PATH="/nowhere"):
            with self.assertRaisesRegex(misalign.Error, "^the program misalign is missing, .*PATH$"):
                misalign.view(misalign.read(TABLE1))

    def test_a_program_that_fails(self):
        from misalign import _view
        os.makedirs("other/bin", exist_ok=True)
        with open("other/bin/misalign", "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho 'misalign: Node.js is not in this build' >&2\nexit 1\n")
        os.chmod("other/bin/misalign", 0o755)
        with mock.patch.object(_view, "__file__", os.path.abspath("other/lib/misalign/_view.py")):
            with self.assertRaisesRegex(misalign.Error, "^Node.js is not in this build$"):
                misalign.view(misalign.read(TABLE1))


if __name__ == "__main__":
    unittest.main()
