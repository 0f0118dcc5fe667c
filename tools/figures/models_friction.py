"""The picture of mohr-coulomb and drucker-prager, drawn by models.py."""

import numpy as np

from laboratory import DOT, curve_of, titles

SAND = {"E": 3e4, "nu": 0.25, "c": 5.0, "phi": 38.0, "psi": 8.0, "c_residual": 0.0, "phi_residual": 32.0,
        "epsp_residual": 0.1}
CELLS = ((100.0, "tab:blue"), (200.0, "tab:orange"), (400.0, "tab:red"))


def line(c, phi, sense):
    """Slope and intercept of q over p at failure; sense 1 in triaxial compression, -1 in extension."""
    s = np.sin(np.radians(phi))
    return 6 * s / (3 - sense * s), 6 * c * np.cos(np.radians(phi)) / (3 - sense * s)


def at_cell(cell, M, k, sense):
    """p and q at failure in a drained triaxial test: q = M p + k, p = cell ± q/3."""
    q = (M * cell + k) / (1 - sense * M / 3)
    return cell + sense * q / 3, sense * q


def triaxial(program, model, cell, end):
    stage = {"type": "triaxial-drained", "eps_a": end, "increments": 300}
    return curve_of(program, {"model": model, **SAND}, [cell] * 3, stage)


def strengths(one, model):
    """Closed-form strengths: peak (line) and residual (dashed), compression and extension, dots at the cell pressures."""
    p = np.array([0.0, 1300.0])
    for sense in (1, -1):
        for c, phi, style in ((SAND["c"], SAND["phi"], "k-"), (SAND["c_residual"], SAND["phi_residual"], "k--")):
            M, k = line(c, phi, 1 if model == "drucker-prager" else sense)
            one.plot(p, sense * (M * p + k), style, lw=0.7)
            for cell, _ in CELLS:
                if sense > 0 or M < 3:
                    one.plot(*at_cell(cell, M, k, sense), **DOT)


def draw_row(program, axes, model):
    compression, volume, path = axes
    for cell, colour in CELLS:
        curve = triaxial(program, model, cell, 0.2)
        eps = 100 * curve["eps_zz"]
        compression.plot(eps, curve["q"], color=colour)
        volume.plot(eps, 100 * curve["eps_v"], color=colour, label=f"{cell:g} kPa")
        path.plot(curve["p"], curve["q"], color=colour)
        for c, phi in ((SAND["c"], SAND["phi"]), (SAND["c_residual"], SAND["phi_residual"])):
            p, q = at_cell(cell, *line(c, phi, 1), 1)
            at = curve["q"].argmax() if c > 0 else -1
            compression.plot(eps[at], q, **DOT)
        extension = triaxial(program, model, cell, -0.2)
        path.plot(extension["p"], -extension["q"], color=colour)
    strengths(path, model)
    volume.invert_yaxis()
    volume.legend(loc="lower right")
    path.set(xlim=(0, 900), ylim=(-700, 1400))
    titles(axes, (f"{model}: drained compression", "ε$_{zz}$ [%]", "q [kPa]"), ("its volume", "ε$_{zz}$ [%]", "ε$_v$ [%]"),
           ("stress paths, also of extension", "p [kPa]", "q, negative in extension [kPa]"))


def draw_friction(program, plt):
    figure, axes = plt.subplots(2, 3, figsize=(9, 5.6))
    for row, model in zip(axes, ("mohr-coulomb", "drucker-prager")):
        draw_row(program, row, model)
    return figure
