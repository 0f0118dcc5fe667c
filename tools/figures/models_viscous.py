"""The picture of viscoplastic-subloading, drawn by models.py."""

import tomllib

import numpy as np

from laboratory import ROOT, curve_of, titles

TEST = ROOT / "examples/lab/undrained_triaxial.toml"  # the clay and its initial state
VISCOUS = {"model": "viscoplastic-subloading", "mu": 100.0, "n": 1.0, "R_m": 1.5}
RATES = ((1e-2, "tab:red"), (1e-3, "tab:orange"), (1e-4, "tab:green"), (1e-5, "tab:blue"))


def decades(kind, last, parts=20):
    """Stages of a test whose time grows tenfold from one to the next, so that it can be drawn over log t."""
    return [{"type": kind, "duration": 9 * 10.0**k, "increments": parts} for k in range(-1, last)]


def draw_rates(one, clay, test, program):
    def shear(material, **more):
        stage = {"type": "triaxial-undrained", "eps_a": 0.15, "increments": 150, **more}
        return curve_of(program, material, test["stress"], stage, initial=test["state"])

    for rate, colour in RATES:
        curve = shear({**clay, **VISCOUS}, duration=0.15 / rate)
        one.plot(100 * curve["eps_zz"], curve["q"], color=colour, label=f"{rate:.0e} /s")
    curve = shear(clay)
    one.plot(100 * curve["eps_zz"], curve["q"], "k--", label="subloading")
    one.legend()


def after_loading(program, clay, test, loading, kind):
    """Time since the loading (1e-2 /s or so) was over, and the curve after it."""
    stages = [loading, *decades(kind, 4)]
    curve = curve_of(program, {**clay, **VISCOUS}, test["stress"], *stages, initial=test["state"], early=True)
    after = {name: values[curve["stage"] > 1] for name, values in curve.items()}
    return after["time"] - loading["duration"], after


def draw_viscous(program, plt):
    file = tomllib.loads(TEST.read_text(encoding="utf-8"))
    clay, state = file["material"], dict(file["initial"])
    test = {"stress": state.pop("stress")[:3], "state": state}
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.0))
    draw_rates(axes[0], clay, test, program)
    for q, colour in ((60.0, "tab:blue"), (80.0, "tab:green"), (90.0, "tab:orange"), (110.0, "tab:red")):
        loading = {"type": "triaxial-drained", "q": q, "increments": 50, "duration": 1.0}
        t, curve = after_loading(program, clay, test, loading, "creep")
        axes[1].semilogx(t, 100 * curve["eps_zz"], color=colour, label=f"q = {q:g} kPa")
    axes[1].set_ylim(0, 5)
    axes[1].legend()
    for eps, colour in ((0.002, "tab:blue"), (0.005, "tab:green"), (0.02, "tab:orange")):
        loading = {"type": "triaxial-undrained", "eps_a": eps, "increments": 50, "duration": eps / 1e-2}
        t, curve = after_loading(program, clay, test, loading, "relaxation")
        axes[2].semilogx(t, curve["q"], color=colour, label=f"ε$_{{zz}}$ = {100 * eps:g} %")
    axes[2].legend()
    titles(axes, ("undrained compression", "ε$_{zz}$ [%]", "q [kPa]"), ("creep, drained", "time [s]", "ε$_{zz}$ [%]"),
           ("relaxation, undrained", "time [s]", "q [kPa]"))
    return figure
