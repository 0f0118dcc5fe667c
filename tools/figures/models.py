"""A picture from `scarp lab` for each model's page: docs/models/figures/<model>.png. Dots are closed forms.

Subloading has its own script, constants.py. Stresses in kPa, strains in percent, compression positive.
"""

import numpy as np

from laboratory import COMPONENTS, DOT, ROOT, arguments, curve_of, pyplot, titles
from models_friction import draw_friction
from models_viscous import draw_viscous

OUT = ROOT / "docs/models/figures"


def draw_linear_elastic(program, plt):
    """Triaxial and one-dimensional compression for three Poisson's ratios."""
    figure, axes = plt.subplots(1, 3, figsize=(9, 2.8))
    E, p = 1e4, 100.0
    for nu, colour in ((0.0, "tab:blue"), (0.25, "k"), (0.45, "tab:red")):
        material = {"model": "linear-elastic", "E": E, "nu": nu}
        drained = curve_of(program, material, [p, p, p], {"type": "triaxial-drained", "eps_a": 0.02})
        eps = 100 * drained["eps_zz"]
        axes[0].plot(eps, drained["q"], color=colour, lw=3 - 2 * nu)
        axes[1].plot(eps, 100 * drained["eps_v"], color=colour, label=f"ν = {nu:g}")
        some = np.linspace(0.2, 2, 6)
        axes[0].plot(some, E * some / 100, **DOT)
        axes[1].plot(some, (1 - 2 * nu) * some, **DOT)
        K0 = nu / (1 - nu)
        confined = curve_of(program, material, [p, p, p], {"type": "oedometer", "sig_a": 400.0})
        axes[2].plot(confined["sig_zz"], confined["sig_xx"], color=colour)
        some = np.linspace(p, 400, 6)
        axes[2].plot(some, p + K0 * (some - p), **DOT)
    axes[1].legend()
    titles(axes, ("triaxial compression, drained", "ε$_{zz}$ [%]", "q [kPa]"),
           ("its volume", "ε$_{zz}$ [%]", "ε$_v$ [%]"),
           ("one-dimensional compression", "σ$_{zz}$ [kPa]", "σ$_{xx}$ [kPa]"))
    return figure


def simple_shear(program, material, gamma):
    """Cauchy stress, tension positive, in simple shear to γ (displacement along x grows with z). The laboratory does not
    turn, so it is followed in the frame that spins with the material (by γ/2) and turned back."""
    zero = 0 * gamma
    eps = dict.fromkeys(COMPONENTS, zero) | {"xx": (1 - np.cos(gamma)) / 2, "zz": -(1 - np.cos(gamma)) / 2,
                                            "zx": -np.sin(gamma) / 2}
    curve = curve_of(program, material, [0.0, 0.0, 0.0], {"type": "strain-path"}, path=eps)
    local = -np.array([[curve["sig_xx"], curve["sig_zx"]], [curve["sig_zx"], curve["sig_zz"]]])
    c, s = np.cos(gamma / 2), np.sin(gamma / 2)
    turn = np.array([[c, s], [-s, c]])
    return np.einsum("ijn,jkn,lkn->iln", turn, local, turn)


def uniaxial(stretch, E, nu):
    """Axial Cauchy stress of the neo-Hookean law, sides free: the lateral stretch² by Newton's method."""
    lam, mu = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
    b = np.ones_like(stretch)
    for _ in range(60):
        b = b - (lam * np.log(stretch * b) + mu * (b - 1)) / (lam / b + mu)
    J = stretch * b
    return (lam * np.log(J) + mu * (stretch**2 - 1)) / J


def draw_neo_hookean(program, plt):
    """Beside linear elasticity at large strain: a free bar and simple shear."""
    figure, axes = plt.subplots(1, 3, figsize=(9, 2.8))
    E, nu = 1.0, 0.3
    G = E / (2 * (1 + nu))
    gamma = np.linspace(0.01, 3, 300)
    for model, colour in (("neo-hookean", "tab:blue"), ("linear-elastic", "tab:orange")):
        material = {"model": model, "E": E, "nu": nu}
        for end in (np.log(2.0), np.log(0.4)):
            bar = curve_of(program, material, [0.0, 0.0, 0.0], {"type": "triaxial-drained", "eps_a": -end})
            axes[0].plot(np.exp(-bar["eps_zz"]), -bar["sig_zz"] / E, color=colour, label=model if end > 0 else None)
        sigma = simple_shear(program, material, gamma)
        axes[1].plot(gamma, sigma[0, 1] / G, color=colour)
        axes[2].plot(gamma, (sigma[0, 0] - sigma[1, 1]) / G, color=colour)
    stretch = np.linspace(0.4, 2, 9)
    some = np.linspace(0.3, 3, 8)
    for one, x, exact in ((axes[0], stretch, (uniaxial(stretch, E, nu), np.log(stretch))),
                          (axes[1], some, (some, np.sin(some))), (axes[2], some, (some**2, 2 * (1 - np.cos(some))))):
        for y in exact:
            one.plot(x, y, **DOT)
    axes[0].legend()
    titles(axes, ("bar, sides free", "length / natural length", "tension / E"),
           ("simple shear", "γ", "τ / G"), ("simple shear: normal stresses", "γ", "(σ$_{xx}$ − σ$_{zz}$) / G, tension"))
    return figure


CLAY = {"model": "modified-cam-clay", "kappa": 0.02, "lambda": 0.12, "nu": 0.3, "p_e": 0.0, "M": 1.2,
        "p_atm": 101.325}


def undrained_closed(OCR, p0, eta):
    """p and ε_q along η in undrained compression, from isotropic stress: elastic to the surface, then on it."""
    kappa, M = CLAY["kappa"], CLAY["M"]
    Lam = (CLAY["lambda"] - kappa) / CLAY["lambda"]
    r = 3 * (1 - 2 * CLAY["nu"]) / (2 * (1 + CLAY["nu"]))

    def plastic(e):
        arc = np.arctan(e / M)
        return (kappa * Lam / M * (np.log(np.abs((M + e) / (M - e))) - 2 * arc)
                + kappa / (3 * r) * ((1 - 2 * Lam) * e + 2 * Lam * M * arc))

    at_yield = M * np.sqrt(OCR - 1)
    p = p0 * ((M**2 + at_yield**2) / (M**2 + eta**2)) ** Lam
    return p, at_yield * kappa / (3 * r) + plastic(eta) - plastic(at_yield)


def draw_isotropic(program, one):
    """To 400 kPa, back to 50, on to 1600, from a normally consolidated start."""
    stages = [{"type": "isotropic", "p": p, "increments": 50} for p in (400.0, 50.0, 1600.0)]
    curve = curve_of(program, CLAY, [100.0] * 3, *stages, initial={"p_c": 100.0})
    one.semilogx(curve["p"], 100 * curve["eps_v"], color="tab:blue")
    kappa, lam = CLAY["kappa"], CLAY["lambda"]
    for p in (200.0, 400.0, 800.0, 1600.0):
        one.plot(p, 100 * lam * np.log(p / 100), **DOT)
    for p in (50.0, 100.0, 200.0):
        one.plot(p, 100 * (lam * np.log(4.0) + kappa * np.log(p / 400)), **DOT)
    one.set_xticks([50, 100, 200, 400, 800, 1600])
    one.xaxis.set_major_formatter("{x:g}")
    one.xaxis.set_minor_formatter("")
    one.invert_yaxis()


def draw_modified_cam_clay(program, plt):
    figure, axes = plt.subplots(2, 3, figsize=(9, 5.4))
    M, p0 = CLAY["M"], 100.0
    slopes = CLAY["lambda"] - CLAY["kappa"]
    for OCR, colour in ((1, "tab:blue"), (2, "k"), (4, "tab:red")):
        start = {"p_c": p0 * OCR}
        wet = curve_of(program, CLAY, [p0] * 3, {"type": "triaxial-undrained", "eps_a": 0.2, "increments": 400},
                       initial=start)
        for one, (x, y) in zip(axes[0], ((wet["p"], wet["q"]), (100 * wet["eps_zz"], wet["q"]),
                                         (100 * wet["eps_zz"], wet["u"]))):
            one.plot(x, y, color=colour, label=f"OCR {OCR}")
        at_yield = M * np.sqrt(OCR - 1)
        eta = at_yield + (M - at_yield) * np.array([0.0, 0.3, 0.6, 0.8, 0.93, 0.99] if OCR != 2 else [0.0])
        p, eps = (p0, at_yield * CLAY["kappa"] / 3 * 2.6 / 1.2) if OCR == 2 else undrained_closed(OCR, p0, eta)
        for one, x, y in zip(axes[0], (p, 100 * eps, 100 * eps), (eta * p, eta * p, p0 + eta * p / 3 - p)):
            one.plot(x, y, **DOT)
        dry = curve_of(program, CLAY, [p0] * 3, {"type": "triaxial-drained", "eps_a": 0.4, "increments": 800},
                       initial=start)
        eps = 100 * dry["eps_zz"]
        axes[1, 1].plot(eps, dry["q"], color=colour)
        axes[1, 2].plot(eps, 100 * dry["eps_v"], color=colour)
        p_c = np.maximum(dry["p"] * (1 + (dry["q"] / dry["p"] / M) ** 2), p0 * OCR)
        if OCR > 2:
            p_c = np.where(eps > eps[dry["q"].argmax()], dry["p"] * (1 + (dry["q"] / dry["p"] / M) ** 2), p_c)
        volume = CLAY["kappa"] * np.log(dry["p"] / p0) + slopes * np.log(p_c / (p0 * OCR))
        axes[1, 2].plot(eps[30::90], 100 * volume[30::90], **DOT)
    draw_isotropic(program, axes[1, 0])
    axes[1, 1].plot(40, 3 * M * p0 / (3 - M), **DOT)
    axes[1, 2].invert_yaxis()
    axes[0, 0].plot([0, 200], [0, 200 * M], "k:", lw=0.8)
    axes[0, 0].set_xlim(left=0)
    axes[0, 1].legend()
    titles(axes, ("undrained: stress path", "p [kPa]", "q [kPa]"), ("undrained", "ε$_{zz}$ [%]", "q [kPa]"),
           ("undrained: pore pressure", "ε$_{zz}$ [%]", "u [kPa]"), ("isotropic compression", "p [kPa]", "ε$_v$ [%]"),
           ("drained", "ε$_{zz}$ [%]", "q [kPa]"), ("drained: volume", "ε$_{zz}$ [%]", "ε$_v$ [%]"))
    return figure


def softened(plastic, peak, residual, at):
    return peak + (residual - peak) * np.minimum(plastic / at, 1)


def draw_undrained_strength(program, plt):
    """Von Mises and Tresca side by side, softening."""
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.0))
    soil = {"E": 6e3, "nu": 0.45, "s_u": 30.0, "s_u_residual": 10.0, "epsp_residual": 0.08}
    G = soil["E"] / (2 * (1 + soil["nu"]))
    kappa = np.linspace(0, 0.1, 8)
    s_u = softened(kappa, soil["s_u"], soil["s_u_residual"], soil["epsp_residual"])
    for model, style, factor in (("von-mises", "-", np.sqrt(3)), ("tresca", "--", 2.0)):
        material = {"model": model, **soil}
        shear = curve_of(program, material, [100.0] * 3, {"type": "simple-shear-undrained", "gamma": 0.2,
                                                          "increments": 400})
        axes[0].plot(200 * shear["eps_zx"], shear["sig_zx"], style, label=model)
        for end in (0.12, -0.12):
            triaxial = curve_of(program, material, [100.0] * 3, {"type": "triaxial-undrained", "eps_a": end,
                                                                 "increments": 400})
            axes[1].plot(100 * triaxial["eps_zz"], np.sign(end) * triaxial["q"], style,
                         color="tab:blue" if model == "von-mises" else "tab:orange")
        q = factor * s_u
        eps = 100 * (kappa + q / (3 * G))
        axes[1].plot(np.concatenate([eps, -eps]), np.concatenate([q, -q]), **DOT)
        cyclic = {"type": "simple-shear-undrained", "gamma": [0.03, -0.03], "cycles": 3}
        loops = curve_of(program, material, [100.0] * 3, cyclic)
        axes[2].plot(200 * loops["eps_zx"], loops["sig_zx"], style)
    axes[0].plot(100 * (np.sqrt(3) * kappa + s_u / G), s_u, **DOT)
    axes[0].legend()
    titles(axes, ("simple shear", "γ [%]", "τ [kPa]"),
           ("triaxial, undrained", "ε$_{zz}$ [%]", "q, negative in extension [kPa]"),
           ("cyclic simple shear", "γ [%]", "τ [kPa]"))
    return figure


FIGURES = {"linear-elastic": draw_linear_elastic, "neo-hookean": draw_neo_hookean,
           "modified-cam-clay": draw_modified_cam_clay, "undrained-strength": draw_undrained_strength,
           "friction": draw_friction, "viscoplastic-subloading": draw_viscous}


def main():
    program = arguments(__doc__).parse_args().program
    plt = pyplot()
    for name, draw in FIGURES.items():
        figure = draw(program, plt)
        figure.tight_layout()
        figure.savefig(OUT / f"{name}.png", dpi=75 if name == "friction" else 90)
        plt.close(figure)


if __name__ == "__main__":
    main()
