"""The performance chapter judges goals by the rows it was given; no run of the program."""

import sys
import tempfile
import unittest
from pathlib import Path

MANUAL = Path(__file__).resolve().parents[2] / "manual"
sys.path[:0] = [str(MANUAL / "performance"), str(MANUAL / "verification")]

import headline  # noqa: E402
import measure  # noqa: E402
import scene_runs  # noqa: E402
import statics  # noqa: E402


def pair(threads, latin, linear, **more):
    row = {"integration": "automatic", "latin, whole run [s]": 2 * latin, "linear, whole run [s]": 3 * linear, "threads": threads, "dofs": 1e5, "latin [s]": latin, "linear [s]": linear, "iterations per step": 7.0, "share of the processor": 1.0,
           "linear, all over quiet": 1.0}
    return row | {phase: 1.0 for phase in measure.PHASES} | more


class Headline(unittest.TestCase):
    def test_the_ratio_is_the_median_of_the_pairs(self):
        rows = [pair(1, 8.0, 10.0), pair(1, 30.0, 10.0), pair(1, 9.0, 10.0)]
        self.assertAlmostEqual(headline.ratio(rows, "automatic", 1), 0.9)
        self.assertTrue(headline.goals(rows)[0][2])

    def test_a_goal_on_two_threads_is_stricter(self):
        self.assertEqual([goal[2] for goal in headline.goals([pair(1, 8.0, 10.0), pair(2, 7.0, 10.0)])], [True, True, False, True])

    def test_a_busy_machine_is_told(self):
        self.assertFalse(headline.was_busy([pair(1, 8.0, 10.0)]))
        self.assertTrue(headline.was_busy([pair(1, 8.0, 10.0, **{"share of the processor": 0.5})]))
        self.assertTrue(headline.was_busy([pair(2, 8.0, 10.0, **{"linear, all over quiet": 3.0})]))

    def test_the_loosest_tolerance_within_the_limit_is_named(self):
        def row(tolerance, off):
            return {"tolerance": tolerance, "iterations per step": 5.0} | {name: off for _, _, name in headline.HISTORIES}
        self.assertIn("Tolerance 0.0001 ", headline.tolerance_words([row(1e-3, 0.02), row(1e-4, 0.0005), row(1e-5, 0.0001)]))
        self.assertIn("None", headline.tolerance_words([row(1e-3, 0.02)]))


class Scenes(unittest.TestCase):
    def test_speed_up_compares_the_same_scene(self):
        rows = [{"scene": "a", "settings": "n=1", "dofs": 10, "threads": 1, "all [s]": 4.0},
                {"scene": "a", "settings": "n=1", "dofs": 10, "threads": 2, "all [s]": 2.0, "two processes [s]": 5.0},
                {"scene": "a", "settings": "n=2", "dofs": 20, "threads": 2, "all [s]": 2.0, "two processes [s]": ""}]
        self.assertEqual(scene_runs.speed_up(rows), [("a", 10, 2.0, 1.6)])


class Statics(unittest.TestCase):
    def test_a_fast_box_that_has_not_converged_misses_the_goal(self):
        row = {"scene": statics.BOX, "processor [s]": 9.0, "not converged": 0}
        self.assertEqual([[goal[2] for goal in statics.goals([row | more])] for more in ({}, {"processor [s]": 11.0}, {"not converged": 1})], [[True], [False], [False]])
        self.assertEqual(statics.goals([row | {"scene": "another"}]), [])


class Rows(unittest.TestCase):
    def test_numbers_come_back_as_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.csv"
            measure.write_rows(path, [{"scene": "a", "threads": 2, "all [s]": 0.25}])
            self.assertEqual(measure.read_rows(path), [{"scene": "a", "threads": 2.0, "all [s]": 0.25}])


if __name__ == "__main__":
    unittest.main()
