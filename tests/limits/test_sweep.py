#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the sweep: the referee accepts right results and no others, cases follow from their two numbers alone."""
import math
import pathlib
import tempfile
import unittest

import referee
import sweep

AREA = 4 * math.pi + 0.6


def vesicle(**changes):
    """A summary of a settling vesicle, B0 = 47, as the program writes it."""
    return {"velocity": -10.5361, "length": 2.6913, "max_radius": 0.9778, "area": AREA, "volume": 4 * math.pi / 3,
            "bending_energy": 32.997, "stationary": True, "error_estimate": 8.9e-6, **changes}


class Referee(unittest.TestCase):
    def complaints(self, program, options, summary):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory)
            (path / "shape.csv").write_text("r,z\n0,-1.0579\n0.9778,-0.1\n0,1.6334\n")
            (path / "history.csv").write_text("step,bending_energy\n1,28.7\n2,33\n")
            return referee.complaints(program, options, summary, path)

    def test_settling(self):
        self.assertEqual(self.complaints("settling_vesicle", {"bond": 47}, vesicle()), [])
        for wrong in ({"velocity": 10.5}, {"velocity": -18.0}, {"velocity": -5.0}, {"area": AREA + 1e-3},
                      {"volume": 4.19}, {"bending_energy": 25.0}):
            self.assertTrue(self.complaints("settling_vesicle", {"bond": 47}, vesicle(**wrong)), wrong)

    def test_flow(self):
        tube = {"excess-area": 0.6, "capillary-number": -100, "confinement": 0.5}
        self.assertEqual(self.complaints("poiseuille_vesicle", tube, vesicle(velocity=-80)), [])
        self.assertEqual(len(self.complaints("poiseuille_vesicle", tube, vesicle(velocity=80))), 1)
        self.assertEqual(len(self.complaints("poiseuille_vesicle", tube, vesicle(velocity=-101))), 1)
        unbounded = {"excess-area": 0.6, "unbounded-capillary-number": 2}
        self.assertEqual(self.complaints("poiseuille_vesicle", unbounded, vesicle(velocity=-1.5)), [])
        self.assertEqual(len(self.complaints("poiseuille_vesicle", unbounded, vesicle(velocity=-2))), 1)

    def test_relaxation(self):
        options = {"excess-area": 0.6}
        self.assertEqual(self.complaints("relaxing_vesicle", options, vesicle(bending_energy=28.6)), [])
        self.assertEqual(len(self.complaints("relaxing_vesicle", options, vesicle(bending_energy=29))), 1)

    def test_rigid(self):
        # Oberbeck's drag of a 2:1 spheroid; spheres in tubes.
        self.assertAlmostEqual(referee.spheroid_drag_factor(2), 0.9555685968487, places=12)
        self.assertAlmostEqual(referee.spheroid_drag_factor(0.5), 1.1406, places=4)
        for aspect in (0.9990001, 0.9989999, 1.0009999, 1.0010001):
            self.assertAlmostEqual(referee.spheroid_drag_factor(aspect), 1 - 2 / 15 * (aspect - 1), places=6)
        sphere = {"error_estimate": 1e-8, "drag_factor": 5.94737424576}
        self.assertEqual(self.complaints("sphere_in_tube", {"confinement": 0.5}, sphere), [])
        # Between the drag in the next narrower and the next wider tube of the table.
        self.assertEqual(self.complaints("sphere_in_tube", {"confinement": 0.45}, sphere), [])
        for confinement in (0.1, 0.71):
            self.assertTrue(self.complaints("sphere_in_tube", {"confinement": confinement}, sphere))

    def test_bounds(self):
        self.assertAlmostEqual(referee.closest_confinement(0), 1, places=7)
        # A cylinder of radius 1/2 with round ends: V = pi/6 + pi h/4 and A = pi + pi h.
        height = (4 * math.pi / 3 - math.pi / 6) / (math.pi / 4)
        self.assertAlmostEqual(referee.closest_confinement(math.pi * (1 + height) - 4 * math.pi), 2, places=9)
        nodes = [{"r": 0, "z": -1}, {"r": 2, "z": 0.5}, {"r": 0, "z": 1}]
        self.assertAlmostEqual(referee.enclosing_radius(nodes), 2, places=9)

    def test_differences(self):
        self.assertIsNone(referee.difference(vesicle(), vesicle(velocity=-10.5362)))
        self.assertIn("velocity", referee.difference(vesicle(), vesicle(velocity=-10.54)))

    def test_not_finite(self):
        self.assertEqual(referee.not_finite({"a": 1, "error_estimate": None, "b": [{"c": None}]}), ["b[0].c"])


class Cases(unittest.TestCase):
    def test_reproducible(self):
        for index in range(60):
            self.assertEqual(sweep.Case(5, index).options, sweep.Case(5, index).options)
        self.assertNotEqual(sweep.Case(5, 20).options, sweep.Case(6, 20).options)

    def test_neighbours(self):
        for first in (0, 3, 30):
            half, once, twice = (sweep.Case(2, first + i).options for i in range(3))
            changed = [n for n in once if half[n] != once[n]]
            self.assertLessEqual(len(changed), 1)
            for name in changed:
                self.assertAlmostEqual(twice[name] / once[name], 2)
                self.assertAlmostEqual(half[name] / once[name], 0.5)

    def test_kinds_have_no_numbers(self):
        row = {"outcome": "failure", "message": "settling_vesicle: step 250 at time 0.0627: the time step fell below 1e-09"}
        self.assertEqual(sweep.kind_of(row), ("failure", "step # at time #: the time step fell below #"))


if __name__ == "__main__":
    unittest.main()
