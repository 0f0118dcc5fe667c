"""Draws the studies of `make validate` and prints the tables of docs/verification.md.

Reads errors.csv, discs.csv and schemes.csv from the folder that build/tests/validate has written.
"""

import argparse
import csv
import math
import pathlib

from laboratory import ROOT, pyplot, titles

FIGURES = ROOT / "docs/figures"
COLOURS = {"linear": "C0", "b-spline": "C3", "gimp": "C2"}
FLIPS = {"1": "-", "0.99": "--", "0.9": "-.", "0": ":"}


def rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def curves(errors, problem, quantity):
    """n and values by (shape, quadrature, points per element along a side)."""
    found = {}
    for row in errors:
        if row["problem"] == problem and row["quantity"] == quantity:
            key = row["shape"], row["quadrature"], int(row["per_cell"])
            found.setdefault(key, []).append((int(row["n"]), float(row["value"])))
    return found


def number(value):
    """1.23e-4 as a table has it."""
    if math.isnan(value):
        return "broke down"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}e{int(exponent)}" if not 0.1 <= abs(value) < 10 else f"{value:.3f}"


def order(pairs):
    """Of the last two meshes."""
    (n, e), (m, f) = pairs[-2:]
    return "" if math.isnan(e + f) else f"{math.log(e / f) / math.log(m / n):.2f}"


def print_table(errors, problem, quantity):
    found = curves(errors, problem, quantity)
    if not found:
        return
    meshes = sorted({n for pairs in found.values() for n, _ in pairs})
    print(f"\n{problem}: {quantity}\n")
    print("| shape functions | quadrature | points per element | " + " | ".join(f"n = {n}" for n in meshes)
          + " | last order |")
    print("| --- " * (len(meshes) + 4) + "|")
    for (shape, quadrature, per_cell), pairs in found.items():
        values = dict(pairs)
        cells = [number(values[n]) if n in values else "" for n in meshes]
        print(f"| {shape} | {quadrature} | {per_cell} × {per_cell} | " + " | ".join(cells) + f" | {order(pairs)} |")


def draw_errors(axis, errors, problem, quantity, per_cell):
    """Errors over n; dashed with eq. 4 as printed where there is another quadrature."""
    for (shape, quadrature, points), pairs in curves(errors, problem, quantity).items():
        if points != per_cell:
            continue
        through = quadrature == "corrected" or shape == "gimp"
        style = "o-" if through else "s--"
        axis.loglog(*zip(*pairs), style, color=COLOURS[shape], ms=3, mfc="none",
                    label=shape + ("" if through else ", eq. 4 as printed"))


def slope(axis, power):
    """A line of order `power` under the curves, from their left end on."""
    lines = [line.get_xydata() for line in axis.lines]
    if not lines:
        return
    left = min(line[:, 0].min() for line in lines)
    high = 0.6 * min(line[0, 1] for line in lines if not math.isnan(line[0, 1]))
    axis.loglog([left, 3 * left], [high, high / 3**power], "k", lw=0.7)
    axis.text(1.6 * left, high * 0.8 / 1.7**power, f"order {power}", fontsize=7, ha="right", va="top")
    meshes = sorted({int(x) for line in lines for x in line[:, 0]})
    axis.set_xticks(meshes, [str(n) for n in meshes])
    axis.minorticks_off()


def draw_convergence(plt, errors):
    panels = [("manufactured, small strain", "displacement", 2, 2), ("manufactured, small strain", "stress", 2, 1),
              ("manufactured, large strain", "displacement", 3, 2), ("column at rest", "stress", 2, 1),
              ("column, sudden weight", "displacement", 2, 2), ("vortex, A = 0.1", "displacement", 3, 2),
              ("vortex, A = 1", "displacement", 4, 2), ("vortex, A = 1, half the time step", "displacement", 4, 2)]
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.4))
    for axis, (problem, quantity, per_cell, power) in zip(axes.flat, panels):
        draw_errors(axis, errors, problem, quantity, per_cell)
        slope(axis, power)
    titles(axes, *((f"{problem}\n{quantity}, {per_cell} × {per_cell} points", "elements along a side",
                    "relative L2 error") for problem, quantity, per_cell, _ in panels))
    axes[0, 0].legend()
    figure.tight_layout()
    figure.savefig(FIGURES / "verification_convergence.png", dpi=130)


def histories(discs, problem):
    """Rows by (shape, quadrature, flip, n)."""
    found = {}
    for row in discs:
        if row["problem"] == problem:
            found.setdefault((row["shape"], row["quadrature"], row["flip"], int(row["n"])), []).append(
                {key: float(row[key]) for key in ("t", "kinetic", "stored", "angular_momentum", "momentum")})
    return found


def is_other(shape, quadrature):
    """Not the quadrature that a shape function has by default?"""
    return quadrature == "points" and shape != "gimp"


def draw_discs(plt, discs):
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.4))
    for (shape, quadrature, flip, n), run in histories(discs, "colliding discs").items():
        if is_other(shape, quadrature):
            continue
        t, start = [at["t"] for at in run], run[0]["kinetic"]
        style = {"color": COLOURS[shape], "ls": FLIPS[flip]}
        axes[0, 0].plot(t, [(at["kinetic"] + at["stored"]) / start for at in run], label=f"{shape}, flip {flip}", **style)
        if flip == "1":
            axes[0, 1].plot(t, [at["kinetic"] / start for at in run], color=COLOURS[shape], label=f"{shape}, kinetic")
            axes[0, 1].plot(t, [at["stored"] / start for at in run], color=COLOURS[shape], ls="--",
                            label=f"{shape}, stored")
    for (shape, quadrature, flip, n), run in histories(discs, "turning disc").items():
        if is_other(shape, quadrature) or flip != "1":
            continue
        turns = [at["t"] * 0.5 / (2 * math.pi) for at in run]
        style = {"color": COLOURS[shape], "ls": {20: ":", 40: "--", 80: "-"}[n], "label": f"{shape}, n = {n}"}
        axes[1, 0].plot(turns, [at["angular_momentum"] / run[0]["angular_momentum"] for at in run], **style)
        axes[1, 1].plot(turns, [(at["kinetic"] + at["stored"]) / run[0]["kinetic"] for at in run], **style)
    titles(axes, ("Colliding discs, n = 20", "t", "energy / that at the start"),
           ("Colliding discs, n = 20, FLIP", "t", "energy / that at the start"),
           ("Turning disc, FLIP", "turns", "angular momentum / ½ρπR⁴Ω"),
           ("Turning disc, FLIP", "turns", "energy / that at the start"))
    for axis in axes.flat:
        axis.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(FIGURES / "verification_discs.png", dpi=130)


def print_discs(discs):
    print("\n| run | shape functions | quadrature | flip | n | momentum | energy, lowest | highest | at the end "
          "| kinetic at the end | angular momentum at the end |")
    print("| --- " * 11 + "|")
    for problem in ("colliding discs", "turning disc"):
        for (shape, quadrature, flip, n), run in histories(discs, problem).items():
            start = run[0]["kinetic"]
            energy = [(at["kinetic"] + at["stored"]) / start for at in run]
            turned = (f"{run[-1]['angular_momentum'] / run[0]['angular_momentum']:.4f}"
                      if problem == "turning disc" else "")
            print(f"| {problem} | {shape} | {quadrature} | {flip} | {n} | {number(run[0]['momentum'])} "
                  f"| {min(energy):.4f} | {max(energy):.4f} | {energy[-1]:.4f} | {run[-1]['kinetic'] / start:.4f} "
                  f"| {turned} |")


def print_schemes(schemes):
    """A row for each problem and quantity, a column for each scheme."""
    names = list(dict.fromkeys(row["scheme"] for row in schemes))
    found = {}
    for row in schemes:
        key = row["problem"], int(row["n"]), row["quantity"]
        found.setdefault(key, {})[row["scheme"]] = float(row["value"])
    print("\n| problem | n | quantity | " + " | ".join(names) + " |")
    print("| --- " * (len(names) + 3) + "|")
    for (problem, n, quantity), values in found.items():
        if quantity != "broke down":
            print(f"| {problem} | {n} | {quantity} | "
                  + " | ".join(number(values.get(name, math.nan)) for name in names) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT / "build/validate")
    folder = parser.parse_args().folder
    errors, discs = rows(folder / "errors.csv"), rows(folder / "discs.csv")
    for problem in dict.fromkeys(row["problem"] for row in errors):
        quantities = ["displacement", "stress"]
        if problem.startswith("column"):
            quantities += ["inner stress", "unbalanced"] if "rest" in problem else ["top", "base"]
        for quantity in quantities:
            print_table(errors, problem, quantity)
    print_discs(discs)
    print_schemes(rows(folder / "schemes.csv"))
    plt = pyplot()
    draw_convergence(plt, errors)
    draw_discs(plt, discs)


if __name__ == "__main__":
    main()
