"""Studies of a sheet: bit for bit what the program says of the same sheet, and back to the program."""

import json
import unittest

import numpy as np
from fixture import CATALOGUE, TABLE1, program, program_json

import misalign

DESIGN = {"from_deg": 140, "springs": {"stiffness_n_per_mm": 2, "stroke_limit": 0.08},
          "hinges": {"friction_n_mm_per_mm": 0.0005}, "thickness_mm": 0.5, "miscut_mm": 0.02}


def plain(said):
    """With lists in the place of arrays, as JSON has them."""
    if isinstance(said, dict):
        return {key: plain(value) for key, value in said.items()}
    if isinstance(said, np.ndarray):
        return [None if value != value else value for value in said.tolist()]
    return [plain(value) for value in said] if isinstance(said, list) else said


class Studies(unittest.TestCase):
    def setUp(self):
        self.catalogue = misalign.Catalogue(CATALOGUE)
        self.draw = int(self.catalogue.candidates(limit=1).draw[0])
        self.addCleanup(self.catalogue.close)

    def same(self, said, program_said, *but):
        program_said = {key: value for key, value in program_said.items() if key not in ("draw", "pattern", *but)}
        said = {key: value for key, value in plain(said).items() if key not in ("draw", "pattern", *but)}
        self.assertEqual(said, program_said)

    def test_gradients_are_those_of_folded_neighbours(self):
        sheet = misalign.read(TABLE1)
        stations, vertex, step_mm = [30, 120], sheet.vertex_labels.index("A17"), 1e-3
        found = sheet.gradient(stations)
        for axis in (0, 1):
            folded = []
            for sign in (-1, 1):
                shifts_mm = sheet.shifts_mm.copy()
                shifts_mm[vertex, axis] += sign * step_mm
                folded.append(sheet.with_shifts(shifts_mm).fold(stations))
            by = (folded[1].length_mm - folded[0].length_mm) / (2 * step_mm)
            np.testing.assert_allclose(found["length_by_mm"][:, :, vertex, axis], by, atol=1e-6)
            self.assertGreater(abs(by).max(), 1e-2)
            steeper = np.degrees(folded[1].rate_mm_per_deg - folded[0].rate_mm_per_deg) / (2 * step_mm)
            np.testing.assert_allclose(found["slope_by_mm"][:, :, vertex, axis], steeper, atol=1e-4)
        self.assertTrue(np.isnan(sheet.gradient([170])["length_mm"]).all())
        with self.assertRaises(misalign.Error):
            sheet.gradient([20, 10])

    def test_stress_is_largest_beside_the_one_spring(self):
        """Of these springs; that of others is largest on the way to the rim."""
        sheet = misalign.read(TABLE1)
        ends = [label.split("-") for label in sheet.diagonal_labels]
        for number in (0, 6, 9, 13):
            none = [{"from": a, "to": b, "stiffness_n_per_mm": 0} for k, (a, b) in enumerate(ends) if k != number]
            angles = sheet.deploy(from_deg=36, bend=True, fill={"kind": "springs", "single": none})["bent"]["angles"]
            for angle in angles:
                self.assertEqual(angle["panel_stress_mpa"].shape, (len(sheet.panels),))
                self.assertEqual(angle["panel_stress_mpa"].max(), angle["largest_stress_mpa"])
            most = sheet.panels[angles[-1]["panel_stress_mpa"].argmax()]
            self.assertTrue(set(most) & set(sheet.diagonals[number]), number)

    def test_optimises_as_the_program(self):
        sheet = misalign.read(TABLE1)
        better, said = sheet.optimise(deploys_from_deg=150, ternary=True, stroke_limit=0.1)
        self.assertEqual(said, program_json("optimise", TABLE1, "--deploys-from", 150, "--ternary", "--stroke-limit", 0.1))
        self.assertEqual(better.deploy()["critical_friction_n_mm_per_mm"], said["after_n_mm_per_mm"])
        limits = ["stroke_max <= 0.1", "largest_force_n <= 400"]
        self.assertEqual(sheet.optimise(deploys_from_deg=150, ternary=True, subject_to=limits)[1], program_json(
            "optimise", TABLE1, "--deploys-from", 150, "--ternary", "--subject-to", limits[0], "--subject-to", limits[1]))
        self.assertEqual(sheet.optimise("energy_n_mm", deploys_from_deg=150, stiffness_n_per_mm=10, stiffness_within=[5, 20],
                                        subject_to=limits[1:])[1], program_json(
            "optimise", TABLE1, "--goal", "energy_n_mm", "--deploys-from", 150, "--stiffness", 10, "--stiffness-within", "5,20",
            "--subject-to", limits[1]))
        with self.assertRaisesRegex(misalign.Error, "subject_to=stroke_max >= 1: stroke_max needs an upper bound"):
            sheet.optimise(subject_to=["stroke_max >= 1"])
        with self.assertRaisesRegex(misalign.Error, "most is no goal"):
            sheet.optimise("most")

    def test_are_those_of_the_program(self):
        sheet = self.catalogue.pattern(self.draw)
        self.same(sheet.contact(), program_json("contact", CATALOGUE, self.draw))
        self.same(sheet.actuators(), program_json("actuators", CATALOGUE, self.draw))
        self.same(sheet.deploy(), program_json("deploy", CATALOGUE, self.draw))
        self.same(sheet.contact(90, trim_mm=3), program_json("contact", CATALOGUE, self.draw, "--from", 90, "--trim", 3))
        self.same(sheet.actuators(90.5, 2, 0.08), program_json(
            "actuators", CATALOGUE, self.draw, "--from", 90.5, "--stiffness", 2, "--stroke-limit", 0.08))
        self.same(sheet.deploy(90, 2, 1e-5, 0.5), program_json(
            "deploy", CATALOGUE, self.draw, "--from", 90, "--stiffness", 2, "--friction", 1e-5, "--thickness", 0.5))
        self.same(self.catalogue.tolerance(self.draw, 0.05, 100, from_deg=90), program_json(
            "tolerance", CATALOGUE, self.draw, "--amplitude", 0.05, "--trials", 100, "--from", 90, "--no-keep"))
        self.same(sheet.deploy(90, preload_n=0.5, bend=True), program_json(
            "deploy", CATALOGUE, self.draw, "--from", 90, "--preload", 0.5, "--panels", "bend"))
        self.same(sheet.actuators(90, preload_n=0.5), program_json(
            "actuators", CATALOGUE, self.draw, "--from", 90, "--preload", 0.5))
        self.same(sheet.card(trials=20), program_json(
            "card", CATALOGUE, self.draw, "--trials", 20, "--no-remedies", codes=(0, 6)))
        table1 = misalign.read(TABLE1)
        self.same(table1.tolerance(0.05, 50), program_json("tolerance", TABLE1, "--amplitude", 0.05, "--trials", 50))
        self.same(table1.tolerance(0.05, 50, from_deg=90), program_json(
            "tolerance", TABLE1, "--amplitude", 0.05, "--trials", 50, "--from", 90))
        self.same(table1.certify(20), program_json("certify", TABLE1, "--from", 20)["certificate"], "seconds")

    def test_a_design_goes_to_the_program_and_back(self):
        sheet = self.catalogue.pattern(self.draw)
        sheet.write("bare.json")
        with open("bare.json", encoding="utf-8") as file:
            document = json.load(file)
        document["design"] = DESIGN
        mine = misalign.read(document)
        asked = {line["key"]: line["wanted"] for line in mine.card(trials=20)["lines"]}
        self.assertEqual((asked["thickness_mm"], asked["stroke"], asked["yield"]), (0.5, 0.08, 0.95))
        self.assertEqual(mine.design["from_deg"], 140)
        mine.with_shifts(mine.shifts_mm * 0.99, "mine").write("mine.json")
        mine = misalign.read("mine.json")
        np.testing.assert_array_equal(mine.shifts_mm, sheet.shifts_mm * 0.99)
        self.same(mine.contact(), program_json("contact", "mine.json"))
        self.same(mine.deploy(), program_json("deploy", "mine.json"))
        self.same(mine.actuators(), program_json("actuators", "mine.json"))
        self.same(mine.tolerance(trials=40), program_json("tolerance", "mine.json", "--trials", 40))
        self.assertEqual(mine.contact()["from_deg"], 140)

    def test_campaigns_are_made_from_a_dict(self):
        campaign = misalign.read({"name": "own", "pattern": {"family": "miura", "rows": 4, "columns": 4},
                                  "design": DESIGN, "accept": {"deploys_from_deg": 150}})
        self.assertEqual(campaign.identity, misalign.Catalogue(CATALOGUE).campaign.identity)
        self.assertEqual(campaign.configuration["design"]["springs"]["stiffness_n_per_mm"], 2)
        with self.assertRaises(misalign.Error) as refused:
            misalign.read({"pattern": {"family": "miura", "rows": 4, "columns": 4}, "design": {"from_deg": 200}})
        self.assertIn("design.from_deg = 200", str(refused.exception))

    def test_numbers_of_numpy(self):
        said = {"family": "miura", "rows": 4, "columns": 4, "displacements_mm": {"A7": [0.4, 0]}}
        of_numpy = {"family": "miura", "rows": np.int64(4), "columns": np.uint8(4),
                    "displacements_mm": {"A7": np.array([0.4, 0])}, "design": {"thickness_mm": np.float32(0.5)}}
        sheet, same = misalign.read(said), misalign.read(of_numpy)
        np.testing.assert_array_equal(sheet.shifts_mm, same.shifts_mm)
        self.assertEqual(same.design["thickness_mm"], 0.5)
        self.same(same.contact(np.float32(90), trim_mm=np.float64(3)), plain(same.contact(90, trim_mm=3)))
        for bad in ({**said, "rows": np.nan}, {**said, "rows": object()}, {**said, "rows": {1, 2}}):
            with self.assertRaisesRegex(misalign.Error, "give "):
                misalign.read(bad)

    def test_facets_holes_and_panels(self):
        sheet = misalign.read(TABLE1)
        np.testing.assert_array_equal(sheet.panels, np.delete(sheet.facets, sheet.holes, axis=0))

    def test_folded_vertices_are_from_a1(self):
        """Of gradient the first panel lies as on the flat sheet, less where A1 lies."""
        sheet = misalign.read(TABLE1)
        flat_mm = sheet.vertices_mm + sheet.shifts_mm
        folded_mm = sheet.gradient([40])["folded_mm"][0]
        first = sheet.panels[0]
        np.testing.assert_allclose(folded_mm[first, :2], flat_mm[first] - flat_mm[0], atol=1e-9)
        np.testing.assert_allclose(folded_mm[first, 2], 0, atol=1e-9)

    def test_the_vocabulary(self):
        names = [line.split()[0] for line in program("query", "--help").splitlines()
                 if line.startswith("  ") and line.split()[0].endswith(("_deg", "_mm", "_s", "_per_mm"))]
        names = [name for name in names if not name.startswith("-")]
        self.assertGreaterEqual(len(names), 7)
        few = f"draw IN ({self.draw}, {int(self.catalogue.candidates(limit=2).draw[1])})"
        for name in names:
            for word in (name, f"{name}(draw)", f"{name}(draw, 90)"):
                table = self.catalogue.candidates(few, by=word, columns=[word])
                self.assertEqual(len(table), 2, word)
                asked = self.catalogue.query(f"SELECT draw, {word} AS found FROM candidates WHERE {few}")
                found = dict(zip(asked.draw, asked.found))
                for draw, value in zip(table.draw, table[word]):
                    np.testing.assert_equal(value, found[draw])
        with self.assertRaises(misalign.Error) as refused:
            self.catalogue.candidates(columns=["thicknes_mm"])
        self.assertIn("did you mean thickness_mm?", str(refused.exception))

    def test_beyond_d(self):
        for study in ("contact", "actuators"):
            with self.assertRaises(misalign.Error) as refused:
                getattr(misalign.read(TABLE1), study)(from_deg=157)
            self.assertIn("lies beyond D = 156 deg", str(refused.exception))


if __name__ == "__main__":
    unittest.main()
