"""What the figures share: running `scarp lab` and reading its curve."""

import argparse
import csv
import io
import pathlib
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")


def arguments(description):
    """The one argument that each script takes: the program."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/bin/scarp"), help="(build/bin/scarp)")
    return parser


def columns(text):
    """Columns of a curve by name."""
    rows = list(csv.reader(io.StringIO(text)))
    table = np.array(rows[1:], dtype=float).reshape(-1, len(rows[0]))
    return {name: table[:, k] for k, name in enumerate(rows[0])}


def lab(program, test, *changes):
    """The curve of a test file with `changes` (texts key=value) and what the program says where it stops early."""
    command = [program, "lab", str(test)]
    for change in changes:
        command += ["--set", change]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not done.stdout:
        raise SystemExit(done.stderr)
    return columns(done.stdout), done.stderr.strip()


def pyplot():
    """Matplotlib with the look that all figures have."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 8, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1,
                         "axes.titlesize": 9, "legend.fontsize": 7})
    return plt
