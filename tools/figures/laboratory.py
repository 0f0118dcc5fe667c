"""What the figures share: running `scarp lab` and reading its curve."""

import argparse
import csv
import io
import json
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")
DOT = {"ls": "none", "marker": "o", "ms": 3.5, "mfc": "none", "color": "k", "zorder": 5}  # a closed form


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


def toml(table):
    return [f"{key} = {json.dumps(value)}" for key, value in table.items()]


def curve_of(program, material, stress, *stages, initial=None, path=None, early=False):
    """The curve of one test from tables of its file: normal stresses, stages; `path` holds six columns of strain for a
    strain path. `early` allows a test that stops early."""
    lines = ["[material]", *toml(material), "[initial]", *toml({"stress": [*map(float, stress), 0.0, 0.0, 0.0]}),
             *toml(initial or {}), "[integration]", "tolerance = 1e-8"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for stage in stages:
            if path is not None:
                stage = {**stage, "file": "path.csv"}
                np.savetxt(folder / "path.csv", np.array([path[c] for c in COMPONENTS]).T, delimiter=",")
            lines += ["[[stage]]", *toml(stage)]
        test = folder / "test.toml"
        test.write_text("\n".join(lines) + "\n", encoding="utf-8")
        curve, says = lab(program, test)
    if says and not early:
        raise SystemExit(says)
    return curve


def pyplot():
    """Matplotlib with the look that all figures have."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 8, "axes.grid": True, "grid.alpha": 0.3, "lines.linewidth": 1.1,
                         "axes.titlesize": 9, "legend.fontsize": 7})
    return plt


def titles(axes, *names):
    """Panel by panel: title, what is along x, what is along y."""
    for one, (name, x, y) in zip(np.ravel(axes), names):
        one.set_title(name, loc="left")
        one.set_xlabel(x)
        one.set_ylabel(y)
