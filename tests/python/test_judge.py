"""Verdicts on arrays, beside the search's, the program's replay, and the frozen reference."""

import subprocess
import unittest

import numpy as np

from fixture import CAMPAIGNS, CATALOGUE, REFERENCE, SMALL, TABLE1, program_json

import misalign


class Verdicts(unittest.TestCase):
    def test_those_of_the_reference(self):
        for name, draws in (("miura-4x4", 300), ("miura-6x6", 40)):
            path = str(CAMPAIGNS / f"{name}.json")
            campaign = misalign.read(path)
            lines = subprocess.run([REFERENCE, path, "0", str(draws)], check=True, capture_output=True,
                                   text=True).stdout.split("\n")[:-1]
            verdicts = misalign.judge(campaign, campaign.shifts(range(draws)))
            for draw, line in enumerate(lines):
                found = (f"{verdicts.deploys_from_deg[draw]:.0f} {misalign.faults[verdicts.first_fault[draw]]} "
                         f"{verdicts.where[draw]}")
                if found != line:  # in steps of a degree the reference can jump
                    line = subprocess.run([REFERENCE, path, str(draw), "1", "0.02"], check=True,
                                          capture_output=True, text=True).stdout.strip()
                self.assertEqual(found, line, f"draw {draw} of {name}")

    def test_those_of_the_search(self):
        catalogue = misalign.Catalogue(CATALOGUE)
        shifts_mm = catalogue.campaign.shifts(range(20000))
        candidates = catalogue.candidates()
        accepted = misalign.judge(catalogue.campaign, shifts_mm, catalogue.campaign.threshold_deg)
        self.assertEqual(np.flatnonzero(accepted).tolist(), sorted(candidates.draw))
        draws = candidates.draw.to_numpy()
        verdicts = misalign.judge(catalogue.campaign, shifts_mm[draws])
        np.testing.assert_array_equal(verdicts.deploys_from_deg, candidates.deploys_from_deg)
        sample = catalogue.query("SELECT draw, first_fault, deploys_from_sample FROM fault_sample")
        self.assertEqual(len(sample), 20)
        verdicts = misalign.judge(catalogue.campaign, shifts_mm[sample.draw])
        self.assertEqual([misalign.faults[fault] for fault in verdicts.first_fault], list(sample.first_fault))
        np.testing.assert_array_equal(verdicts.deploys_from_deg, sample.deploys_from_sample)

    def test_with_and_without_a_threshold(self):
        campaign = misalign.read(SMALL)
        shifts_mm = campaign.shifts(range(3000))
        verdicts = misalign.judge(campaign, shifts_mm)
        for threshold in (1, 40, 100, 150, 180):
            accepted = misalign.judge(campaign, shifts_mm, threshold)
            np.testing.assert_array_equal(accepted, verdicts.deploys_from_deg >= threshold)
            of_pattern = misalign.judge(campaign.pattern, shifts_mm, threshold)
            np.testing.assert_array_equal(of_pattern, accepted)

    def test_any_shifts(self):
        pattern = misalign.read(SMALL).pattern
        random = np.random.default_rng(7)
        everywhere = random.uniform(-0.3, 0.3, (60, *pattern.vertices_mm.shape))
        inside = np.zeros_like(everywhere)
        inside[:, pattern.interior] = everywhere[:, pattern.interior]
        mixed = np.concatenate([inside[:30], everywhere, np.round(inside[30:])])  # of all kinds, after one another
        verdicts = misalign.judge(pattern, mixed)
        for sheet in (0, 31, 95):
            folding = pattern.fold([90], mixed[sheet])
            self.assertEqual(verdicts.deploys_from_deg[sheet], folding.deploys_from_deg)
            self.assertEqual(misalign.faults[verdicts.first_fault[sheet]], folding.first_fault)
        accepted = misalign.judge(pattern, mixed, 60)
        np.testing.assert_array_equal(accepted, verdicts.deploys_from_deg >= 60)
        self.assertTrue(0 < accepted.sum() < len(accepted))

    def test_members_of_the_parallel_family_as_they_fold(self):
        # All creases of these close at 180 degrees at once: where rounding would decide, neither says anything.
        pattern = misalign.read({"family": "miura", "rows": 6, "columns": 6, "holes": "checkerboard-even"})
        member = np.zeros_like(pattern.vertices_mm)
        member[[15, 16, 17, 18, 22], 0] = 0.4
        member[[26, 30, 31, 32, 33], 0] = -0.4
        shifts_mm = np.multiply.outer([0.5, 1, 2, 5, 8, 13, 20], member)
        verdicts = misalign.judge(pattern, shifts_mm)
        self.assertEqual(verdicts.deploys_from_deg.tolist(), [179] * len(shifts_mm))
        for sheet, shifts in enumerate(shifts_mm):
            folding = pattern.fold(shifts_mm=shifts)
            self.assertEqual(folding.deploys_from_deg, 179)
            self.assertEqual(folding.first_fault, "none")
            self.assertEqual(misalign.faults[verdicts.first_fault[sheet]], "none")
        for threshold in (179, 180):
            accepted = misalign.judge(pattern, shifts_mm, threshold)
            np.testing.assert_array_equal(accepted, verdicts.deploys_from_deg >= threshold)

    def test_numbers_of_any_kind(self):
        campaign = misalign.read(SMALL)
        shifts_mm = campaign.shifts(range(40))
        wanted = misalign.judge(campaign, np.sign(shifts_mm)).deploys_from_deg
        for other in (np.sign(shifts_mm).astype(np.int8), np.asfortranarray(np.sign(shifts_mm)),
                      np.sign(shifts_mm).astype(np.float32), np.repeat(np.sign(shifts_mm), 2, axis=0)[::2],
                      np.sign(shifts_mm).tolist(), np.sign(shifts_mm).astype(">f8")):
            np.testing.assert_array_equal(misalign.judge(campaign, other).deploys_from_deg, wanted)

    def test_a_pattern_itself(self):
        pattern = misalign.read(TABLE1)
        said = program_json("fold", TABLE1)["verdict"]
        both = np.stack([pattern.shifts_mm, -pattern.shifts_mm])
        verdicts = misalign.judge(pattern, both)
        self.assertEqual(verdicts.deploys_from_deg[0], said["deploys_from_deg"])
        self.assertEqual((misalign.faults[verdicts.first_fault[0]], verdicts.where[0]), (said["first_fault"], -1))
        other = pattern.fold(shifts_mm=both[1])
        self.assertEqual((verdicts.deploys_from_deg[1], misalign.faults[verdicts.first_fault[1]],
                          pattern.diagonal_labels[verdicts.where[1]]),
                         (other.deploys_from_deg, other.first_fault, other.where))
        self.assertEqual(misalign.judge(pattern, both, 156).tolist(), [True, False])
        self.assertEqual(misalign.judge(pattern, both, 157).tolist(), [False, False])

    def test_an_older_name(self):
        campaign = misalign.read(SMALL)
        verdicts = misalign.judge(campaign, campaign.shifts(range(5)))
        self.assertIs(verdicts.fault, verdicts.first_fault)

    def test_nothing(self):
        campaign = misalign.read(SMALL)
        nothing = np.zeros((0, 25, 2))
        self.assertEqual(len(misalign.judge(campaign, nothing)), 0)
        self.assertEqual(misalign.judge(campaign, nothing, 100).shape, (0,))

    def test_undecided_is_no_answer(self):
        """No sheet is known that is; so that one is made up."""
        from misalign import _judge, _misalign
        known = _misalign.accepted
        _judge._misalign.accepted = lambda *ignored: np.array([0, 1, 2, 1], dtype=np.uint8)
        try:
            with self.assertRaises(misalign.UndecidedError) as caught:
                misalign.judge(misalign.read(SMALL), np.zeros((4, 25, 2)), 100)
        finally:
            _judge._misalign.accepted = known
        self.assertEqual(caught.exception.undecided.tolist(), [2])
        self.assertEqual(caught.exception.accepted.tolist(), [False, True, False, True])
        self.assertIsInstance(caught.exception, misalign.Error)


if __name__ == "__main__":
    unittest.main()
