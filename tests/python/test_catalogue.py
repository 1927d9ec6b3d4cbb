"""Catalogues beside the program's own answers."""

import json
import os
import pickle
import shutil
import sqlite3
import unittest

import numpy as np

from fixture import CATALOGUE, SMALL, program, program_json

import misalign


class Catalogues(unittest.TestCase):
    def setUp(self):
        self.catalogue = misalign.Catalogue(CATALOGUE)

    def test_the_campaign(self):
        file = misalign.read(SMALL)
        self.assertEqual(self.catalogue.campaign.identity, file.identity)
        self.assertEqual(self.catalogue.campaign.configuration["pattern"], file.configuration["pattern"])
        np.testing.assert_array_equal(self.catalogue.shifts(range(100)), file.shifts(range(100)))

    def test_candidates(self):
        rows = sqlite3.connect(CATALOGUE).execute("SELECT draw, miscut_margin_mm, yield FROM candidates").fetchall()
        table = self.catalogue.candidates()
        self.assertEqual(dict(zip(table.draw, table.miscut_margin_mm)), {draw: margin for draw, margin, _ in rows})
        self.assertTrue(table["yield"].isna().all())
        best = program_json("query", CATALOGUE, "best")
        self.assertEqual(list(table.draw[:len(best)]), [row["draw"] for row in best])
        chosen = self.catalogue.candidates("increasing > 2", by="stroke_max", limit=5)
        said = program_json("query", CATALOGUE, "SELECT draw FROM candidates WHERE increasing > 2 "
                            "ORDER BY stroke_max DESC LIMIT 5")
        self.assertEqual(list(chosen.draw), [row["draw"] for row in said])
        none = self.catalogue.candidates("stroke_max > 9")
        self.assertEqual((len(none), list(none.columns)), (0, list(table.columns)))

    def test_queries(self):
        for name in ("best", "acceptance", "rejections", "SELECT 1 AS a, NULL AS a, 'x' AS b, 2.5 AS c, x'00' AS d"):
            said = program_json("query", CATALOGUE, name)
            table = self.catalogue.query(name)
            self.assertEqual(list(table.columns), list(said[0]))
            for column in table.columns:
                for ours, theirs in zip(table[column], [row[column] for row in said]):
                    if theirs is None:
                        self.assertTrue(ours is None or np.isnan(ours))
                    elif column != "d":
                        self.assertEqual(ours, theirs)

    def test_histories_are_those_of_replays(self):
        draws = list(range(40))
        stations, lengths = self.catalogue.histories(draws)
        self.assertEqual(lengths.shape, (40, 180, 4))
        ends = set()
        for draw in draws:
            solved = self.catalogue.replay(draw).length_mm
            np.testing.assert_array_equal(lengths[draw, :len(solved)], solved)
            self.assertTrue(np.isnan(lengths[draw, len(solved):]).all())
            ends.add(len(solved))
        self.assertGreater(len(ends), 1)
        self.assertEqual(stations.tolist(), list(range(1, 181)))

    def test_springs(self):
        draw = int(self.catalogue.candidates(limit=1).draw[0])
        said = program_json("actuators", CATALOGUE, draw)
        springs = self.catalogue.springs(draw)
        self.assertEqual(set(springs), set(said))
        self.assertEqual(springs["history"]["moment_n_mm"].tolist(), said["history"]["moment_n_mm"])
        self.assertEqual(springs["deploys_from_deg"], said["deploys_from_deg"])

    def test_tolerance(self):
        draw = int(self.catalogue.candidates(limit=1).draw[0])
        said = program_json("tolerance", CATALOGUE, draw, "--amplitude", 0.05, "--trials", 300, "--no-keep")
        for jobs in (1, 2):
            ours = self.catalogue.tolerance(draw, 0.05, 300, jobs)
            self.assertEqual(ours, said)
        self.assertEqual(self.catalogue.candidates(f"draw = {draw}")["yield"].isna().sum(), 1)

    def test_closing(self):
        with self.catalogue as catalogue:
            self.assertGreater(len(catalogue.candidates(limit=3)), 0)
        self.catalogue.close()
        for call in (self.catalogue.candidates, self.catalogue.query, self.catalogue.__enter__,
                     lambda: self.catalogue.histories([1]), lambda: self.catalogue.springs(1)):
            with self.assertRaisesRegex(misalign.Error, "is closed"):
                call()
        self.assertEqual(self.catalogue.campaign.name, "miura-4x4")
        self.assertEqual(pickle.loads(pickle.dumps(misalign.Catalogue(CATALOGUE))).campaign.name, "miura-4x4")

    def calls_of(self, catalogue):
        return (catalogue.candidates, catalogue.query, lambda: catalogue.shifts([1]), lambda: catalogue.histories([1]),
                lambda: catalogue.replay(1), lambda: catalogue.springs(1), lambda: catalogue.tolerance(1, 0.01, 5))

    def test_a_file_that_is_replaced(self):
        """Whatever is asked is of the file that was opened, or refused."""
        with open(SMALL, encoding="utf-8") as file:
            other = json.load(file)
        other["seed"] = 2
        with open("other.json", "w", encoding="utf-8") as file:
            json.dump(other, file)
        program("search", "other.json", "--draws", 3000, "--catalogue", "other.db", "--progress", "none")
        shutil.copy(CATALOGUE, "again.db")
        shutil.copy(CATALOGUE, "turned.db")
        catalogue = misalign.Catalogue("turned.db")
        pickled = pickle.dumps(catalogue)
        for replacement, words in (("other.db", "another campaign"), ("again.db", "another file")):
            shutil.copy(replacement, "new.db")
            os.replace("new.db", "turned.db")
            for call in self.calls_of(catalogue):
                with self.assertRaisesRegex(misalign.Error, f"^turned.db: .*{words}.* was opened .*; open it") as caught:
                    call()
                self.assertEqual(caught.exception.exit_code, 5)
            anew = misalign.Catalogue("turned.db")
            for call in self.calls_of(anew):
                call()
            if replacement == "other.db":
                self.assertNotEqual(anew.campaign.identity, catalogue.campaign.identity)
                with self.assertRaisesRegex(misalign.Error, "another campaign than at the time of the pickle"):
                    pickle.loads(pickled)
        self.assertEqual(pickle.loads(pickled).campaign.identity, catalogue.campaign.identity)
        # The same file with another content.
        shutil.copyfile("other.db", "turned.db")
        with self.assertRaisesRegex(misalign.Error, "another campaign"):
            anew.candidates()

    def test_a_file_that_grows(self):
        program("search", SMALL, "--draws", 2000, "--catalogue", "growing.db", "--progress", "none")
        catalogue = misalign.Catalogue("growing.db")
        before = len(catalogue.candidates())
        program("search", SMALL, "--draws", 6000, "--catalogue", "growing.db", "--progress", "none")
        self.assertGreater(len(catalogue.candidates()), before)
        for call in self.calls_of(catalogue):
            call()

    def test_nothing_is_changed(self):
        with open(CATALOGUE, "rb") as file:
            before = file.read()
        self.catalogue.candidates()
        self.catalogue.histories([1])
        for change in ("DELETE FROM candidate", "PRAGMA user_version = 3", "ATTACH 'x' AS y"):
            with self.assertRaises(misalign.Error):
                self.catalogue.query(change)
        with open(CATALOGUE, "rb") as file:
            self.assertEqual(file.read(), before)


if __name__ == "__main__":
    unittest.main()
