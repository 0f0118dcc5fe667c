"""Runs that are stopped and gone on with, and runs that start from another's state. Usage: resume_test.py PROGRAM [TEST ...]

Oracles: what docs/checkpoint.md promises; an undisturbed run. Stops at random moments, of every model: tests/faults.
"""

import json
import os
import shutil
import signal
import subprocess
import time

import cases
from cases import COLUMN, SLOPE, ProgramTest, contents, read, replaced

OF_THE_CLOCK = ("wall_seconds", "ns_per_point_step", "threads")
EVERY_STEP = "output.checkpoint={ steps = 1, keep = 1000 }"


def checkpoints(folder):
    return sorted(name for name in os.listdir(folder) if name.startswith("checkpoint_"))


class Resume(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("column.toml", COLUMN)
        self.scarp("run", "column.toml", "--quiet", "--out", "whole")

    def results(self, folder):
        """The files, the summary without what is of the clock."""
        files = contents(self.path(folder))
        summary = json.loads(files.pop("summary.json"))
        files.pop("case.toml")
        return files, {key: value for key, value in summary.items() if key not in OF_THE_CLOCK}

    def expect_whole(self, folder):
        (first, summary), (second, other) = self.results("whole"), self.results(folder)
        self.expect_same(first, second)
        self.assertEqual(summary, other)

    def stopped(self, folder="r", after=20, more=()):
        """A run as a crash after a step leaves it: its later checkpoints taken away, its files gone on beyond."""
        self.scarp("run", "column.toml", "--quiet", "--out", folder, "--set", EVERY_STEP, *more)
        for name in os.listdir(self.path(folder)):
            if name.startswith("stage_") or (name.startswith("checkpoint_") and int(name[11:21]) > after):
                os.remove(self.path(folder, name))
        return checkpoints(self.path(folder))

    def test_goes_on_to_the_same_end(self):
        self.stopped()
        self.write("r/points_00004.vtu.part", "half")
        done = self.scarp("resume", "r", "--threads", "2")
        self.assertIn("goes on from r/checkpoint_0000000020.h5", done.stderr)
        self.assertEqual(done.stdout, "results in r\n")
        self.expect_whole("r")
        self.assertNotIn("points_00004.vtu.part", os.listdir(self.path("r")))
        # Once more: there is nothing left to do.
        self.scarp("resume", "r/", "--quiet")
        self.expect_whole("r")

    def test_a_stopped_run_says_how_to_go_on(self):
        for which in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            self.write("long.toml", replaced(COLUMN, "duration = 0.2", "duration = 1e5"))
            shutil.rmtree(self.path("l"), ignore_errors=True)
            run = subprocess.Popen([cases.PROGRAM, "run", "long.toml", "--out", "l"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
            limit = time.monotonic() + 60
            while not os.path.exists(self.path("l", "points_00002.vtu")) and time.monotonic() < limit:
                time.sleep(0.01)
            run.send_signal(which)
            _, error = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 130, error)
            self.assertIn("go on with it: scarp resume l", error)
            # Interrupted again and again: it gets on.
            before = json.loads(read(self.path("l", "summary.json")))["steps"]
            run = subprocess.Popen([cases.PROGRAM, "resume", "l"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            run.send_signal(which)
            run.communicate(timeout=60)
            self.assertGreater(json.loads(read(self.path("l", "summary.json")))["steps"], before)

    def test_a_damaged_checkpoint_is_passed_over(self):
        names = self.stopped()
        with open(self.path("r", names[-1]), "r+b") as file:
            file.seek(20000)
            byte = file.read(1)
            file.seek(20000)
            file.write(bytes([byte[0] ^ 1]))
        with open(self.path("r", names[-2]), "r+b") as file:
            file.truncate(30000)
        done = self.scarp("resume", "r")
        self.assertIn("the checkpoint is damaged: its content is not what its seal says", done.stderr)
        self.assertIn("the checkpoint has no seal", done.stderr)
        self.assertIn("goes on from r/checkpoint_0000000018.h5", done.stderr)
        self.expect_whole("r")

    def test_when_no_checkpoint_is_good(self):
        for name in self.stopped():
            self.write(f"r/{name}", "no checkpoint")
        kept = contents(self.path("r"))
        self.refused("resume", "r", parts=["the checkpoint has no seal"])
        self.expect_same(kept, contents(self.path("r")))

    def test_before_the_first_checkpoint_a_run_starts_again(self):
        for name in self.stopped(more=["--set", "output.checkpoint.keep=1"]):
            os.remove(self.path("r", name))
        done = self.scarp("resume", "r")
        self.assertIn("r has no checkpoint yet: the run starts again", done.stderr)
        self.expect_whole("r")

    def test_what_cannot_be_gone_on_with(self):
        self.refused("resume", "nosuch", parts=["there is no run to go on with", "nosuch"])
        os.mkdir(self.path("empty"))
        self.refused("resume", "empty", parts=["there is no run to go on with", "empty"])
        self.stopped()
        kept = read(self.path("r", "case.toml"))
        self.write("r/case.toml", kept.replace(b"duration = 0.2", b"duration = 0.3"))
        self.refused("resume", "r", parts=["has been changed since the run began", "r/case.toml", "[start]"])
        self.write("r/case.toml", kept)
        history = read(self.path("r", "history.csv"))
        self.write("r/history.csv", history[:300])
        self.refused("resume", "r", parts=["is not what it was", "r/history.csv"])
        self.write("r/history.csv", history)
        frame = read(self.path("r", "points_00001.vtu"))
        os.remove(self.path("r", "points_00001.vtu"))
        self.refused("resume", "r", parts=["a frame of the run", "r/points_00001.vtu"])
        self.write("r/points_00001.vtu", frame)
        self.scarp("resume", "r", "--quiet")
        self.expect_whole("r")

    def test_an_edited_checkpoint_is_taken_when_one_says_so(self):
        try:
            import h5py
        except ImportError:
            self.skipTest("python3-h5py is not installed")
        [*_, last] = self.stopped()
        with h5py.File(self.path("r", last), "r+") as file:
            file["scarp/regions/0/points/velocity"][1, :] = -0.5
        for name in checkpoints(self.path("r"))[:-1]:
            os.remove(self.path("r", name))
        self.refused("resume", "r", "--quiet", parts=["the checkpoint has no seal", "--edited"])
        self.scarp("resume", "r", "--quiet", "--edited")
        self.assertNotEqual(self.results("r")[0]["history.csv"], self.results("whole")[0]["history.csv"])

    def test_results_are_not_overwritten_without_a_word(self):
        kept = contents(self.path("whole"))
        done = self.scarp("run", "column.toml", "--out", "whole", status=2, overwrite=False)
        for part in ("holds the results of an earlier run", "whole", "--overwrite", "scarp resume whole"):
            self.assertIn(part, done.stderr)
        self.expect_same(kept, contents(self.path("whole")))
        self.scarp("run", "column.toml", "--out", "whole", "--overwrite", overwrite=False)

    def test_keeps_as_many_as_asked_for(self):
        for setting, names in (("{ steps = 10 }", ["checkpoint_0000000040.h5", "checkpoint_0000000050.h5"]),
                               ("{ time = 0.1, every = 0, keep = 5 }", 3), ("{ every = 0 }", []),
                               ("{ every = 0, stages = false }", [])):
            self.scarp("run", "column.toml", "--quiet", "--out", "r", "--set", f"output.checkpoint={setting}")
            found = checkpoints(self.path("r"))
            self.assertEqual(found if isinstance(names, list) else len(found), names, setting)
            stages = [name for name in os.listdir(self.path("r")) if name.startswith("stage_")]
            self.assertEqual(len(stages), 0 if "stages" in setting else 1)

    def test_a_failed_run_leaves_its_state(self):
        self.write("fails.toml", replaced(COLUMN, "polygon = [[0.0, 0.0]", "velocity = [0.0, 60.0]\npolygon = [[0.0, 0.0]"))
        self.refused("run", "fails.toml", "--quiet", "--out", "f", status=3, parts=["has left the mesh"])
        self.assertIn("failed.h5", os.listdir(self.path("f")))
        self.assertIn("has left the mesh", read(self.path("f", "run.log")).decode())
        self.write("next.toml", '[start]\nfrom = "f/failed.h5"\n\n' + replaced(COLUMN, 'title = "a column"\n', ""))
        self.refused("run", "next.toml", parts=["the state of a computation that could not go on", "next.toml:1:1"])

    def test_the_record_of_a_run(self):
        self.stopped()
        self.scarp("resume", "r", "--quiet", "--threads", "1")
        runs = json.loads(read(self.path("r", "provenance.json")))["runs"]
        self.assertEqual([run["from_step"] for run in runs], [0, 20])
        self.assertIn("resume r --quiet --threads 1", runs[1]["command"])
        for run in runs:
            for key in ("date", "program", "host", "memory_free", "threads", "case_xxh128"):
                self.assertTrue(run[key], key)
            self.assertTrue(run["libraries"]["hdf5"])
        log = read(self.path("r", "run.log")).decode()
        self.assertEqual(log.count("stage 1/1 settle: over"), 2, log)


class Start(ProgramTest):
    """The ground is brought to rest once and cut many ways."""

    def setUp(self):
        super().setUp()
        self.write("rest.toml", SLOPE[: SLOPE.index('[[stage]]\nname = "cut"')] + "[output]\n")
        self.scarp("run", "rest.toml", "--quiet", "--out", "rest.out")
        settle = SLOPE[SLOPE.index('[[stage]]\nname = "settle"') : SLOPE.index('[[stage]]\nname = "cut"')]
        self.cut = replaced(SLOPE, settle, "")
        self.started = '[start]\nfrom = "rest.out"\n\n'

    def test_is_the_run_in_one(self):
        # Without clocks that are counted from the start of a stage elsewhere: the same steps, from the same state.
        self.write("slope.toml", SLOPE)
        self.write("cut.toml", "[start]\nfrom = \"rest.out\"\nstage = \"settle\"\n\n" + self.cut.replace('title = "a small slope that fails"\n', ""))
        self.scarp("run", "slope.toml", "--quiet", "--out", "one")
        self.scarp("run", "cut.toml", "--quiet", "--out", "two")
        frames = [sorted(name for name in os.listdir(self.path(folder)) if name.endswith(".vtu") and name != "mesh.vtu") for folder in ("one", "two")]
        self.assertEqual(json.loads(read(self.path("two", "summary.json")))["stages"][0]["start"], 0)
        moved = [json.loads(read(self.path(folder, "summary.json")))["stages"][-1] for folder in ("one", "two")]
        # Times differ by the round-off of where they count from, and the steps with them; a slope that fails makes more of that.
        for key in ("max_displacement", "moved_mass"):
            self.assertAlmostEqual(moved[1][key] / moved[0][key], 1, delta=1e-4, msg=key)
        self.assertGreater(len(frames[1]), 3)
        self.scarp("resume", "two", "--quiet")  # done

    def test_other_stages_and_constants(self):
        self.write("cut.toml", self.started + self.cut.replace('title = "a small slope that fails"\n', ""))
        self.scarp("run", "cut.toml", "--quiet", "--out", "a", "--set", "stage.cut.duration=0.2")
        self.scarp("run", "cut.toml", "--quiet", "--out", "b", "--set", "stage.cut.duration=0.2", "--set", "material.clay.c_b=40")
        first, second = (json.loads(read(self.path(folder, "summary.json"))) for folder in "ab")
        self.assertNotEqual(first["stages"][0]["max_displacement"], second["stages"][0]["max_displacement"])
        kept = read(self.path("a", "case.toml")).decode()
        self.assertIn('from = "../rest.out"', kept)
        self.scarp("run", "a/case.toml", "--quiet", "--out", "again")
        self.assertEqual(read(self.path("a", "history.csv")), read(self.path("again", "history.csv")))

    def test_what_does_not_fit(self):
        text = self.started + self.cut.replace('title = "a small slope that fails"\n', "")
        for change, parts in (
                (('from = "rest.out"', 'from = "nosuch"'), ["the results to start from are not there", "cut.toml:1:1"]),
                (('from = "rest.out"', 'from = "rest.out"\nstage = "sleep"'), ['no end of stage "sleep"', '"settle"', "cut.toml:3:"]),
                (("element = 1.0", "element = 0.5"), ["the mesh is not that of the run to start from"]),
                (('name = "slope"', 'name = "hill"'), ['region "hill"', '"slope" there']),
                (("spacing = 0.5", "spacing = 0.4"), ['region "slope" is not that', "its spacing, 0.5"]),
                (("[12.0, 15.0]", "[11.0, 15.0]"), ["its shape differs"]),
                (("OCR = 1.3", "OCR = 1.4"), ["its initial values differ"]),
                (("density = 1.8", "density = 1.9"), ["density 1.9 here, 1.8 there"]),
                (('model = "subloading"', 'model = "viscoplastic-subloading"\nmu = 10.0\nn = 10.0\nR_m = 1.5'), ['its model is "viscoplastic-subloading" here']),
                (("density = 1.8", "density = 1.8\nlength = 3.0"), ["softens over a length on one side only"])):
            with self.subTest(change=change):
                self.write("cut.toml", replaced(text, *change))
                self.refused("run", "cut.toml", "--quiet", "--out", "c", parts=parts)
                self.assertFalse(os.path.exists(self.path("c")))

    def test_two_regions_of_which_one_is_missing(self):
        two = replaced(SLOPE[: SLOPE.index('[[stage]]\nname = "cut"')], "[[boundary]]\nnodes = \"bottom\"",
                       '[[region]]\nname = "fill"\nmaterial = "clay"\npolygon = [[30.0, 5.0], [35.0, 5.0], [35.0, 6.0], [30.0, 6.0]]\nspacing = 0.5\n'
                       'K0 = 0.6\ninitial = { R_b = 3.0, OCR = 1.3, a = 0.5, beta = "isotropic" }\n\n[[boundary]]\nnodes = "bottom"')
        self.write("two.toml", two + "[output]\n")
        self.scarp("run", "two.toml", "--quiet", "--out", "rest.out")
        self.write("cut.toml", self.started + self.cut.replace('title = "a small slope that fails"\n', ""))
        self.refused("run", "cut.toml", parts=["more regions than the case"])
        shutil.rmtree(self.path("rest.out"))
        self.scarp("run", "rest.toml", "--quiet", "--out", "rest.out")
        self.write("cut.toml", self.started + two.replace('title = "a small slope that fails"\n', "") + "[output]\n")
        self.refused("run", "cut.toml", parts=["it has fewer regions"])


if __name__ == "__main__":
    cases.main()
