"""The built program seen from outside: exit statuses and messages. Usage: program_test.py PROGRAM [TEST ...]

Oracles: what README and run.hpp promise; the place of the damage in the text of a case.
"""

import json
import os
import pathlib
import re
import subprocess
import sys

import cases
from cases import COLUMN, LAB, LAB_COLUMNS, SLOPE, ProgramTest, contents, frame_times, place, read, replaced

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python", "scarp"))
import vtu  # noqa: E402  (the project's own reader of frames)


class Commands(ProgramTest):
    def test_check_describes_the_case(self):
        self.write("column.toml", COLUMN)
        text = self.scarp("check", "column.toml").stdout
        # 1 m x 4 m in elements of 0.5 m; 1 m x 3 m of soil in squares of 0.25 m, in 12 elements; 3 m2 of 2 Mg/m3.
        for part in ("column.toml: a column", "16 elements, 27 nodes", "48 points, area 3 m2, mass 6", 'stage "settle"',
                     "48 in 12 elements", 'boundary "bottom": 3 nodes, fixes x, y'):
            self.assertIn(part, text)
        self.assertEqual(os.listdir(self.folder), ["column.toml"])

    def test_check_says_what_a_run_takes(self):
        self.write("column.toml", COLUMN)
        text = self.scarp("check", "column.toml").stdout
        # Frames at 0, 0.05, 0.10, 0.15 and 0.2 s. The steps are those that the stage's line counts; their rate is that of this moment.
        self.assertRegex(text, r"memory: about \d+ kB \(grid \d+ bytes, points \d+ kB, the copy that is a checkpoint [0-9.]+ kB\), where [0-9.]+ [GMT]B are free")
        self.assertRegex(text, r"output: about 5 frames of at most \d+ kB, \d+ kB in all")
        steps = re.search(r"about (\d+) steps", text)[1]
        self.assertRegex(text, rf"wall time: about [0-9.e-]+ s \({steps} steps of [0-9.e-]+ s, as the first ones take with \d+ threads\)")
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        frames = [name for name in os.listdir(self.path("r")) if name.endswith(".vtu") and name != "mesh.vtu"]
        self.assertEqual(len(frame_times(read(self.path("r", "points.pvd")).decode())), 5, frames)

    def test_more_points_than_fit_are_counted_in_bytes(self):
        self.write("column.toml", COLUMN)  # 3 m2 in squares of 1.73 um
        self.refused("check", "column.toml", "--set", "region.column.spacing=1.7320508e-6",
                     parts=["column.toml:13:1: the points do not fit into memory", "TB (grid", "about 1e+12 points"])

    def warnings(self, text, *options):
        self.write("warns.toml", text)
        for command in (["check"], ["run", "--quiet", "--overwrite", "--out", "r"]):
            yield self.scarp(*command, "warns.toml", *options).stderr

    def test_a_removal_that_hits_nothing(self):
        idle = replaced(COLUMN, "damping = 0.5", "damping = 0.5\nremove = { polygon = [[0.0, 3.1], [1.0, 3.1], [1.0, 4.0], [0.0, 4.0]] }")
        for warned in self.warnings(idle):
            self.assertIn(f"warns.toml:{place(idle, '[[stage]]')}: the removal of stage \"settle\" takes nothing away; found no point", warned)
        for warned in self.warnings(idle.replace("3.1]", "2.5]")):
            self.assertNotIn("removal", warned)

    def test_very_many_frames(self):
        self.write("column.toml", COLUMN)
        text = self.scarp("check", "column.toml", "--set", "output.every=1e-6").stderr
        self.assertIn("very many frames; found every = 1e-06: about 2e+05 frames, 2.", text)
        self.assertNotIn("frames", self.scarp("check", "column.toml").stderr)

    def test_points_that_were_lost_are_told_at_the_end(self):
        text = replaced(COLUMN, "[[material]]", '[method]\nleaving = "remove"\nlargest_energy_error = 0\n\n[[material]]')
        text = replaced(text, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, 60.0]")
        self.write("column.toml", text)
        self.assertRegex(self.scarp("run", "column.toml", "--quiet", "--out", "r").stderr, r"warning: \d+ points left the mesh and were lost")
        self.assertIn("left the mesh", "".join(json.loads(read(self.path("r", "summary.json")))["warnings"]))

    def test_output_that_cannot_be_written(self):
        self.write("column.toml", COLUMN)
        self.write("test.toml", LAB)
        for words in (["check", "column.toml"], ["lab", "test.toml"], ["models"]):
            with self.subTest(words=words), open("/dev/full", "w") as full:
                done = subprocess.run([cases.PROGRAM, *words], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
                self.assertEqual(done.returncode, 3)
                self.assertIn("the standard output cannot be written", done.stderr)

    def test_files_without_an_end(self):
        self.refused("check", "/dev/zero", parts=["/dev/zero: the case file is very long; found more than 10 MB"])

    def test_nothing_to_resume(self):
        self.refused("resume", "nosuch", parts=["there is no run to go on with; found nosuch, which is no folder"])
        os.mkdir(self.path("empty"))
        self.refused("resume", "empty", parts=["there is no run to go on with; found no empty/case.toml"])

    def test_check_takes_overrides(self):
        self.write("column.toml", COLUMN)
        text = self.scarp("check", "column.toml", "--set", "region.column.spacing=0.5", "--set", "title=other").stdout
        self.assertIn("12 points", text)
        self.assertIn("column.toml: other", text)
        self.refused("check", "column.toml", "--set", "region.column.spacng=0.5",
                     parts=["--set region.column.spacng=0.5: ", "no key spacng", "did you mean spacing?"])

    def test_models(self):
        text = self.scarp("models").stdout
        self.assertIn("linear-elastic", text)
        self.assertIn("subloading", text)

    def test_one_model(self):
        text = self.scarp("models", "subloading").stdout
        lines = {line.split()[0]: line for line in text.splitlines() if line.startswith("  ")}
        for key in ("kappa", "lambda", "nu", "M_c", "c_b", "p_atm", "R_b", "OCR", "beta", "p_c"):
            self.assertIn(key, lines)
        self.assertIn("required", lines["kappa"])
        self.assertIn("Poisson's ratio", lines["nu"])

    def test_no_such_model(self):
        self.refused("models", "nosuch", parts=["there is no such model", '"nosuch"', "linear-elastic, subloading"])

    def test_help_and_version(self):
        text = self.scarp("--help").stdout
        for command in ("run", "check", "lab", "models", "plot"):
            self.assertIn(command, text)
        self.assertIn("--threads", self.scarp("run", "--help").stdout)
        self.assertIn("--panels", self.scarp("plot", "--help").stdout)
        self.assertRegex(self.scarp("--version").stdout, r"^scarp \d+\.\d+\.\d+ \(x86-64.*\)\n$")

    def test_wrong_command_lines(self):
        self.write("column.toml", COLUMN)
        for words in ([], ["walk"], ["run"], ["check"], ["plot"], ["run", "column.toml", "--thread", "1"],
                      ["run", "column.toml", "--threads", "0"], ["run", "column.toml", "--threads", "two"],
                      ["run", "column.toml", "other.toml"], ["check", "column.toml", "--set"]):
            with self.subTest(words=words):
                self.assertGreater(len(self.scarp(*words, status=2).stderr), 10)
        self.assertEqual(os.listdir(self.folder), ["column.toml"])


class Laboratory(ProgramTest):
    def rows(self, text):
        """The curve's rows as dictionaries; its header is the documented one."""
        lines = text.splitlines()
        self.assertEqual(lines[0], LAB_COLUMNS)
        return [dict(zip(LAB_COLUMNS.split(","), map(float, line.split(",")))) for line in lines[1:]]

    def test_a_curve_on_standard_output_and_in_a_file(self):
        self.write("test.toml", LAB)
        done = self.scarp("lab", "test.toml")
        rows = self.rows(done.stdout)
        self.assertEqual([row["stage"] for row in rows], [1, 1, 1])
        self.assertAlmostEqual(rows[-1]["eps_zz"], 0.01, 15)
        for row in rows:  # undrained: no volume change, and the cell pressure is constant
            self.assertAlmostEqual(row["eps_v"], 0, 12)
            self.assertAlmostEqual(row["u"], 60 - row["sig_xx"], 9)
        self.assertEqual(self.scarp("lab", "test.toml", "--out", "curve.csv").stdout, "")
        self.assertEqual(read(self.path("curve.csv")).decode(), done.stdout)

    def test_a_strain_path_gives_a_row_for_each_row(self):
        self.write("strains.csv", "eps_xx,eps_yy,eps_zz,eps_xy,eps_yz,eps_zx\n0,0,0,0,0,0\n0,0,0.001,0,0,0\n0,0,0.002,0,0,0.001\n")
        self.write("test.toml", LAB[: LAB.index("[[stage]]")] + '[[stage]]\ntype = "strain-path"\nfile = "strains.csv"\n')
        rows = self.rows(self.scarp("lab", "test.toml").stdout)
        self.assertEqual([(row["eps_zz"], row["eps_zx"]) for row in rows], [(0, 0), (0.001, 0), (0.002, 0.001)])
        self.assertEqual(rows[0]["sig_zz"], 100)

    def test_a_picture_alone(self):
        self.write("test.toml", LAB)
        self.assertEqual(self.scarp("lab", "test.toml", "--plot", "curve.png").stdout, "")
        self.assertEqual(read(self.path("curve.png"))[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(sorted(os.listdir(self.folder)), ["curve.png", "test.toml"])

    def test_a_limit_point_keeps_the_rows_before_it(self):
        self.write("test.toml", replaced(LAB, "eps_a = 0.01\nincrements = 3", "q = 1000.0\nincrements = 100"))
        done = self.refused("lab", "test.toml", "--out", "curve.csv", status=3,
                            parts=["stage 1 (triaxial-undrained) stops in increment", "limit point", "q = "])
        rows = self.rows(read(self.path("curve.csv")).decode())
        self.assertIn(f"increment {len(rows) + 1} of 100", done.stderr)
        self.assertGreater(len(rows), 3)

    def test_bad_input_touches_nothing(self):
        bad = replaced(LAB, '"triaxial-undrained"', '"triaxial"')
        self.write("test.toml", bad)
        self.write("curve.csv", "mine")
        self.refused("lab", "test.toml", "--out", "curve.csv",
                     parts=["test.toml:" + place(bad, 'type = "triaxial"'), "no such type of stage", "triaxial-drained"])
        self.assertEqual(read(self.path("curve.csv")), b"mine")

    def test_its_own_files_are_not_overwritten(self):
        self.write("test.toml", LAB)
        for option in ("--out", "--plot"):
            self.refused("lab", "test.toml", option, "./test.toml", parts=["overwrite", option])
        self.assertEqual(read(self.path("test.toml")).decode(), LAB)

    def test_overrides(self):
        self.write("test.toml", LAB)
        rows = self.rows(self.scarp("lab", "test.toml", "--set", "stage.0.increments=5").stdout)
        self.assertEqual(len(rows), 5)


class BadInput(ProgramTest):
    """Exit status 2, a message with place, value and remedy; results of an earlier run stay as they are."""

    def setUp(self):
        super().setUp()
        self.write("column.toml", COLUMN)
        self.scarp("run", "column.toml", "--quiet", "--out", "r")
        self.before = contents(self.path("r"))

    def refuse(self, text, *parts, options=()):
        self.write("bad.toml", text)
        for command in (["check"], ["run", "--quiet", "--out", "r"]):
            with self.subTest(command=command[0]):
                self.refused(*command, "bad.toml", *options, parts=parts)
                self.expect_same(self.before, contents(self.path("r")))
                self.assertEqual(sorted(os.listdir(self.folder)), self.files())

    def files(self):
        mesh = ["mesh.msh"] if os.path.exists(self.path("mesh.msh")) else []
        return ["bad.toml", "column.toml", *mesh, "r"]

    def test_values(self):
        for old, new, mark, *parts in [
            ("E = 1e4", "E = -1e4", "E = -1e4", "E must satisfy 0 < E", "found -10000", "Young's modulus"),
            ("spacing = 0.25", "spacng = 0.25", "[[region]]", "lacks the key spacing", "add the distance"),
            ("damping = 0.5", "dampng = 0.5", "dampng", "no key dampng", "found the number 0.5",
             "did you mean damping?"),
            ('material = "ground"', 'material = "sand"', 'material = "sand"', "no such material", '"sand"', '"ground"'),
            ("duration = 0.2", "duration = nan", "duration", "duration is finite", "found nan", "a finite number"),
            ("[1.0, 3.0], [0.0, 3.0]", "[0.0, 3.0], [1.0, 3.0]", "[1.0, 3.0]", "cross or touch", "in order around"),
            ('title = "a column"', 'title = "a column', "title", "not TOML", "toml.io"),
        ]:
            with self.subTest(new=new):
                text = replaced(COLUMN, old, new)
                # Of the parser's own messages the line is ours to know, the column not.
                where = place(text, mark)
                where = where.split(":")[0] if "not TOML" in parts else where
                self.refuse(text, f"bad.toml:{where}:", *parts)

    def test_what_shows_only_with_mesh_and_points(self):
        high = replaced(COLUMN, "size = [1.0, 4.0]", "size = [1.0, 2.0]")
        self.refuse(high, f"bad.toml:{place(high, '[[region]]')}:", "does not hold the soil", '"column"',
                    "a point at (")
        walls = replaced(COLUMN, 'nodes = "left"', 'nodes = "west"')
        self.refuse(walls, f"bad.toml:{place(walls, '[[boundary]]' + chr(10) + 'nodes = ' + chr(34) + 'west')}:",
                    "no such node set", '"west"', '"left"')
        huge = replaced(COLUMN, "element = 0.5", "elements = [100000, 100000]")
        self.refuse(huge, f"bad.toml:{place(huge, '[mesh]')}:", "at most 2000000000 elements", "take larger elements")
        line = replaced(COLUMN, 'nodes = "left"', "line = [[0.1, 0.0], [0.1, 4.0]]")
        self.refuse(line, f"bad.toml:{place(line, '[[boundary]]' + chr(10) + 'line')}:", "no node", "(0.1, 0)", "edges")
        inner = replaced(line, "[mesh]", '[method]\nshape = "b-spline"\n\n[mesh]').replace("0.1, ", "0.25, ")
        self.refuse(inner, f"bad.toml:{place(inner, '[[boundary]]' + chr(10) + 'line')}:", "B-splines", "side of the grid",
                    "(0.25, 0) to (0.25, 4)", 'shape = "linear"')
        twice = COLUMN + '[[region]]\nname = "other"\nmaterial = "ground"\nspacing = 0.25\nK0 = 1.0\n' \
            "polygon = [[0.0, 2.0], [1.0, 2.0], [1.0, 4.0], [0.0, 4.0]]\n"
        self.refuse(twice, 'regions "other" and "column" overlap', "share no more than their edges")
        clay = SLOPE.replace("OCR = 1.3", "OCR = 0.5")
        self.refuse(clay, f"bad.toml:{place(clay, '[[region]]')}:", "OCR >= 1", "found 0.5")

    def test_regions_that_points_cannot_fill(self):
        # Points so many that no machine holds them, and so many that their number overflows.
        for spacing in ("1e-7", "1e-300"):
            with self.subTest(spacing=spacing):
                text = replaced(COLUMN, "spacing = 0.25", f"spacing = {spacing}")
                self.refuse(text, "bad.toml:", "points")

    def test_meshes(self):
        with_file = replaced(COLUMN, "grid = { size = [1.0, 4.0], element = 0.5 }", 'file = "mesh.msh"')
        self.refuse(with_file, f"bad.toml:{place(with_file, 'file =')}:", "the mesh file is not there", "mesh.msh")
        mesh = ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 4 0\n4 0 4 0\n$EndNodes\n"
                "$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n")
        for cut in (0, 10, mesh.index("3 1 4 0"), mesh.index("$Elements"), mesh.index("1 3 2") + 9):
            with self.subTest(cut=cut):
                self.write("mesh.msh", mesh[:cut])
                self.refuse(with_file, "mesh.msh:")
        self.write("mesh.msh", bytes(range(256)) * 8)
        self.refuse(with_file, "mesh.msh:")
        self.write("mesh.msh", mesh.replace("3 1 4 0", "3 1 2 0").replace("4 0 4 0", "4 0 2 0"))
        self.refuse(with_file, "does not hold the soil")
        self.write("mesh.msh", mesh)  # whole, it serves
        shape = replaced(with_file, "[mesh]", '[method]\nshape = "gimp"\n\n[mesh]')
        self.refuse(shape, f"bad.toml:{place(shape, 'shape =')}:", "need a mesh that is a grid", '"gimp"', "leave shape out")
        self.write("good.toml", with_file)
        self.assertIn("1 elements, 4 nodes", self.scarp("check", "good.toml").stdout)

    def test_files_that_cannot_be_read(self):
        for name in ("nosuch.toml", "r"):
            with self.subTest(name=name):
                self.refused("run", name, "--quiet", "--out", "r", parts=["cannot be read", name])
        self.expect_same(self.before, contents(self.path("r")))

    def test_folders_that_are_not_ours(self):
        self.refused("run", "column.toml", "--quiet", "--out", "column.toml", parts=["but a file has that name"])
        os.mkdir(self.path("theirs"))
        self.write("theirs/history.csv", "1,2,3\n")
        self.refused("run", "column.toml", "--quiet", "--out", "theirs", parts=["no summary.json of an earlier run"])
        self.assertEqual(contents(self.path("theirs")), {"history.csv": b"1,2,3\n"})
        self.assertEqual(read(self.path("column.toml")), COLUMN.encode())


class Failures(ProgramTest):
    """Exit status 3: the message says what, where and what to do; what there is up to there stays for a look."""

    def expect_failure(self, text, *parts):
        self.write("fails.toml", text)
        self.refused("run", "fails.toml", "--quiet", "--out", "r", status=3, parts=parts)
        summary = json.loads(read(self.path("r", "summary.json")))
        self.assertEqual(summary["status"], "failed")
        for part in parts:
            self.assertIn(part, summary["message"])
        self.assertIn("remedy", summary["message"])
        listed = read(self.path("r", "points.pvd")).decode()
        self.assertAlmostEqual(frame_times(listed)[-1], summary["time"], delta=1e-12)
        return summary

    def test_ground_that_does_not_come_to_rest(self):
        # Undamped, the column keeps swinging about the state that K0 off by far leaves to find.
        text = replaced(COLUMN, "K0 = 0.333333333333333333", "K0 = 0.9")
        text = replaced(text, "damping = 0.5", "rest = { unbalanced = 1e-9 }")
        text = replaced(text, "nodes = \"right\"", "nodes = \"top\"")  # free on its right
        summary = self.expect_failure(text, 'does not come to rest in stage "settle" within 0.2 s',
                                      "unbalanced force ratio", "asked: 1e-09")
        self.assertEqual(summary["stages"][0]["ended"], "duration")
        self.assertAlmostEqual(summary["stages"][0]["end"], 0.2, delta=1e-12)

    def test_the_same_where_rest_is_not_required(self):
        text = replaced(COLUMN, "damping = 0.5", "rest = { unbalanced = 1e-300, required = false }")
        self.write("fine.toml", text)
        self.scarp("run", "fine.toml", "--quiet")

    def test_books_of_energy_that_do_not_close(self):
        # No step of finite length closes them to a millionth.
        text = replaced(COLUMN, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -0.1]")
        strict = replaced(text, "[[material]]", "[method]\nlargest_energy_error = 1e-6\n\n[[material]]")
        summary = self.expect_failure(strict, "the books of energy do not close at t = 0.", "largest_energy_error: 1e-06", "safety")
        self.assertEqual(summary["stages"][0]["ended"], "failed")
        self.scarp("run", "fails.toml", "--quiet", "--out", "r", "--set", "method.largest_energy_error=0")
        self.assertGreater(json.loads(read(self.path("r", "summary.json")))["largest_energy_error"], 1e-6)

    def test_a_removal_that_leaves_nothing(self):
        polygon = "[[-1.0, -1.0], [2.0, -1.0], [2.0, 5.0], [-1.0, 5.0]]"
        self.expect_failure(replaced(COLUMN, "damping = 0.5", f"remove = {{ polygon = {polygon} }}"), "leaves no soil")

    def test_a_point_that_leaves_the_mesh(self):
        # Nothing carries the column: it sinks through the bottom, slowed by the damping.
        text = replaced(COLUMN, 'nodes = "bottom"\nfix = ["x", "y"]', 'nodes = "bottom"\nfix = ["x"]')
        text = replaced(text, "duration = 0.2", "duration = 1.0")
        summary = self.expect_failure(text, 'point 0 of region "column" has left the mesh at t = 0.', "s, step ", "leaving")
        # The last frame is of the failed step, in place and time.
        self.assertIn(f"at t = {summary['time']:.6g} s, step {summary['steps'] + 1}", summary["message"])
        last = vtu.read_vtu(vtu.read_pvd(pathlib.Path(self.path("r", "points.pvd")))[-1][1])
        self.assertLess(last["Points"][0, 1], 0)
        self.scarp("run", "fails.toml", "--quiet", "--out", "r", "--set", "method.leaving=remove", "--set",
                   "stage.settle.duration=0.4")
        summary = json.loads(read(self.path("r", "summary.json")))
        self.assertGreater(summary["removed_points"], 0)

    def test_a_first_step_that_fails_has_its_frame(self):
        text = replaced(COLUMN, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -1e6]")
        summary = self.expect_failure(replaced(text, 'nodes = "bottom"\nfix = ["x", "y"]', 'nodes = "bottom"\nfix = ["x"]'), "has left the mesh", "step 1")
        frames = vtu.read_pvd(pathlib.Path(self.path("r", "points.pvd")))
        self.assertEqual([time for time, _ in frames], [0, summary["time"]])
        self.assertLess(vtu.read_vtu(frames[-1][1])["Points"][0, 1], 0)


if __name__ == "__main__":
    cases.main()
