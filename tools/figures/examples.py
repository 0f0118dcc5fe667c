"""Draws one picture for each test of examples/lab, beside it."""

import tomllib

import numpy as np

from laboratory import COMPONENTS, ROOT, arguments, lab, pyplot

FOLDER = ROOT / "examples/lab"

# Quantities to draw by name: how the curve gives them, and what the axis says.
QUANTITIES = {
    "p": (lambda c: c["p"], "p [kPa]"),
    "log p": (lambda c: c["p"], "p [kPa]"),
    "log sig_a": (lambda c: c["sig_zz"], "σ$_{zz}$ [kPa]"),
    "sig_r": (lambda c: c["sig_xx"], "σ$_{xx}$ [kPa]"),
    "sig_yy": (lambda c: c["sig_yy"], "σ$_{yy}$ [kPa]"),
    "sig_a": (lambda c: c["sig_zz"], "σ$_{zz}$ [kPa]"),
    "q": (lambda c: c["sig_zz"] - c["sig_xx"], "q = σ$_{zz}$ − σ$_{xx}$ [kPa]"),
    "tau": (lambda c: c["sig_zx"], "τ$_{zx}$ [kPa]"),
    "tau_yz": (lambda c: c["sig_yz"], "τ$_{yz}$ [kPa]"),
    "eps_a": (lambda c: 100 * c["eps_zz"], "ε$_{zz}$ [%]"),
    "eps_v": (lambda c: 100 * c["eps_v"], "ε$_v$ [%]"),
    "gamma": (lambda c: 200 * c["eps_zx"], "γ$_{zx}$ [%]"),
    "gamma_yz": (lambda c: 200 * c["eps_yz"], "γ$_{yz}$ [%]"),
    "u": (lambda c: c["u"], "u [kPa]"),
    "R_b": (lambda c: c["R_b"], "R$_b$"),
    "R": (lambda c: c["R"], "R"),
    "row": (lambda c: np.arange(len(c["p"])), "increment"),
}

PANELS = {
    "isotropic": [("log p", "-eps_v"), ("p", "R_b"), ("p", "R")],
    "oedometer": [("log sig_a", "-eps_v"), ("sig_a", "sig_r"), ("sig_a", "R_b")],
    "undrained_triaxial": [("p", "q"), ("eps_a", "q"), ("eps_a", "u")],
    "drained_triaxial_compression": [("p", "q"), ("eps_a", "q"), ("eps_a", "-eps_v")],
    "drained_triaxial_extension": [("p", "q"), ("eps_a", "q"), ("eps_a", "-eps_v")],
    "cyclic_simple_shear": [("sig_a", "tau"), ("gamma", "tau"), ("row", "u")],
    "cyclic_triaxial": [("p", "q"), ("eps_a", "q"), ("row", "u")],
    "strain_path": [("gamma_yz", "gamma"), ("tau_yz", "tau"), ("p", "tau")],
    "constraints": [("eps_a", "q"), ("eps_a", "sig_yy"), ("eps_a", "-eps_v")],
}


def with_start(curve, stress):
    """The curve with the initial stress as a first row; other state keeps its first value there."""
    start = {name: 0.0 for name in curve if name.startswith("eps")} | {"u": 0.0}
    start |= {"sig_" + c: s for c, s in zip(COMPONENTS, stress)} | {"p": sum(stress[:3]) / 3}
    return {name: np.insert(values, 0, start.get(name, values[0])) for name, values in curve.items()}


def panel(axes, curve, x, y):
    down = y.startswith("-")
    (of_x, x_name), (of_y, y_name) = QUANTITIES[x], QUANTITIES[y.lstrip("-")]
    xs, ys = of_x(curve), of_y(curve)
    axes.plot(xs, ys, lw=0.8 if len(xs) < 700 else 0.4)
    axes.plot(xs[:1], ys[:1], "ko", ms=3)
    axes.set_xlabel(x_name)
    axes.set_ylabel(y_name)
    if x.startswith("log"):
        axes.set_xscale("log")
        axes.set_xticks([50, 100, 200, 500, 1000, 2000][: 6 if xs.max() > 1900 else 5])
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter("")
    if down:
        axes.invert_yaxis()


def main():
    program = arguments(__doc__).parse_args().program
    plt = pyplot()
    for name, panels in PANELS.items():
        test = FOLDER / f"{name}.toml"
        settings = tomllib.loads(test.read_text(encoding="utf-8"))
        curve, says = lab(program, test)
        if says:
            raise SystemExit(f"{name}: {says}")
        curve = with_start(curve, settings["initial"]["stress"])
        figure, axes = plt.subplots(1, 3, figsize=(9, 2.8))
        for one, (x, y) in zip(axes, panels):
            panel(one, curve, x, y)
        figure.tight_layout()
        figure.savefig(FOLDER / f"{name}.png", dpi=90 if len(curve["p"]) < 2000 else 72)
        plt.close(figure)


if __name__ == "__main__":
    main()
