"""What a run leaves behind at its end. Usage: results_test.py PROGRAM [TEST ...]

Oracles: what README and run.hpp promise; arithmetic on the case itself; one run against another.
"""

import csv
import io
import json
import math
import os
import re

import cases
from cases import COLUMN, COLUMN_IN_SPACE, SLOPE, ProgramTest, contents, frame_times, read, replaced


class Results(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("column.toml", COLUMN)

    def summary(self, folder):
        return json.loads(read(self.path(folder, "summary.json")))

    def history(self, folder):
        rows = list(csv.DictReader(io.StringIO(read(self.path(folder, "history.csv")).decode())))
        return [{key: float(value) for key, value in row.items()} for row in rows]

    def test_a_cylinder_is_a_body_of_revolution(self):
        # A column of radius 1 m between smooth walls: pressed by its weight as the plane one is. Per radian it has half of the mass per metre
        # (r²/2 against r), and so half of all energies; stress around the axis is that across it. Eq. 4 as printed: forces then are shared
        # out over r as masses are, and all of a height moves alike; corrected ones follow the exact integrals.
        moving = replaced(COLUMN, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -0.1]")
        moving = replaced(moving, "[[material]]", '[method]\nquadrature = "points"\n\n[[material]]')
        self.write("plane.toml", moving)
        self.write("round.toml", replaced(moving, "[mesh]", "axisymmetric = true\n\n[mesh]"))
        self.assertIn("volume 1.5 m3 per radian, mass 3 per radian", self.scarp("check", "round.toml").stdout)
        for case in ("plane", "round"):
            self.scarp("run", case + ".toml", "--out", case, "--quiet")
        plane, turned = self.history("plane")[-1], self.history("round")[-1]
        self.assertAlmostEqual(turned["mass"], 0.5 * plane["mass"], 12)
        for key in ("kinetic_energy", "work_gravity", "work_stress"):
            self.assertAlmostEqual(turned[key] / plane[key], 0.5, 6)
        self.assertTrue(self.summary("round")["axisymmetric"])

    def test_bodies_of_revolution_are_checked(self):
        turned = replaced(COLUMN, "[mesh]", "axisymmetric = true\n\n[mesh]")
        for find, put, parts in (
                ("axisymmetric = true", "axisymmetric = true\ngravity = [1.0, -9.81]", ["gravity points along the axis", "[1, -9.81]"]),
                ("grid = { size", "grid = { origin = [-1.0, 0.0], size", ["x is the distance from the axis", "x = -1"]),
                ("axisymmetric = true", "dimension = 3\naxisymmetric = true", ["axisymmetric is a key of cases in two dimensions"]),
                ("[[material]]", '[method]\nshape = "gimp"\n\n[[material]]', ["rings, not the boxes of GIMP"])):
            with self.subTest(put=put):
                self.write("turned.toml", replaced(turned, find, put))
                self.refused("check", "turned.toml", parts=parts)

    def test_a_column_in_space_is_the_plane_one_times_its_thickness(self):
        # The same points in each of two layers, which move alike: all energies are half of those per metre.
        self.write("plane.toml", replaced(COLUMN, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -0.1]"))
        self.write("space.toml", replaced(COLUMN_IN_SPACE, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, 0.0, -0.1]"))
        # Across the one cell of their thickness B-splines have nodal masses of 2 x 2 points, 5/16, 3/8, 5/16, where corrected
        # forces come in thirds: those move alike with eq. 4 as printed only. So do GIMP points, whose mean dilatation is over the
        # directions of the plane or of space.
        for shape, quadrature in (("linear", "corrected"), ("gimp", "points"), ("b-spline", "points")):
            with self.subTest(shape=shape):
                for case in ("plane", "space"):
                    self.scarp("run", f"{case}.toml", "--quiet", "--out", case, "--set", f"method.shape={shape}", "--set",
                               f"method.quadrature={quadrature}")
                self.expect_half()

    def expect_half(self):
        plane, space = self.history("plane"), self.history("space")
        self.assertEqual([row["time"] for row in plane], [row["time"] for row in space])
        for key in ("mass", "kinetic_energy", "work_gravity", "work_stress", "dissipation_damping"):
            largest = max(abs(row[key]) for row in plane)
            for a, b in zip(plane, space):
                self.assertAlmostEqual(0.5 * a[key], b[key], delta=1e-11 * largest, msg=key)  # rounding of a hundred steps
        for row in space:
            self.assertAlmostEqual(row["momentum_y"], 0, delta=1e-15)
        self.assertEqual(self.summary("space")["dimension"], 3)
        self.assertEqual(self.summary("space")["points"], 96)
        self.assertAlmostEqual(self.summary("space")["stages"][0]["max_displacement"],
                               self.summary("plane")["stages"][0]["max_displacement"], delta=1e-12)

    def test_absorbing_sides_in_the_plane_in_space_and_in_revolution(self):
        # A falling column between sides that are let go: the plane one is the one in space times its thickness.
        def opened(text):
            text = replaced(text, "duration = 0.2\ndamping = 0.5", "duration = 0.01")
            for side in ("left", "right"):
                text = replaced(text, f'nodes = "{side}"\nfix = ["x"]',
                                f'nodes = "{side}"\nfix = ["x"]\nabsorbing = true\nfrom = "free"\nthickness = 10.0')
            # Mean dilatation is over the directions of the plane there, and over all three in space.
            text = replaced(text, "[[material]]", '[method]\nscheme = "report"\n\n[[material]]')
            return replaced(text, "[output]", '[[stage]]\nname = "free"\nduration = 0.3\n\n[output]')

        self.write("plane.toml", replaced(opened(COLUMN), "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -0.1]"))
        self.write("space.toml", replaced(opened(COLUMN_IN_SPACE), "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, 0.0, -0.1]"))
        for case in ("plane", "space"):
            self.scarp("run", f"{case}.toml", "--quiet", "--out", case)
        plane, space = self.history("plane"), self.history("space")
        for key in ("kinetic_energy", "work_boundary", "dissipation_absorbing", "stored_sides"):
            largest = max(abs(row[key]) for row in plane)
            self.assertGreater(largest, 0)
            for a, b in zip(plane, space):
                self.assertAlmostEqual(0.5 * a[key], b[key], delta=1e-10 * largest, msg=key)
        self.assertGreater(plane[-1]["dissipation_absorbing"], plane[0]["dissipation_absorbing"])
        # The side of a body of revolution has its radius times the plane one's area; it stays at rest where it was in balance.
        round_ = replaced(replaced(COLUMN, "[mesh]", "axisymmetric = true\n\n[mesh]"), 'nodes = "right"\nfix = ["x"]',
                          'nodes = "right"\nfix = ["x"]\nabsorbing = true\nfrom = "free"\nthickness = 10.0')
        round_ = replaced(round_, "[output]", '[[stage]]\nname = "free"\nduration = 0.3\n\n[output]')
        round_ = replaced(round_, "[[material]]", '[method]\nquadrature = "points"\n\n[[material]]')
        self.write("round.toml", round_)
        self.scarp("run", "round.toml", "--quiet")
        self.assertLess(self.history("round.out")[-1]["kinetic_energy"], 1e-20)
        self.write("gimp.toml", replaced(opened(COLUMN), "[method]", '[method]\nshape = "gimp"'))
        self.refused("check", "gimp.toml", parts=["linear shape functions only"])

    def test_the_profile_shares_out_the_whole(self):
        text = self.scarp("run", "column.toml", "--quiet", "--profile").stdout
        shares = [float(share) for share in re.findall(r" (\d+\.\d) %", text)]
        self.assertEqual(len(shares), 6, text)
        self.assertAlmostEqual(sum(shares), 100, delta=0.3)  # six roundings to 0.05

    def test_summary_holds_what_it_promises(self):
        self.scarp("run", "column.toml", "--threads", "1", "--quiet")
        summary = self.summary("column.out")  # where it goes without --out
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["points"], 48)
        self.assertEqual(summary["threads"], 1)
        self.assertGreater(summary["steps"], 10)
        self.assertGreater(summary["wall_seconds"], 0)
        self.assertAlmostEqual(summary["ns_per_point_step"],
                               1e9 * summary["wall_seconds"] / (summary["steps"] * 48), delta=1e-6 * 1e9)
        # Round-off of a sum of 48 masses.
        self.assertLess(abs(summary["mass_error"]), 1e-13)
        self.assertTrue(math.isfinite(summary["energy_error"]))
        [stage] = summary["stages"]
        self.assertEqual((stage["name"], stage["start"], stage["steps"]), ("settle", 0.0, summary["steps"]))
        self.assertAlmostEqual(stage["end"], 0.2, delta=1e-12)
        for key in ("unbalanced_ratio", "max_velocity", "max_displacement"):
            self.assertTrue(math.isfinite(stage[key]) and stage[key] >= 0, key)

    def test_warnings_are_said_and_kept(self):
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        self.assertEqual(self.summary("r")["warnings"], [])
        self.assertLess(self.summary("r")["largest_energy_error"], 0.01)
        # Elements of 0.5 m want points 0.25 m apart.
        for command in ("check", "run"):
            said = self.scarp(command, "column.toml", "--set", "region.0.spacing=0.3")
            self.assertIn('warning: column.toml:13:1: region "column" has fewer than two points', said.stderr)
            self.assertIn("give it spacing = 0.25 or less", said.stderr)
        kept = self.summary("column.out")["warnings"][0]  # sparse points also upset its books of energy
        self.assertIn("found spacing = 0.3 in elements of 0.5", kept)
        self.assertNotIn("warning", self.scarp("check", "column.toml").stderr)

    def test_history_and_frames_are_at_the_times_asked_for(self):
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        times = [row["time"] for row in self.history("r")]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])), "times do not rise")
        self.assertAlmostEqual(times[-1], 0.2, delta=1e-12)
        self.assertGreaterEqual(len(times), 20)
        frames = [name for name in contents(self.path("r")) if name.startswith("points_")]
        listed = read(self.path("r", "points.pvd")).decode()
        for name in frames:
            self.assertIn(f'"{name}"', listed)
        times = frame_times(listed)
        self.assertEqual(len(times), len(frames))
        self.assertEqual([round(t, 9) for t in times], [0, 0.05, 0.1, 0.15, 0.2])
        self.assertEqual(read(self.path("r", "case.toml")), COLUMN.encode())

    def test_rows_asked_for_more_often_than_there_are_steps(self):
        # A row at every step, as for 0, however many of its times lie within one.
        self.scarp("run", "column.toml", "--quiet", "--out", "every", "--set", "output.history=0.0")
        for history in ("1e-5", "1e-14", "1e-30"):
            with self.subTest(history=history):
                self.scarp("run", "column.toml", "--quiet", "--out", "r", "--set", f"output.history={history}")
                self.assertEqual(self.history("r"), self.history("every"))

    def test_output_goes_where_it_should(self):
        done = self.scarp("run", "column.toml", "--out", "deep/er")
        self.assertEqual(done.stdout, "results in deep/er\n")
        self.assertIn("settle", done.stderr)
        done = self.scarp("run", "column.toml", "--quiet", "--out", "quiet")
        self.assertEqual(done.stdout + done.stderr, "")
        self.assertEqual(sorted(os.listdir(self.folder)), ["column.toml", "deep", "quiet"])

    def test_a_new_run_replaces_the_old_results(self):
        self.scarp("run", "column.toml", "--quiet", "--out", "r", "--set", "output.every=0.01")
        more = contents(self.path("r"))
        self.write("r/notes.txt", "mine")
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        fewer = contents(self.path("r"))
        self.assertEqual(fewer.pop("notes.txt"), b"mine")
        self.assertLess(len(fewer), len(more))
        self.scarp("run", "column.toml", "--quiet", "--out", "fresh")
        self.assertEqual(set(fewer), set(contents(self.path("fresh"))))

    def test_the_kept_case_can_be_run_again_in_its_folder(self):
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        self.scarp("run", "r/case.toml", "--quiet", "--out", "r")
        self.assertEqual(read(self.path("r", "case.toml")), COLUMN.encode())

    def test_a_whole_region_may_be_removed(self):
        text = replaced(COLUMN, "[[boundary]]\nnodes = \"bottom\"", """[[region]]
name = "top"
material = "ground"
polygon = [[0.0, 3.0], [1.0, 3.0], [1.0, 3.5], [0.0, 3.5]]
spacing = 0.25
K0 = 0.3

[[boundary]]
nodes = "bottom\"""")
        polygon = "[[-1.0, 3.0], [2.0, 3.0], [2.0, 4.0], [-1.0, 4.0]]"
        text = replaced(text, "damping = 0.5", f"remove = {{ polygon = {polygon} }}")
        self.write("two.toml", text)
        self.scarp("run", "two.toml", "--quiet", "--out", "r")
        summary = self.summary("r")
        self.assertEqual((summary["points"], summary["removed_points"]), (48, 8))
        self.assertLess(abs(summary["mass_error"]), 1e-13)


class Threads(ProgramTest):
    def test_the_same_results_on_one_thread_and_on_two(self):
        self.write("slope.toml", SLOPE)
        results, summaries = [], []
        for threads in ("1", "2"):
            self.scarp("run", "slope.toml", "--quiet", "--threads", threads, "--out", threads)
            files = contents(self.path(threads))
            summaries.append(json.loads(files.pop("summary.json")))
            results.append(files)
        for summary, threads in zip(summaries, (1, 2)):
            self.assertEqual(summary.pop("threads"), threads)
            del summary["wall_seconds"], summary["ns_per_point_step"]
        self.expect_same(*results)
        self.assertEqual(summaries[0], summaries[1])
        # The test is worth something only where soil has failed: it has slid by half an element, and soil was removed.
        self.assertGreater(summaries[0]["points"], 1200)
        self.assertGreater(summaries[0]["removed_points"], 50)
        self.assertGreater(summaries[0]["stages"][-1]["max_displacement"], 0.5)
        self.assertGreaterEqual(len([name for name in results[0] if name.startswith("points_")]), 7)


if __name__ == "__main__":
    cases.main()
