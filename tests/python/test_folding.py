"""Foldings beside the program's JSON, whose numbers come back bit for bit."""

import json
import unittest
from pathlib import Path

import numpy as np

from fixture import CATALOGUE, SMALL, SOURCE, TABLE1, program, program_json

import misalign


class Foldings(unittest.TestCase):
    def same(self, folding, said):
        self.assertEqual(folding.pilot_deg.tolist(), said["samples_deg"])
        for name, key in (("length_mm", "length_mm"), ("rate_mm_per_deg", "slope_mm_per_deg")):
            wanted = np.array([diagonal[key] for diagonal in said["diagonals"]]).T
            np.testing.assert_array_equal(getattr(folding, name), wanted)
        wanted = np.array([crease["fold_angle_deg"] for crease in said["creases"]]).T
        np.testing.assert_array_equal(folding.fold_angle_deg, wanted)
        self.assertEqual(folding.flat_mm.tolist(), [diagonal["flat_mm"] for diagonal in said["diagonals"]])
        self.assertEqual(folding.fold_limit_deg, said["fold_limit_deg"])
        for name in ("deploys_from_deg", "first_fault", "fault_deg", "where"):
            self.assertEqual(getattr(folding, name), said["verdict"][name])
        self.assertEqual(folding.bump_between_samples, said["bump_between_samples"])

    def test_a_pattern_file(self):
        self.same(misalign.read(TABLE1).fold(), program_json("fold", TABLE1))

    def test_patterns_of_every_kind(self):
        for file in ("turned-quads-6x6.fold", "miura-graded-6x6.json", "angle-array-6x6.json"):
            with self.subTest(file):
                path = SOURCE / "search/patterns" / file
                self.same(misalign.read(path).fold(), program_json("fold", path))

    def test_half_degrees(self):
        said = program_json("fold", TABLE1, "--step", 0.5)
        folding = misalign.read(TABLE1).fold(np.arange(0.5, 180.25, 0.5))
        solved = len(said["samples_deg"])
        for name in ("pilot_deg", "length_mm", "rate_mm_per_deg", "fold_angle_deg"):
            if name != "pilot_deg":
                self.assertTrue(np.isnan(getattr(folding, name)[solved:]).all())
            setattr(folding, name, getattr(folding, name)[:solved])
        self.same(folding, said)

    def test_stations_that_are_no_samples(self):
        pattern = misalign.read(TABLE1)
        fine = pattern.fold(np.arange(0.25, 180.1, 0.25))
        some = pattern.fold([0, 30.25, 77.75])
        self.assertEqual(some.length_mm.shape, (3, 16))
        np.testing.assert_array_equal(some.length_mm[0], some.flat_mm)
        np.testing.assert_array_equal(some.fold_angle_deg[0], 0)
        np.testing.assert_array_equal(some.rate_mm_per_deg[0], 0)
        flat = pattern.vertices_mm + pattern.shifts_mm
        np.testing.assert_array_equal(some.vertices_mm[0], np.column_stack([flat, np.zeros(len(flat))]))
        for row, angle in ((1, 30.25), (2, 77.75)):
            np.testing.assert_allclose(some.length_mm[row], fine.length_mm[fine.pilot_deg == angle][0], rtol=1e-12)
        self.assertEqual(some.deploys_from_deg, 156)

    def test_draws(self):
        catalogue = misalign.Catalogue(CATALOGUE)
        best = int(catalogue.candidates(limit=1).draw[0])
        for draw in (0, 1, 2, best):
            with self.subTest(draw):
                said = program_json("replay", CATALOGUE, draw)
                folding = catalogue.replay(draw)
                self.same(folding, said)
                self.assertEqual(folding.accepted, said["verdict"]["accepted"])

    def test_what_lies_between_samples_is_that_of_the_path(self):
        configuration = json.loads(Path(SMALL).read_text())
        configuration["path"]["sample_deg"] = 10
        Path("wide.json").write_text(json.dumps(configuration))
        program("search", "wide.json", "--catalogue", "wide.db", "--draws", 50, "--progress", "none")
        bump = misalign.Catalogue("wide.db").replay(42).bump_between_samples  # a cubic has it 0.26 deg higher
        campaign = misalign.read("wide.json")
        fine = campaign.pattern.fold(np.arange(130, 140, 0.02), campaign.shifts(42)[0])
        length = fine.length_mm[:, campaign.pattern.diagonal_labels.index(bump["where"])]
        turns = np.flatnonzero(np.diff(np.sign(np.diff(length)))) + 1
        self.assertAlmostEqual(bump["from_deg"], fine.pilot_deg[turns[0]], delta=0.02)

    def test_beyond_the_fold_limit(self):
        campaign = misalign.read(SMALL)
        for draw in range(50):
            folding = campaign.pattern.fold([10, 170, 180], campaign.shifts(draw)[0])
            if folding.fold_limit_deg < 170:
                break
        self.assertEqual(np.isnan(folding.length_mm).all(axis=1).tolist(), [False, True, True])
        self.assertEqual(np.isnan(folding.vertices_mm).all(axis=(1, 2)).tolist(), [False, True, True])

    def test_lengths_are_those_of_the_vertices(self):
        pattern = misalign.read(TABLE1)
        folding = pattern.fold(range(0, 181, 20))
        ends = folding.vertices_mm[:, pattern.diagonals]
        np.testing.assert_allclose(np.linalg.norm(ends[:, :, 0] - ends[:, :, 1], axis=2), folding.length_mm,
                                   atol=1e-9)
        steps = np.linspace(59.999, 60.001, 3)
        near = pattern.fold(steps)
        np.testing.assert_allclose((near.length_mm[2] - near.length_mm[0]) / 0.002, near.rate_mm_per_deg[1],
                                   atol=1e-6)


if __name__ == "__main__":
    unittest.main()
