#!/usr/bin/env python3
"""Runs small cases with each level of the processor that a packaged scarp has a library for, and compares the results.

    tools/check_package.py build-package/scarp-0.1.0-Linux.tar.gz

The loader is told which features of the processor to leave alone (GLIBC_TUNABLES), and takes the library that it would
take on a processor without them. Every field of the last frame must agree to 1e-9 of the largest value of the field:
the levels round differently (fused products and sums, order of sums over lanes), by some 1e-16 in each operation, and
nothing in the 64 and 275 steps of these cases makes more of that than a factor of a million.
"""

import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "python" / "scarp"), str(ROOT / "tests" / "regression")]
import vtu
from cases import COLUMN, SLOPE, replaced

# Features that the loader is to do without, and the level that is left.
LEVELS = [("", "x86-64-v4"), ("-AVX512F", "x86-64-v3"), ("-AVX512F,-AVX2", "x86-64")]
TOLERANCE = 1e-9

# Of the program's own tests: the elastic column, and the slope of structured clay before its cut, for longer. Neither is at rest under local
# damping, which acts against the sign of a velocity: where that is a rounding error, the levels differ by far more.
MOVING = replaced(COLUMN, "spacing = 0.25", "spacing = 0.25\nvelocity = [0.0, -0.1]")
UNCUT = replaced(SLOPE[: SLOPE.index('[[stage]]\nname = "cut"')], "duration = 0.4\ndamping = 0.7", "duration = 1.2")
CASES = {"column": MOVING, "slope": UNCUT}


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
    """What the program calls itself, and the last frame of each case, computed without some features."""
    environment = dict(os.environ)
    if without:
        environment["GLIBC_TUNABLES"] = f"glibc.cpu.hwcaps={without}"
    version = subprocess.run([program, "--version"], env=environment, check=True, capture_output=True, text=True).stdout
    if version.split("(")[1].split(",")[0].rstrip(")\n") != level:
        sys.exit(f"expected the level {level} without \"{without}\", found {version.strip()}")
    frames = {}
    for name in CASES:
        out = folder / level / name
        subprocess.run([program, "run", folder / f"{name}.toml", "--quiet", "--out", out], env=environment, check=True,
                       capture_output=True)
        frames[name] = vtu.read_vtu(vtu.read_pvd(str(out / "points.pvd"))[-1][1])
    return version.strip(), frames


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
        for case, text in CASES.items():
            (folder / f"{case}.toml").write_text(text, encoding="utf-8")
        first = None
        for without, level in levels_here():
            version, frames = run(program, folder, without, level)
            if first is None:
                first = frames
                print(f"{version}: {' and '.join(str(len(frame['Points'])) for frame in frames.values())} points")
                continue
            for case, frame in frames.items():
                worst, field = difference(first[case], frame)
                print(f"{version}: {case} differs by {worst:.1e} at most ({field or 'nowhere'})")
                if not worst <= TOLERANCE:
                    sys.exit(f"more than {TOLERANCE:g}")


if __name__ == "__main__":
    main()
