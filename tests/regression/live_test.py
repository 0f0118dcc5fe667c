"""A run while it lives: its folder, its end before its time, what a terminal shows of it. Usage: live_test.py PROGRAM [TEST ...]

Oracles: what README and run.hpp promise; one run against another.
"""

import csv
import fcntl
import io
import json
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import time

import cases
from cases import COLUMN, ProgramTest, contents, read, replaced


class Interruption(ProgramTest):
    def interrupt(self, which):
        # Long enough to be under way whenever the signal comes; it does not wait for the end.
        self.write("long.toml", replaced(COLUMN, "duration = 0.2", "duration = 1e5"))
        run = subprocess.Popen([cases.PROGRAM, "run", "long.toml", "--out", "r", "--threads", "1"], cwd=self.folder,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            limit = time.monotonic() + 60
            while not os.path.exists(self.path("r", "points_00003.vtu")) and time.monotonic() < limit:
                self.assertIsNone(run.poll(), "ended by itself")
                time.sleep(0.01)
            run.send_signal(which)
            out, err = run.communicate(timeout=60)
        finally:
            run.kill()
            run.wait()
        self.assertEqual(run.returncode, 130, err)
        self.assertIn(b"results in r", out)
        summary = json.loads(read(self.path("r", "summary.json")))
        self.assertEqual(summary["status"], "interrupted")
        self.assertEqual(summary["stages"][-1]["ended"], "interrupted")
        # All that was written is whole: every frame, all of them listed, and every row, the last at the run's end.
        listed = read(self.path("r", "points.pvd")).decode()
        self.assertTrue(listed.rstrip().endswith("</VTKFile>"))
        files = contents(self.path("r"))
        frames = sorted(name for name in files if name.startswith("points_"))
        self.assertGreaterEqual(len(frames), 4)
        for name in frames:
            self.assertIn(f'"{name}"', listed)
            self.assertTrue(files[name].rstrip().endswith(b"</VTKFile>"), name)
        self.assertFalse([name for name in files if name.endswith(".part")])
        rows = list(csv.reader(io.StringIO(files["history.csv"].decode())))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(float(rows[-1][0]), summary["time"])

    def test_from_the_keyboard(self):
        self.interrupt(signal.SIGINT)

    def test_by_a_request_to_end(self):
        self.interrupt(signal.SIGTERM)

    def test_a_disk_that_may_not_hold_the_results(self):
        # The results are those of a run on a larger disk, to which they may be taken half-way: not a warning of theirs.
        for duration, warned in ((1e13, True), (10.0, False)):
            self.write("long.toml", replaced(COLUMN, "duration = 0.2", f"duration = {duration}"))
            run = subprocess.Popen([cases.PROGRAM, "run", "long.toml", "--out", "r", "--threads", "1", "--overwrite"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            try:
                lines = []
                while (line := run.stderr.readline()) and "stage" not in line:
                    lines.append(line)
                run.send_signal(signal.SIGINT)
                run.communicate(timeout=60)
            finally:
                run.kill()
                run.wait()
            text = "".join(lines)
            self.assertEqual(bool(re.search(r"warning: the disk of r has \d.* free, and this run may write \d.* frames of .*B in all, checkpoints of .*B\): "
                                            "free some, enlarge every", text)), warned, text)
            self.assertNotIn("the disk of", "".join(json.loads(read(self.path("r", "summary.json")))["warnings"]))


class Folders(ProgramTest):
    """One run at a time in a folder, which keeps the case as it was run."""

    def test_a_second_run_is_refused_while_the_first_lives(self):
        self.write("long.toml", replaced(COLUMN, "duration = 0.2", "duration = 1e5"))
        self.write("short.toml", COLUMN)
        first = subprocess.Popen([cases.PROGRAM, "run", "long.toml", "--out", "r", "--threads", "1", "--quiet"],
                                 cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            limit = time.monotonic() + 60
            while not os.path.exists(self.path("r", "points_00001.vtu")) and time.monotonic() < limit:
                time.sleep(0.01)
            before = read(self.path("r", "case.toml"))
            self.refused("run", "short.toml", "--quiet", "--out", "r",
                         parts=["another run is writing into the folder", f"r (process {first.pid})", "--out"])
            self.assertEqual(read(self.path("r", "case.toml")), before)
            self.scarp("run", "short.toml", "--quiet", "--out", "other")
        finally:
            first.kill()  # without a word to anybody: its lock goes with it
            first.communicate()
        self.scarp("run", "short.toml", "--quiet", "--out", "r")
        self.assertEqual(json.loads(read(self.path("r", "summary.json")))["status"], "done")
        self.assertNotIn(".lock", os.listdir(self.path("r")))

    def test_the_case_as_it_was_run(self):
        self.write("column.toml", COLUMN)
        self.scarp("run", "column.toml", "--quiet", "--out", "a", "--set", "region.column.spacing=0.5", "--set",
                   "title=other")
        text = read(self.path("a", "case.toml")).decode()
        self.assertIn("--set region.column.spacing=0.5", text)
        self.scarp("run", "a/case.toml", "--quiet", "--out", "b")
        first, second = (contents(self.path(folder)) for folder in "ab")
        self.assertEqual(first["history.csv"], second["history.csv"])
        self.assertEqual(json.loads(second["summary.json"])["title"], "other")


class Terminal(ProgramTest):
    """What a user at a terminal sees of a run: one line that renews itself."""

    def follow(self, text, columns, until):
        """Runs the case at a terminal this wide until it has printed the pattern; all that it has printed."""
        self.write("seen.toml", text)
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        run = subprocess.Popen([cases.PROGRAM, "run", "seen.toml", "--out", "r", "--overwrite", "--threads", "1"], cwd=self.folder,
                               stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        printed = b""
        try:
            limit = time.monotonic() + 60
            while not re.search(until, printed) and time.monotonic() < limit:
                self.assertIsNone(run.poll(), printed)
                printed += os.read(ours, 1000)
        finally:
            run.kill()
            run.wait()
            os.close(ours)
        return printed.decode()

    def test_a_stage_that_ends_early_counts_as_done(self):
        # The first stage is at rest after one step of its thousand million seconds: they are no part of what is left.
        text = replaced(COLUMN, "damping = 0.5", "rest = { unbalanced = 10.0, kinetic = 10.0 }")
        text = replaced(text, "duration = 0.2", "duration = 1e9")
        text = replaced(text, "every = 0.05\nhistory = 0.01", "every = 0.0\nhistory = 1e3")
        text += '[[stage]]\nname = "after"\nduration = 1e4\n'
        self.assertIn("stage 2/2 after", self.follow(text, 200, until=rb" [1-9]\d? %, at most \d"))

    def test_the_line_fits_the_terminal(self):
        text = replaced(COLUMN, "duration = 0.2", "duration = 1e5").replace("settle", "Böschung im Ton")
        for columns in range(18, 40, 7):  # cuts at every place of the name's letters, one of which has two bytes
            with self.subTest(columns=columns):
                printed = self.follow(text, columns, until=rb"\r\x1b\[K[^\r]+\r")
                lines = printed.split("\r\x1b[K")[1:-1]
                self.assertTrue(lines)
                self.assertLess(max(len(line) for line in lines), columns)
                self.assertIn("stage 1/1 B", lines[0])


if __name__ == "__main__":
    cases.main()
