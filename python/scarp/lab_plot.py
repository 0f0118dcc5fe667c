"""Draws the curve of a laboratory test: `scarp lab TEST.toml --plot curve.png`. Usage: lab_plot.py CURVE.csv PICTURE."""

import csv
import sys

import matplotlib.ticker
import numpy as np

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")


def read_curve(path):
    """Columns by name; empty where the curve has no rows."""
    with open(path, newline="", encoding="utf-8-sig") as file:
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
    if np.ptp(curve["eps_zx"]) > 1e-6 * strain_scale(curve):
        return curve["sig_zx"], "τ$_{zx}$"
    lateral = 0.5 * (curve["sig_xx"] + curve["sig_yy"])
    return np.where(curve["sig_zz"] >= lateral, 1, -1) * curve["q"], "q (negative in extension)"


def stress_scale(curve):
    return max(np.abs(curve["sig_" + c]).max() for c in COMPONENTS)


def strain_scale(curve):
    return max(np.abs(curve["eps_" + c]).max() for c in COMPONENTS)


def at_least(axis_limits, set_limits, least):
    """What is held is held to rounding: an axis shorter than `least` would show the rounding as a curve."""
    low, high = axis_limits
    if abs(high - low) < least:
        set_limits(0.5 * (low + high - least), 0.5 * (low + high + least))


def panel(axes, x, y, xlabel, ylabel, least):
    """A curve with its first row as a dot; `least` are the shortest axes along x and y."""
    axes.plot(x, y, lw=1.2)
    axes.plot(x[:1], y[:1], "o", ms=4, color="k")
    axes.set_xlabel(xlabel, fontsize=9)
    axes.set_ylabel(ylabel, fontsize=9)
    axes.grid(alpha=0.3)
    axes.ticklabel_format(useOffset=False)
    at_least(axes.get_xlim(), axes.set_xlim, least[0])
    at_least(axes.get_ylim(), axes.set_ylim, least[1])


def compression(axes, curve, least):
    """Volume over p, on a logarithmic axis where p changes more than twofold."""
    p = curve["p"]
    panel(axes, p, curve["eps_v"], "p", "ε$_v$", least)
    axes.invert_yaxis()
    if p.min() > 0 and p.max() > 2 * p.min():
        axes.set_xscale("log")
        axes.set_xlim(p.min() / 1.1, p.max() * 1.1)
        few = p.max() < 50 * p.min()
        axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5) if few else (1,)))
        axes.xaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
        axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())


def draw_state(axes, curve, strain, strain_name):
    """The scalars of the state that the model has, over the strain."""
    for name in ("R", "R_b"):
        if name in curve:
            axes.plot(strain, curve[name], lw=1.2, label=name)
    if "p_c" in curve:
        axes.plot(strain, curve["p_c"] / curve["p_c"][0], lw=1.2, label="p$_c$ / p$_c$ at first")
    if axes.lines:
        axes.legend(fontsize=8)
    else:
        axes.plot(strain, curve["eps_q"], lw=1.2)
        axes.set_ylabel("ε$_q$", fontsize=9)
    axes.set_xlabel(strain_name, fontsize=9)
    axes.grid(alpha=0.3)


def draw(plt, curve):
    """Six panels: stress path, stress–strain, volume or pore pressure, compression (mean stress where the volume is
    held), state, and substeps."""
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.5))
    strain, strain_name = axial(curve)
    q, q_name = signed_q(curve)
    undrained = np.any(curve["u"] != 0)
    stress, size = 0.02 * stress_scale(curve), 1e-3 * strain_scale(curve)
    panel(panels[0, 0], curve["p"], q, "p", q_name, (stress, stress))
    panel(panels[0, 1], strain, q, strain_name, q_name, (size, stress))
    if undrained:
        panel(panels[0, 2], strain, curve["u"], strain_name, "u", (size, stress))
    else:
        panel(panels[0, 2], strain, curve["eps_v"], strain_name, "ε$_v$", (size, 0.1 * strain_scale(curve)))
    if np.ptp(curve["eps_v"]) < 1e-3 * strain_scale(curve):
        panel(panels[1, 0], strain, curve["p"], strain_name, "p", (size, stress))
    else:
        compression(panels[1, 0], curve, (stress, size))
    draw_state(panels[1, 1], curve, strain, strain_name)
    panel(panels[1, 2], np.arange(1, len(strain) + 1), curve["substeps"], "row", "substeps", (1, 1))
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
