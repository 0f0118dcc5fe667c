"""Cases for the tests of the program, as text, and the program itself."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = None  # set by the script from its command line

# A column of rubber-like ground that stands on the bottom of the mesh, sixteen elements; it runs in milliseconds.
COLUMN = """title = "a column"

[mesh]
grid = { size = [1.0, 4.0], element = 0.5 }

[[material]]
name = "ground"
model = "linear-elastic"
density = 2.0
E = 1e4
nu = 0.25

[[region]]
name = "column"
material = "ground"
polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]]
spacing = 0.25
K0 = 0.333333333333333333

[[boundary]]
nodes = "bottom"
fix = ["x", "y"]

[[boundary]]
nodes = "left"
fix = ["x"]

[[boundary]]
nodes = "right"
fix = ["x"]

[[stage]]
name = "settle"
duration = 0.2
damping = 0.5

[output]
every = 0.05
history = 0.01
"""

# The same column half a metre thick in space, z up.
COLUMN_IN_SPACE = (
    COLUMN.replace("[mesh]", "dimension = 3\n\n[mesh]")
    .replace("size = [1.0, 4.0]", "size = [1.0, 0.5, 4.0]")
    .replace("spacing = 0.25", "y = [0.0, 0.5]\nspacing = 0.25")
    .replace('fix = ["x", "y"]', 'fix = ["x", "y", "z"]')
    .replace("[[stage]]", '[[boundary]]\nnodes = "front"\nfix = ["y"]\n\n[[boundary]]\nnodes = "back"\nfix = ["y"]\n\n[[stage]]')
)

# A slope of structured clay, 10 m high, on elements of 1 m with about 1,400 points; half a second under its own weight,
# then its toe is cut away and it fails.
SLOPE = """title = "a small slope that fails"

[mesh]
grid = { size = [35.0, 16.0], element = 1.0 }

[method]
flip = 0.95
safety = 0.4

[[material]]
name = "clay"
model = "subloading"
density = 1.8
kappa = 0.02
lambda = 0.12
nu = 0.3
p_e = 5.0
M = 1.0
M_c = 1.3
k = 0.78
alpha = 1.0
xi = 0.01
c_R = 60.0
c_beta = 5.0
c_b = 20.0
R_bf = 1.0
c_a = 3.0
p_atm = 101.325

[[region]]
name = "slope"
material = "clay"
polygon = [[0.0, 0.0], [35.0, 0.0], [35.0, 5.0], [22.0, 5.0], [12.0, 15.0], [0.0, 15.0]]
spacing = 0.5
K0 = 0.6
initial = { R_b = 3.0, OCR = 1.3, a = 0.5, beta = "isotropic" }

[[boundary]]
nodes = "bottom"
fix = ["x", "y"]

[[boundary]]
nodes = "left"
fix = ["x"]

[[boundary]]
nodes = "right"
fix = ["x"]
friction = 0.2

[[stage]]
name = "settle"
duration = 0.4
damping = 0.7

[[stage]]
name = "cut"
duration = 1.0
zero_displacement = true
remove = { polygon = [[16.0, 5.0], [35.0, 5.0], [35.0, 16.0], [16.0, 16.0]], lifts = 2, over = 0.2 }

[output]
every = 0.2
history = 0.02
"""

# Undrained shear of structured clay, a stage of three increments.
LAB = """[material]
model = "subloading"
kappa = 0.02
lambda = 0.12
nu = 0.3
p_e = 5.0
M = 1.0
M_c = 1.3
k = 0.78
alpha = 1.0
xi = 0.01
c_R = 60.0
c_beta = 5.0
c_b = 20.0
R_bf = 1.0
c_a = 3.0
p_atm = 101.325

[initial]
stress = [60.0, 60.0, 100.0, 0.0, 0.0, 0.0]
p_c = 250.0
R_b = 3.0

[[stage]]
type = "triaxial-undrained"
eps_a = 0.01
increments = 3
"""

LAB_COLUMNS = (
    "stage,time,eps_xx,eps_yy,eps_zz,eps_xy,eps_yz,eps_zx,sig_xx,sig_yy,sig_zz,sig_xy,sig_yz,sig_zx,p,q,theta,eps_v,eps_q,u,"
    "R,epsp_v,epsp_q,p_c,R_b,gap,beta_xx,beta_yy,beta_zz,beta_xy,beta_yz,beta_zx,a_xx,a_yy,a_zz,a_xy,a_yz,a_zx,"
    "epsp_xx,epsp_yy,epsp_zz,epsp_xy,epsp_yz,epsp_zx,substeps")


def replaced(text, old, new):
    """`text` with its only occurrence of `old` replaced."""
    assert text.count(old) == 1, f"{text.count(old)} times in the case: {old!r}"
    return text.replace(old, new)


def place(text, mark):
    """line:column of the only occurrence of `mark`."""
    assert text.count(mark) == 1, f"{text.count(mark)} times in the case: {mark!r}"
    before = text[: text.index(mark)]
    return f"{before.count(chr(10)) + 1}:{len(before) - (before.rfind(chr(10)) + 1) + 1}"


def contents(folder):
    """The bytes of every file below a folder but those that hold dates and times of the clock: run.log, provenance.json, checkpoints."""
    return {
        os.path.relpath(os.path.join(where, name), folder): read(os.path.join(where, name))
        for where, _, names in os.walk(folder)
        for name in names
        if name not in ("run.log", "provenance.json") and not name.endswith(".h5")
    }


def frame_times(collection):
    """The times in the text of a points.pvd, in its order."""
    return [float(text) for text in re.findall(r'timestep="([^"]*)"', collection)]


def read(path):
    with open(path, "rb") as file:
        return file.read()


class ProgramTest(unittest.TestCase):
    """A test with a temporary folder that is the program's working directory."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="scarp_test_")
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def scarp(self, *arguments, status=0, overwrite=True):
        """Runs the program to its end and demands its exit status."""
        # Most tests run one case after the other; what is there without the word is refused, has a test of its own.
        if arguments[:1] == ("run",) and overwrite:
            arguments = (*arguments, "--overwrite")
        # Two minutes are far beyond any of these runs; they only keep a program that hangs from holding up all tests.
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def expect_same(self, first, second):
        """Two folders hold the same files, to the last bit."""
        self.assertEqual(sorted(first), sorted(second))
        self.assertEqual([name for name in sorted(first) if first[name] != second[name]], [], "files that differ")

    def refused(self, *arguments, status=2, parts=()):
        """Runs the program, which must refuse with a message that holds all `parts`, and writes no results."""
        done = self.scarp(*arguments, status=status)
        self.assertTrue(done.stderr.startswith("scarp: "), done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertIn("\n  remedy: ", done.stderr)
        return done


def main():
    """The whole of a script: its first argument is the program, the others are unittest's."""
    global PROGRAM
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main(module="__main__")
