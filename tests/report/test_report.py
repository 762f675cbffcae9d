"""The report reads what decks print, fits orders and judges goals; no run of the program."""

import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "manual" / "verification"))

import cases  # noqa: E402
import hard  # noqa: E402
import runs  # noqa: E402


class Numbers(unittest.TestCase):
    def test_a_label_may_hold_colons_and_commas(self):
        found = runs.parse_numbers("perfect: stress from 0.1 to 1.9 T after the arrival, max error: 2.2e-14 %")
        self.assertEqual(found, {"perfect: stress from 0.1 to 1.9 T after the arrival, max error": 2.2e-14})

    def test_a_line_may_hold_several_numbers(self):
        found = runs.parse_numbers("yields: force, error: -5.6e-09; opening, error: -1.9e-05; converged")
        self.assertEqual(found, {"yields: force, error": -5.6e-09, "opening, error": -1.9e-05})

    def test_what_is_no_number_is_left_out(self):
        self.assertEqual(runs.parse_numbers("friction 0.30: the corner spreads 8.63 um\nwarning: srs: below 5000 Hz"), {})
        self.assertTrue(math.isnan(runs.parse_numbers("error: nan")["error"]))

    def test_tables_lose_their_units_and_keep_the_names_of_steps(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "push.csv"
            path.write_text("time [s],step,normal [N]\n0,fall,1\n0.5,fall,-2.5\n")
            table = runs.read_table(path)
        self.assertEqual(list(table), ["time", "step", "normal"])
        self.assertEqual(table["normal"].tolist(), [1.0, -2.5])


class Orders(unittest.TestCase):
    def test_a_power_law_gives_its_power(self):
        widths = [0.1, 0.05, 0.025, 0.0125]
        self.assertAlmostEqual(cases.fitted_order(widths, [-3 * h**1.7 for h in widths]), 1.7, 12)

    def test_round_off_has_no_order(self):
        self.assertIsNone(cases.fitted_order([0.1, 0.05, 0.025, 0.0125], [2e-12, 3e-12, 8e-12, 2e-11]))

    def test_two_points_fit_nothing(self):
        self.assertIsNone(cases.fitted_order([1, 0.5, 0.25], [1, 0, math.nan]))


class Goals(unittest.TestCase):
    def test_a_goal_is_about_the_distance_from_its_target(self):
        release = cases.Quantity("release", "release", "steps", 2)
        self.assertFalse(release.missed(-2))
        self.assertTrue(release.missed(3))
        self.assertTrue(cases.Quantity("spells", "spells", "", 0, 1).missed(2))

    def test_what_is_not_a_number_misses(self):
        self.assertTrue(cases.Quantity("force", "force", "", 1e-6).missed(math.nan))

    def test_a_hard_case_that_fails_or_hangs_is_missed(self):
        case = hard.Hard("plain", "impact")
        for code in (None, 2, 3, 4):
            self.assertIn("MISSED", hard.judge(case, runs.Run(code, "error", {})).verdict())
        refusing = hard.Hard("refused", "impact", expected="refused")
        self.assertEqual(hard.judge(refusing, runs.Run(2, "error", {})).verdict(), "met")


if __name__ == "__main__":
    unittest.main()
