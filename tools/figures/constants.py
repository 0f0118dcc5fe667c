"""Small multiples: what each constant of the subloading model does to an undrained triaxial test.

Draws docs/models/figures/constants.png, cyclic.png and structure.png from `scarp lab --set`.
"""

import numpy as np

from laboratory import ROOT, arguments, lab, pyplot

TEST = ROOT / "examples/lab/undrained_triaxial.toml"
OUT = ROOT / "docs/models/figures"

# key, symbol, low, standard, high; the standard is that of the test file.
CONSTANTS = [
    ("kappa", "κ̄", 0.01, 0.02, 0.04), ("lambda", "λ̄", 0.08, 0.12, 0.20),
    ("nu", "ν", 0.1, 0.3, 0.45), ("p_e", "p$_e$ [kPa]", 0.0, 5.0, 30.0),
    ("M", "M", 0.8, 1.0, 1.2), ("M_c", "M$_c$", 1.1, 1.3, 1.5),
    ("k", "k", 0.78, 0.78, 0.95), ("alpha", "α", 0.8, 1.0, 1.2),
    ("xi", "ξ", 0.0, 0.01, 0.1), ("c_R", "c$_R$", 20.0, 60.0, 300.0),
    ("c_beta", "c$_β$", 0.0, 5.0, 30.0), ("c_b", "c$_b$", 5.0, 20.0, 80.0),
    ("R_bf", "R$_{bf}$", 1.0, 1.0, 2.0), ("c_a", "c$_a$", 0.0, 3.0, 30.0)]
THIRD = {"k": 0.70, "R_bf": 1.5}  # where the standard is at a bound, or the middle lies elsewhere
COLOURS = ("tab:blue", "k", "tab:red")


def values(key, low, standard, high):
    """Low, standard, high; R_bf has its standard at the bound and two above."""
    if key == "R_bf":
        return (standard, THIRD[key], high), ("k", "tab:orange", "tab:red")
    return (THIRD.get(key, low), standard, high), COLOURS


def signed_q(curve):
    return curve["sig_zz"] - curve["sig_xx"]


def start(curve, p=220 / 3, q=40.0):
    """Strain, p and q with the initial stress in front."""
    return (np.insert(100 * curve["eps_zz"], 0, 0), np.insert(curve["p"], 0, p), np.insert(signed_q(curve), 0, q))


def draw_constants(program, plt):
    figure, axes = plt.subplots(7, 4, figsize=(10, 14))
    for n, (key, symbol, low, standard, high) in enumerate(CONSTANTS):
        left, right = axes[n // 2, 2 * (n % 2)], axes[n // 2, 2 * (n % 2) + 1]
        extension = key == "k"
        strain = -0.2 if extension else 0.2
        for value, colour in zip(*values(key, low, standard, high)):
            curve, _ = lab(program, TEST, f"material.{key}={value}", f"stage.0.eps_a={strain}",
                              "stage.0.increments=200")
            eps, p, q = start(curve)
            width = 1.6 if value == standard else 1.0
            left.plot(eps, q, color=colour, lw=width, label=f"{value:g}", zorder=2 if value == standard else 3)
            right.plot(p, q, color=colour, lw=width, zorder=2 if value == standard else 3)
            ends = f"{key} {value}: peak q {np.abs(q).max():.1f} at {eps[np.abs(q).argmax()]:.1f} %, " \
                   f"end p {p[-1]:.1f} q {q[-1]:.1f}, q(0.5 %) {np.interp(0.5, abs(eps), q):.1f}, " \
                   f"least and largest p {p.min():.1f} {p.max():.1f}"
            print(ends)
        left.set_title(symbol + (" (extension)" if extension else ""), loc="left", fontweight="bold")
        right.legend(*left.get_legend_handles_labels(), loc="lower right", handlelength=1.2)
        left.set_ylim((-90, 50) if extension else (35, 140 if key == "R_bf" else 125))
        right.set_ylim(left.get_ylim())
        right.set_xlim(40, 130)
        left.set_xlabel("ε$_a$ [%]", labelpad=1)
        right.set_xlabel("p [kPa]", labelpad=1)
        left.set_ylabel("q [kPa]", labelpad=1)
        right.tick_params(labelleft=False)
    figure.tight_layout(h_pad=0.5, w_pad=0.4)
    figure.savefig(OUT / "constants.png", dpi=90)


def draw_cyclic(program, plt):
    """What c_a does under cycles of stress."""
    test = ROOT / "examples/lab/cyclic_triaxial.toml"
    figure, axes = plt.subplots(2, 3, figsize=(9.5, 5.2), sharex="row", sharey="row")
    for column, c_a in enumerate((0.0, 3.0, 30.0)):
        curve, _ = lab(program, test, f"material.c_a={c_a}", "stage.0.cycles=30")
        eps, p, q = start(curve, 80.0, 0.0)
        axes[0, column].plot(p, q, lw=0.5)
        axes[1, column].plot(eps, q, lw=0.5)
        axes[0, column].set_title(f"c$_a$ = {c_a:g}")
        axes[0, column].set_xlabel("p [kPa]")
        axes[1, column].set_xlabel("ε$_a$ [%]")
        print("cyclic", c_a, len(p), p[-1], eps[-1], curve["R_b"][-1])
    for row in axes:
        row[0].set_ylabel("q [kPa]")
    figure.tight_layout()
    figure.savefig(OUT / "cyclic.png", dpi=75)


def draw_structure(program, plt):
    """Isotropic compression of the clay with and without bonds, and with bonds that break more slowly."""
    test = ROOT / "examples/lab/isotropic.toml"
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    cases = [("R$_b$ = 3, c$_b$ = 20", ()), ("c$_b$ = 5", ("material.c_b=5.0",)),
             ("c$_b$ = 80", ("material.c_b=80.0",)), ("R$_{bf}$ = 2", ("material.R_bf=2.0",)),
             ("without bonds", ("initial.R_b=1.0", "initial.p_c=83.3333333"))]
    for n, (name, changes) in enumerate(cases):
        curve, _ = lab(program, test, "stage.0.p=2000", "stage.0.increments=300", "stage.1.p=2000.0001",
                       "stage.2.p=2000.0002", *changes)
        first = curve["stage"] == 1
        style = {"color": "k" if n == 0 else f"C{n - 1}", "lw": 1.6 if n == 0 else 1.0, "ls": "--" if n == 4 else "-"}
        axes[0].semilogx(np.insert(curve["p"][first], 0, 80), np.insert(100 * curve["eps_v"][first], 0, 0), label=name,
                         **style)
        axes[1].semilogx(curve["p"][first], curve["R_b"][first], **style)
        print("structure", name, curve["eps_v"][first][-1], curve["R_b"][first][-1])
    axes[0].invert_yaxis()
    axes[0].legend()
    axes[0].set_ylabel("ε$_v$ [%]")
    axes[1].set_ylabel("R$_b$")
    for one in axes:
        one.set_xlabel("p [kPa]")
        one.set_xticks([100, 200, 500, 1000, 2000])
        one.xaxis.set_major_formatter("{x:g}")
        one.xaxis.set_minor_formatter("")
    figure.tight_layout()
    figure.savefig(OUT / "structure.png", dpi=90)


def main():
    program = arguments(__doc__).parse_args().program
    OUT.mkdir(parents=True, exist_ok=True)
    plt = pyplot()
    draw_constants(program, plt)
    draw_cyclic(program, plt)
    draw_structure(program, plt)


if __name__ == "__main__":
    main()
