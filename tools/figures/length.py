"""Draws the biaxial test of docs/length.md and prints its tables.

Reads biaxial.csv and biaxial_points.csv from the folder that build/tests/validate has written.
"""

import argparse
import pathlib

from laboratory import ROOT, pyplot, titles
from validate import rows

FIGURE = ROOT / "docs/figures/length_biaxial.png"
WIDTH = 0.5  # of the specimen [m]


def curves(folder):
    """Rows by (length, n), ascending."""
    found = {}
    for row in rows(folder / "biaxial.csv"):
        found.setdefault((float(row["length"]), int(row["n"])), []).append(
            tuple(float(row[key]) for key in ("strain", "q", "band")))
    return found


def name(length, n):
    return f"{'without' if length == 0 else f'ℓ = {length:g} m'}, h = {1000 * WIDTH / n:.1f} mm"


def print_tables(found):
    strains = (0.05, 0.056, 0.06, 0.066, 0.07, 0.08)
    print("| | peak | " + " | ".join(f"{strain:g}" for strain in strains) + " | band [m] |")
    print("| --- " * (len(strains) + 3) + "|")
    for (length, n), curve in found.items():
        at = [min(curve, key=lambda row: abs(row[0] - strain))[1] for strain in strains]
        print(f"| {name(length, n)} | {max(row[1] for row in curve):.1f} | "
              + " | ".join(f"{q:.1f}" for q in at) + f" | {curve[-1][2]:.3f} |")
    for length in dict.fromkeys(key[0] for key in found):
        mine = [curve for key, curve in found.items() if key[0] == length]
        spread = max(max(row[1] for row in at) / min(row[1] for row in at) - 1 for at in zip(*mine))
        bands = [curve[-1][2] for curve in mine]
        print(f"length {length:g}: load within {100 * spread:.1f} % at every strain, "
              f"band within {100 * (max(bands) / min(bands) - 1):.1f} %")


def draw(plt, found, points):
    figure, axes = plt.subplots(1, 5, figsize=(13, 4.4), width_ratios=[2.4, 1, 1, 1, 1])
    for (length, n), curve in found.items():
        axes[0].plot([row[0] for row in curve], [row[1] for row in curve], ":" if length == 0 else "-",
                     color={10: "C0", 20: "C3", 30: "C2"}[n], label=name(length, n))
    titles(axes[0], ("Biaxial test", "axial strain", "q [kPa]"))
    axes[0].legend(fontsize=7)
    for axis, key in zip(axes[1:], [(0.0, 10), (0.0, 30), (0.1, 10), (0.1, 30)]):
        mine = [row for row in points if (float(row["length"]), int(row["n"])) == key]
        shown = axis.scatter([float(row["x"]) for row in mine], [float(row["y"]) for row in mine],
                             c=[float(row["plastic"]) for row in mine], s=(58 / key[1]) ** 2 / 2, vmin=0, vmax=0.6,
                             linewidths=0)
        axis.set_aspect("equal")
        axis.set_title(name(*key), fontsize=7)
        axis.set_xticks([])
        axis.set_yticks([])
    figure.colorbar(shown, ax=axes[1:], label="‖ε$^p$‖", shrink=0.8)
    figure.savefig(FIGURE, dpi=130, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT / "build/validate")
    folder = parser.parse_args().folder
    found = curves(folder)
    print_tables(found)
    draw(pyplot(), found, rows(folder / "biaxial_points.csv"))


if __name__ == "__main__":
    main()
