"""What grids take of memory, from outside. Usage: memory_test.py PROGRAM [TEST ...]"""

import os
import re
import resource
import subprocess
import sys
import time

import cases
from cases import COLUMN, ProgramTest, replaced

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python", "scarp"))
import vtu  # noqa: E402  (the project's own reader of frames)

GRID = "grid = { size = [1.0, 4.0], element = 0.5 }"


def with_grid(elements):
    """The column of 1 m x 3 m in the corner of a grid of squares of 0.5 m."""
    text = replaced(COLUMN, GRID, f"grid = {{ size = [{elements / 2}, {elements / 2}], element = 0.5 }}")
    return replaced(text, "duration = 0.2", "duration = 0.001")


class Memory(ProgramTest):
    def limited(self, limit, *arguments):
        """Runs the program with so many bytes of address space; returns its end and its largest memory [bytes]."""
        def set_limit():
            if limit:
                resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        def child():
            process = subprocess.Popen([cases.PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       text=True, preexec_fn=set_limit)
            out, error = process.stdout.read(), process.stderr.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            process.stdout.close()
            process.stderr.close()
            return process.returncode, out, error, 1024 * usage.ru_maxrss
        return child()

    def test_a_grid_that_does_not_fit_is_refused_before_it_is_made(self):
        self.write("large.toml", with_grid(10000))
        status, _, error, memory = self.limited(1_000_000_000, "check", "large.toml")
        self.assertEqual(status, 2, error)
        for part in ("large.toml:", "the grid does not fit into memory", "of address space", "ulimit -v", "remedy: take larger elements"):
            self.assertIn(part, error)
        self.assertLess(memory, 50e6)

    def test_points_that_do_not_fit_are_refused(self):
        self.write("many.toml", replaced(COLUMN, "spacing = 0.25", "spacing = 0.00025"))
        status, _, error, memory = self.limited(4_000_000_000, "check", "many.toml")
        self.assertEqual(status, 2, error)
        for part in ("many.toml:", "the points do not fit into memory", "remedy: take a larger spacing"):
            self.assertIn(part, error)
        self.assertLess(memory, 50e6)

    def test_what_is_said_is_what_is_taken(self):
        # Between two sizes, so that the program itself and its points drop out. Elements without soil take nothing, nodes of the left and
        # right side, which are held, a page each: 8 kB for one more row of 1500 elements.
        needs, takes = [], []
        for elements in (1000, 4000):
            self.write("grid.toml", with_grid(elements))
            needs.append(elements * elements)
            status, _, error, memory = self.limited(None, "run", "grid.toml", "--quiet", "--out", f"r{elements}")
            self.assertEqual(status, 0, error)
            takes.append(memory)
        of_element = (takes[1] - takes[0]) / (needs[1] - needs[0])
        self.assertLess(of_element, 4)
        # The said, where the memory is there and the address space is not.
        self.write("grid.toml", with_grid(10000))
        status, _, error, _ = self.limited(2_000_000_000, "check", "grid.toml")
        self.assertEqual(status, 2, error)
        said = float(re.search(r"found ([0-9.]+) GB of address space", error)[1])
        self.assertAlmostEqual(said / (1e8 * 35e-9), 1, delta=0.1)

    def test_a_hundred_million_elements_without_soil_cost_nothing(self):
        self.write("grid.toml", with_grid(10000))
        start = time.monotonic()
        status, _, error, memory = self.limited(None, "run", "grid.toml", "--quiet", "--out", "r")
        self.assertEqual(status, 0, error)
        self.assertLess(memory, 300e6)
        self.assertLess(time.monotonic() - start, 10)  # 0.03 s on a machine that does nothing else

    def test_more_elements_than_numbers_are_refused(self):
        self.write("grid.toml", with_grid(50000))
        status, _, error, memory = self.limited(None, "check", "grid.toml")
        self.assertEqual(status, 2, error)
        for part in ("grid.toml:3:", "at most 2000000000 elements and as many nodes", "32 bits", "50000 x 50000", "remedy: take larger elements"):
            self.assertIn(part, error)
        self.assertLess(memory, 50e6)

    def test_a_large_grid_is_shown_by_its_frame(self):
        self.write("grid.toml", with_grid(1500))
        self.limited(None, "run", "grid.toml", "--quiet", "--out", "r")
        points = vtu.read_vtu(self.path("r", "mesh.vtu"))["Points"]
        self.assertEqual(sorted(map(tuple, points[:, :2])), [(0, 0), (0, 750), (750, 0), (750, 750)])


if __name__ == "__main__":
    cases.main()
