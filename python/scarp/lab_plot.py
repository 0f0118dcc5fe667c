"""Draws the curve of a laboratory test: `scarp lab TEST.toml --plot curve.png`. Usage: lab_plot.py CURVE.csv PICTURE."""

import csv
import sys

import matplotlib.ticker
import numpy as np


def read_curve(path):
    """Columns by name; empty where the curve has no rows."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    table = np.array(rows[1:], dtype=float).reshape(-1, len(rows[0]))
    return {name: table[:, k] for k, name in enumerate(rows[0])}


def axial(curve):
    """The strain that a test is read against: ε_zz, or γ_zx where the specimen is sheared."""
    gamma = 2 * curve["eps_zx"]
    if np.ptp(gamma) > np.ptp(curve["eps_zz"]):
        return gamma, "γ$_{zx}$"
    return curve["eps_zz"], "ε$_{zz}$"


def signed_q(curve):
    """q with the sign of extension in a triaxial test, or the shear stress of a simple shear test."""
    if np.ptp(curve["eps_zx"]) > 0:
        return curve["sig_zx"], "τ$_{zx}$"
    lateral = 0.5 * (curve["sig_xx"] + curve["sig_yy"])
    return np.where(curve["sig_zz"] >= lateral, 1, -1) * curve["q"], "q (negative in extension)"


def draw(plt, curve):
    """Six panels: stress path, stress–strain, volume or pore pressure, compression, state, and substeps."""
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.5))
    strain, strain_name = axial(curve)
    q, q_name = signed_q(curve)
    undrained = np.any(curve["u"] != 0)
    first = [name for name in ("R", "R_b") if name in curve]

    def panel(axes, x, y, xlabel, ylabel, log=False):
        axes.plot(x, y, lw=1.2)
        axes.plot(x[:1], y[:1], "o", ms=4, color="k")
        axes.set_xlabel(xlabel, fontsize=9)
        axes.set_ylabel(ylabel, fontsize=9)
        axes.grid(alpha=0.3)
        if log and np.all(x > 0):
            axes.set_xscale("log")
            for axis in (axes.xaxis.set_major_formatter, axes.xaxis.set_minor_formatter):
                axis(matplotlib.ticker.FormatStrFormatter("%g"))
            axes.tick_params(axis="x", which="minor", labelsize=7)

    panel(panels[0, 0], curve["p"], q, "p", q_name)
    panel(panels[0, 1], strain, q, strain_name, q_name)
    panel(panels[0, 2], strain, curve["u"] if undrained else curve["eps_v"], strain_name, "u" if undrained else "ε$_v$")
    panel(panels[1, 0], curve["p"], curve["eps_v"], "p", "ε$_v$", log=True)
    panels[1, 0].invert_yaxis()
    for name in first:
        panels[1, 1].plot(strain, curve[name], lw=1.2, label=name)
    if "p_c" in curve:
        panels[1, 1].plot(strain, curve["p_c"] / curve["p_c"][0], lw=1.2, label="p$_c$ / p$_c$ at first")
    if panels[1, 1].lines:
        panels[1, 1].legend(fontsize=8)
    panels[1, 1].set_xlabel(strain_name, fontsize=9)
    panels[1, 1].grid(alpha=0.3)
    panel(panels[1, 2], np.arange(1, len(strain) + 1), curve["substeps"], "row", "substeps")
    figure.tight_layout()
    return figure


def main(arguments):
    curve_path, picture = arguments
    curve = read_curve(curve_path)
    if len(curve["p"]) == 0:
        print("scarp lab: the curve has no rows to draw", file=sys.stderr)
        return 3
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    try:
        draw(plt, curve).savefig(picture, dpi=120)
    except (OSError, ValueError) as problem:
        print(f"scarp lab: the picture {picture} cannot be written: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
