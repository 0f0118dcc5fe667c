#!/usr/bin/env python3
"""Runs a small case with each level of the processor that a packaged scarp has a library for, and compares the results.

    tools/check_package.py build-package/scarp-0.1.0-Linux.tar.gz

The loader is told which features of the processor to leave alone (GLIBC_TUNABLES), and takes the library that it would
take on a processor without them. Every field of the last frame must agree to 1e-9 of the largest value of the field:
the levels round differently (fused products and sums, order of sums over lanes), by some 1e-16 in each operation, and
nothing in the 274 steps of this case makes more of that than a factor of a million.
"""

import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python" / "scarp"))
import vtu

# Features that the loader is to do without, and the level that is left.
LEVELS = [("", "x86-64-v4"), ("-AVX512F", "x86-64-v3"), ("-AVX512F,-AVX2", "x86-64")]
TOLERANCE = 1e-9

# Structured clay and an elastic block beside it on a grid, settling.
CASE = """title = "levels"
[mesh]
grid = { size = [8.0, 4.0], element = 0.5 }
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
alpha = 0.9
xi = 0.01
c_R = 60.0
c_beta = 5.0
c_b = 20.0
R_bf = 1.0
c_a = 3.0
p_atm = 101.325
[[material]]
name = "rock"
model = "linear-elastic"
density = 2.0
E = 2e4
nu = 0.25
[[region]]
name = "clay"
material = "clay"
polygon = [[0, 0], [4, 0], [4, 2], [0, 3]]
spacing = 0.2
K0 = 0.6
initial = { R_b = 3.0, OCR = 1.6, a = 0.5, beta = "isotropic" }
[[region]]
name = "rock"
material = "rock"
polygon = [[4, 0], [8, 0], [8, 1], [4, 2]]
spacing = 0.2
K0 = 0.5
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
duration = 0.5
damping = 0.3
"""


def features_here():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("flags"):
                return set(line.split(":", 1)[1].split())
    return set()


def levels_here():
    """Those of LEVELS that this processor can run."""
    features = features_here()
    if not {"avx2", "fma", "bmi2"} <= features:
        return LEVELS[2:]
    return LEVELS if {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"} <= features else LEVELS[1:]


def run(program, folder, without, level):
    """The last frame of the case, computed without some features."""
    environment = dict(os.environ)
    if without:
        environment["GLIBC_TUNABLES"] = f"glibc.cpu.hwcaps={without}"
    version = subprocess.run([program, "--version"], env=environment, check=True, capture_output=True, text=True).stdout
    if version.split("(")[1].split(",")[0].rstrip(")\n") != level:
        sys.exit(f"expected the level {level} without \"{without}\", found {version.strip()}")
    out = folder / level
    subprocess.run([program, "run", folder / "case.toml", "--quiet", "--out", out], env=environment, check=True,
                   capture_output=True)
    return version.strip(), vtu.read_vtu(vtu.read_pvd(str(out / "points.pvd"))[-1][1])


def difference(one, other):
    """The largest over the fields: in parts of the field's largest value; where counts differ at all, infinite."""
    worst = (0.0, "")
    for name, values in one.items():
        if values.dtype.kind != "f":
            found = 0.0 if name == "substeps" or np.array_equal(values, other[name]) else np.inf
        else:
            scale = np.nanmax(np.abs(values), initial=0.0)
            found = np.nanmax(np.abs(values - other[name]), initial=0.0) / scale if scale > 0 else 0.0
        worst = max(worst, (float(found), name))
    return worst


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        with tarfile.open(sys.argv[1]) as archive:
            archive.extractall(folder)
        (program,) = folder.glob("**/bin/scarp")
        (folder / "case.toml").write_text(CASE, encoding="utf-8")
        first = None
        for without, level in levels_here():
            version, frame = run(program, folder, without, level)
            if first is None:
                first = frame
                print(f"{version}: {len(frame['Points'])} points")
                continue
            worst, field = difference(first, frame)
            print(f"{version}: differs by {worst:.1e} at most ({field or 'nowhere'})")
            if not worst <= TOLERANCE:
                sys.exit(f"more than {TOLERANCE:g}")


if __name__ == "__main__":
    main()
