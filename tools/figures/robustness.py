"""Draws docs/figures/robustness_*.png from docs/figures/robustness.csv and the last frames in the folder of
tools/robustness.py (build/robustness): `make robustness`.
"""

import argparse
import csv
import pathlib
import sys

import numpy as np

from laboratory import ROOT, pyplot

sys.path.insert(0, str(ROOT / "tools"))
import robustness as runs  # noqa: E402
import vtu  # noqa: E402

FIGURES = ROOT / "docs/figures"
COLOURS = {"two-term": "C0", "report": "C3", "apic": "C2"}
QUANTITIES = {"toe": "98 % of the mass beyond the cut [m]", "crest": "crest back to x [m]", "moved": "moved mass [Mg/m]",
              "behind": "bonding lost, x < 8", "front": "bonding lost, x > 35"}


def number(text):
    return float(text) if text else np.nan


def rows():
    with open(runs.CSV, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def draw_slope(plt, table):
    """All runs of the cut slope with the two-term scheme and those of the others, a row each."""
    mine = [row for row in table if row["study"] not in ("column", "gap", "no softening")]
    figure, axes = plt.subplots(1, len(QUANTITIES), figsize=(13, 0.17 * len(mine) + 1.2), sharey=True)
    for axis, (key, says) in zip(axes, QUANTITIES.items()):
        for at, row in enumerate(mine):
            scheme = next((name for name in COLOURS if row["name"].startswith(name)), "two-term")
            axis.plot(number(row[key]), at, "o", ms=4, color=COLOURS[scheme], mfc=None if row["status"] == "done" else "none")
        axis.set_xlabel(says)
        axis.set_xlim(left=None if key == "crest" else 0)
    axes[0].set_yticks(range(len(mine)), [f"{row['study']}: {row['name']}" for row in mine])
    axes[0].set_ylim(len(mine) - 0.5, -0.5)
    figure.tight_layout()
    figure.savefig(FIGURES / "robustness_slope.png", dpi=110)


def last_frame(out, one):
    return vtu.read_vtu(vtu.read_pvd(out / one.folder / "points.pvd")[-1][1])


def has_frames(out, one):
    return (out / one.folder / "points.pvd").exists()


def scatter(axis, frame, spacing, limits, high, inches):
    """Points as squares of about their own size, coloured by displacement up to `high`."""
    (left, right), (low, top) = limits
    x, y = frame["Points"][:, 0], frame["Points"][:, 1]
    length = np.linalg.norm(frame["displacement"], axis=1)
    axis.set_aspect("equal")
    axis.set_xlim(left, right)
    axis.set_ylim(low, top)
    axis.grid(False)
    size = 1.3 * spacing * 72 * inches / (right - left)  # a little more than they are: no lines between
    return axis.scatter(x, y, c=length, s=size**2, marker="s", lw=0, cmap="viridis", vmin=0, vmax=high)


def draw_frames(plt, out, chosen, path, limits, high, columns, spacing):
    """The last frame of each run in `chosen`: {title: run}."""
    chosen = {title: one for title, one in chosen.items() if has_frames(out, one)}
    if not chosen:
        return
    lines = -(-len(chosen) // columns)
    (left, right), (low, top) = limits
    width = 11.5 / columns
    high_of_one = width * (top - low) / (right - left) + 0.4
    figure, axes = plt.subplots(lines, columns, figsize=(13, lines * high_of_one), squeeze=False, layout="constrained")
    for axis in axes.flat[len(chosen):]:
        axis.set_visible(False)
    for axis, (title, one) in zip(axes.flat, chosen.items()):
        shown = scatter(axis, last_frame(out, one), spacing(one), limits, high, width)
        axis.set_title(title, loc="left")
    figure.colorbar(shown, ax=axes, shrink=0.6, pad=0.01, label="displacement [m]")
    figure.savefig(path, dpi=110)


def spacing_of(one):
    return one.changes.get("region.slope.spacing", 0.16)


def pick(found, *names):
    return {f"{one.study}, {one.name}": one for one in found if one.name in names}


def draw_cuts(plt, out, studies):
    """What the same slope looks like after 20 s."""
    chosen = {}
    for steps, places in (("steps", "places"), ("fine", "fine places")):
        chosen |= pick(studies[steps], *(f"two-term {s}" for s in runs.SAFETIES), "report 0.3", "report 0.95", "apic 0.6")
        chosen |= pick(studies[places], "shift 0.3 h", "shift 0.7 h", "gimp", "b-spline", "0.37 h", "0.5 h")
    draw_frames(plt, out, chosen, FIGURES / "robustness_cuts.png", ((5, 40), (2, 16)), 10, 3, spacing_of)


def draw_plain(plt, out, studies):
    chosen = {one.name: one for one in studies["plain"]}
    draw_frames(plt, out, chosen, FIGURES / "robustness_plain.png", ((0, 45), (0, 16)), 6, 3, spacing_of)


def of_experiments(axes):
    """Lube et al. (2005) and Lajeunesse et al. (2005): run-out over L0, height over L0."""
    laws = ((0, "-", "Lube", ((0.4, 1.8, 1.2, 1), (2.8, 8, 1.9, 2 / 3))),
            (0, "--", "Lajeunesse", ((0.4, 3, 1.8, 1), (3, 8, 2.3, 2 / 3))),
            (1, "-", "Lube", ((0.4, 1.15, 1, 1), (1.15, 8, 1, 0.4))),
            (1, "--", "Lajeunesse", ((0.4, 0.7, 1, 1), (0.7, 8, 1, 1 / 3))))
    for at, style, who, parts in laws:
        for k, (start, end, factor, power) in enumerate(parts):
            a = np.array([start, end])
            axes[at].loglog(a, factor * a**power, "k" + style, label=f"{who} et al. 2005" if k == 0 else None)


def draw_column(plt, out, studies, table):
    figure, axes = plt.subplots(1, 2, figsize=(9, 4))
    of_experiments(axes)
    for parts, style in ((10, "s"), (20, "o")):
        mine = [row for row in table if row["study"] == "column" and row["name"].endswith(f"L0/{parts}")]
        a = [float(row["name"].split()[2].rstrip(",")) for row in mine]
        for axis, key, colour, says in ((axes[0], "toe", "C0", "98 % of the mass"),
                                        (axes[0], "furthest", "C1", "connected front"),
                                        (axes[1], "height", "C0", "at the wall")):
            axis.plot(a, [number(row[key]) for row in mine], style, color=colour, mfc="none" if parts == 10 else None, ms=5,
                      label=f"{says}, h = L0/{parts}")
    stronger = [row for row in table if row["study"] == "column" and row["name"].endswith("L0/20, 36.9°")]
    a = [float(row["name"].split()[2].rstrip(",")) for row in stronger]
    for axis, key, says in ((axes[0], "toe", "98 % of the mass"), (axes[1], "height", "at the wall")):
        axis.plot(a, [number(row[key]) for row in stronger], "^", color="C2", ms=5, label=f"{says}, h = L0/20, φ = 36.9°")
    axes[0].set_yticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"])
    axes[1].set_yticks([0.5, 1, 1.5, 2], ["0.5", "1", "1.5", "2"])
    for axis, says in zip(axes, ("run-out (L∞ − L0)/L0", "height of the deposit H∞/L0")):
        axis.set_xlabel("a = H0/L0")
        axis.set_ylabel(says)
        axis.set_xticks([0.5, 1, 2, 4, 6], ["0.5", "1", "2", "4", "6"])
        axis.minorticks_off()
        axis.legend()
    figure.tight_layout()
    figure.savefig(FIGURES / "robustness_column.png", dpi=110)
    found = sorted((one for one in studies["column"] if one.name.endswith(("/20", "/10"))), key=lambda one: one.place["a"])
    chosen = {one.name: one for one in found}
    draw_frames(plt, out, chosen, FIGURES / "robustness_column_deposits.png", ((0, 10), (0, 1.6)), 8, 2,
                lambda one: one.changes["region.column.spacing"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=ROOT / "build/robustness", help="(build/robustness)")
    out = parser.parse_args().folder
    plt, studies, table = pyplot(), runs.studies(out), rows()
    draw_slope(plt, table)
    draw_cuts(plt, out, studies)
    draw_plain(plt, out, studies)
    draw_column(plt, out, studies, table)


if __name__ == "__main__":
    main()
