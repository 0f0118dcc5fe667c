"""Draws the results of a run: `scarp plot DIR`.

configurations.png  five panels (a)–(e) of the moving soil, coloured by a field; in space a vertical section along x
plan.png            the same from above, in space only
fields.png          the last configuration, coloured by several fields
history.png         energies, unbalanced force, velocity, time step and substeps over time
"""

import argparse
import csv
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import vtu  # noqa: E402  (beside this file, wherever it is installed)

# name: (label, derived from the frame's arrays, colour map)
LABELS = {
    "displacement": ("displacement [m]", "viridis"),
    "velocity": ("velocity [m/s]", "magma"),
    "eps_q": ("deviatoric strain ε$_q$", "magma"),
    "eps_v": ("volumetric strain ε$_v$ (compression +)", "RdBu_r"),
    "epsp_q": ("plastic deviatoric strain", "magma"),
    "R_b": ("bonding factor R$_b$", "cividis"),
    "R": ("R", "viridis"),
    "p": ("p [kPa]", "viridis"),
    "q": ("q [kPa]", "viridis"),
    "p_c": ("p$_c$ [kPa]", "viridis"),
}
OVERVIEW = ["displacement", "eps_q", "R_b", "R", "p", "p_c"]


class Refusal(Exception):
    """Something the user asked for is not there."""


class Run:
    """A folder of results."""

    def __init__(self, folder):
        collection = os.path.join(folder, "points.pvd")
        if not os.path.isdir(folder):
            raise Refusal(f"there is no folder {folder}")
        if not os.path.isfile(collection):
            raise Refusal(f"{folder} holds no results of scarp: points.pvd is missing")
        self.folder = folder
        self.frames = vtu.read_pvd(collection)
        if not self.frames:
            raise Refusal(f"{collection} lists no frames")
        self.summary = self._summary()
        self._cache = {}

    def _summary(self):
        try:
            with open(os.path.join(self.folder, "summary.json"), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return {}

    def arrays(self, index):
        if index not in self._cache:
            self._cache = {index: vtu.read_vtu(self.frames[index][1])}
        return self._cache[index]

    def field(self, index, name):
        arrays = self.arrays(index)
        if name not in arrays or name in ("Points", "connectivity", "offsets", "types"):
            known = sorted(set(arrays) - {"Points", "connectivity", "offsets", "types"})
            raise Refusal(f"the frames have no field {name}; they have {', '.join(known)}")
        values = arrays[name].astype(float)
        return values if values.ndim == 1 else np.linalg.norm(values, axis=1)

    def history(self):
        path = os.path.join(self.folder, "history.csv")
        if not os.path.isfile(path):
            return {}
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = list(csv.reader(file))
        table = np.array([row for row in rows[1:] if len(row) == len(rows[0])], dtype=float)
        return {name: table[:, k] for k, name in enumerate(rows[0])} if len(table) else {}

    def cut_start(self):
        """Time at which the first stage that removes soil starts, or the start of the last stage."""
        stages = self.summary.get("stages", [])
        for stage in stages:
            if stage.get("removal"):
                return stage["start"]
        return stages[-1]["start"] if stages else self.frames[0][0]


class View:
    """Which points are drawn, on which axes and how large: all in the plane; in space those near a vertical section along
    x, or from above with the highest on top."""

    def __init__(self, run, plan=False, section=None):
        self.run, self.plan = run, plan
        self.space = run.summary.get("dimension", 2) == 3
        self.revolved = run.summary.get("axisymmetric", False)
        self.axes = (0, 2) if self.space and not plan else (0, 1)
        self.names = ["xyz"[axis] + " [m]" for axis in self.axes]
        self.section = section
        if self.space and not plan and section is None:
            last = len(run.frames) - 1  # through the point that has moved furthest
            self.section = float(run.arrays(last)["Points"][np.nanargmax(run.field(last, "displacement")), 1])

    def chosen(self, index):
        """Numbers of the points that are drawn, in the order of drawing."""
        positions = self.run.arrays(index)["Points"]
        if not self.space:
            return np.arange(len(positions))
        if self.plan:
            return np.argsort(positions[:, 2])
        return np.flatnonzero(np.abs(positions[:, 1] - self.section) <= np.cbrt(np.median(self.run.arrays(index)["volume"])))

    def coordinates(self, index):
        return self.run.arrays(index)["Points"][:, list(self.axes)]

    def sides(self, index):
        arrays = self.run.arrays(index)
        volume = arrays["volume"]
        if self.revolved:  # volumes are those of a radian
            volume = volume / arrays["Points"][:, 0]
        return np.cbrt(volume) if self.space else np.sqrt(volume)

    def caption(self):
        return f", section y = {self.section:.2f} m" if self.space and not self.plan else ""


def choose_frames(run, count):
    """The first frame, the first one after the cut, and others as the soil has moved a quarter, two thirds and all of its way."""
    cut = run.cut_start()
    after = [k for k, (time, _) in enumerate(run.frames) if time > cut] or [len(run.frames) - 1]
    moved = {k: np.nanmax(run.field(k, "displacement")) for k in after}
    last = max(moved.values()) or 1.0
    shares = {2: [1.0], 3: [1.0]}.get(count, list(np.linspace(0.25, 1.0, max(1, count - 2))))
    chosen = [0, after[0]]
    for share in shares[:-1]:
        chosen.append(min(after, key=lambda k: abs(moved[k] - share * last)))
    chosen.append(after[-1])
    return sorted(set(chosen))[:count]


def frames_at(run, times):
    return [min(range(len(run.frames)), key=lambda k: abs(run.frames[k][0] - t)) for t in times]


def limits(view, indices):
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for k in indices:
        positions = view.coordinates(k)
        low, high = np.minimum(low, positions.min(axis=0)), np.maximum(high, positions.max(axis=0))
    margin = 0.02 * (high - low).max()
    return low - margin, high + margin


def draw_points(axes, view, index, values, low, high, colours, cmap):
    """Each point as a square a quarter larger than its own volume, so that sheared soil shows few gaps."""
    chosen = view.chosen(index)
    positions = view.coordinates(index)[chosen]
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal", adjustable="box")
    axes.figure.canvas.draw()
    points_per_metre = axes.get_window_extent().width / (high[0] - low[0]) * 72 / axes.figure.dpi
    side = view.sides(index)[chosen]
    return axes.scatter(
        positions[:, 0], positions[:, 1], c=values[chosen], s=(1.25 * side * points_per_metre) ** 2, marker="s", linewidths=0,
        cmap=cmap, vmin=colours[0], vmax=colours[1], rasterized=True)


def colour_range(values, given):
    if given:
        return given
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return 0.0, 1.0
    low, high = np.percentile(finite, [1, 99])
    if low > 0 and low < 0.3 * high:
        low = 0.0
    return float(low), float(high if high > low else low + 1e-6)


def configurations(plt, run, options, plan=False):
    view = View(run, plan, options.section)
    indices = frames_at(run, options.times) if options.times else choose_frames(run, options.panels)
    name = options.field or run.summary.get("colour") or "displacement"
    label, cmap = LABELS.get(name, (name, "viridis"))
    low, high = limits(view, indices)
    colours = colour_range(run.field(indices[-1], name), options.range)
    width = 7.0
    height = width * (high[1] - low[1]) / (high[0] - low[0]) * 0.86 + 0.35
    figure, panels = plt.subplots(len(indices), 1, figsize=(width, height * len(indices) + 0.9), squeeze=False)
    total = height * len(indices) + 0.9
    figure.subplots_adjust(left=0.09, right=0.97, top=1 - 0.3 / total, bottom=1.15 / total, hspace=0.3)
    for number, (axes, index) in enumerate(zip(panels[:, 0], indices)):
        letter = chr(ord("a") + number) if number < 26 else number + 1
        drawn = draw_points(axes, view, index, run.field(index, name), low, high, colours, cmap)
        axes.set_title(f"({letter})  t = {run.frames[index][0]:.2f} s{view.caption()}", loc="left", fontsize=9)
        axes.set_ylabel(view.names[1], fontsize=8)
        axes.tick_params(labelsize=8)
        axes.set_facecolor("0.97")
    panels[-1, 0].set_xlabel(view.names[0], fontsize=8)
    bar = figure.colorbar(drawn, cax=figure.add_axes([0.09, 0.5 / total, 0.88, 0.12 / total]), orientation="horizontal")
    bar.set_label(label, fontsize=8)
    bar.ax.tick_params(labelsize=8)
    return figure


def from_above(plt, run, options):
    return configurations(plt, run, options, plan=True) if run.summary.get("dimension", 2) == 3 else None


def fields(plt, run, options):
    view = View(run, section=options.section)
    last = len(run.frames) - 1
    names = [name for name in OVERVIEW if name in run.arrays(last)]
    low, high = limits(view, [last])
    rows = (len(names) + 1) // 2
    height = 5.0 * (high[1] - low[1]) / (high[0] - low[0]) + 0.6
    figure, panels = plt.subplots(rows, 2, figsize=(11, height * rows), squeeze=False)
    for axes, name in zip(panels.flat, names):
        label, cmap = LABELS.get(name, (name, "viridis"))
        values = run.field(last, name)
        drawn = draw_points(axes, view, last, values, low, high, colour_range(values, None), cmap)
        axes.set_title(label, fontsize=9, loc="left")
        axes.tick_params(labelsize=8)
        figure.colorbar(drawn, ax=axes, fraction=0.025, pad=0.02).ax.tick_params(labelsize=7)
    for axes in panels.flat[len(names):]:
        axes.axis("off")
    figure.suptitle(f"t = {run.frames[last][0]:.2f} s{view.caption()}", fontsize=10)
    return figure


def history(plt, run, _):
    table = run.history()
    if not table:
        return None
    time = table["time"]
    figure, panels = plt.subplots(3, 2, figsize=(11, 9), sharex=True)
    panels = panels.flat

    def lines(axes, entries, ylabel, log=False):
        for name, label in entries:
            if name in table:
                axes.plot(time, table[name], lw=1, label=label)
        if log:
            axes.set_yscale("log")
        axes.set_ylabel(ylabel, fontsize=8)
        axes.tick_params(labelsize=8)
        axes.grid(alpha=0.3)
        axes.legend(fontsize=7)
        for stage in run.summary.get("stages", []):
            axes.axvline(stage["start"], color="0.6", lw=0.8, ls=":")

    terms = [name for name in table if name.split("_")[0] in ("work", "dissipation", "stored") and any(table[name])]
    lines(panels[0], [("kinetic_energy", "kinetic energy")] + [(name, name.replace("_", " ")) for name in terms], "energy [kJ/m]")
    lines(panels[1], [("kinetic_energy", "kinetic energy"), ("energy_error", "energy error")], "energy [kJ/m]")
    lines(panels[2], [("unbalanced_ratio", "unbalanced force ratio")], "-", log=True)
    lines(panels[3], [("max_velocity", "largest velocity")], "m/s", log=True)
    lines(panels[4], [("dt", "time step")], "s")
    lines(panels[5], [("substeps_mean", "mean substeps"), ("on_floor", "points on the floor of p_c"), ("separated", "separated points")], "-")
    for axes in panels[4:6]:
        axes.set_xlabel("t [s]", fontsize=8)
    figure.tight_layout()
    return figure


def numbers(text):
    return [float(part) for part in text.split(",")]


def parse(arguments):
    parser = argparse.ArgumentParser(prog="scarp plot", description="Draws the results of a run.")
    parser.add_argument("folder", metavar="DIR", help="folder of the results")
    parser.add_argument("--field", help="field that colours the configurations")
    parser.add_argument("--times", type=numbers, help="times of the configurations, t1,t2,...")
    parser.add_argument("--panels", type=int, default=5, help="number of configurations (5)")
    parser.add_argument("--range", type=numbers, help="colour range, low,high")
    parser.add_argument("--section", type=float, help="y of the section, in space (through the point that moves furthest)")
    parser.add_argument("--out", help="folder for the pictures (DIR)")
    options = parser.parse_args(arguments)
    if options.range and len(options.range) != 2:
        parser.error("--range takes two numbers, low,high")
    if options.panels < 2:
        parser.error("--panels is at least 2")
    return options


def main(arguments=None):
    options = parse(arguments)
    try:
        run = Run(options.folder)
        run.field(0, options.field or "displacement")
        out = options.out or options.folder
        os.makedirs(out, exist_ok=True)
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        for name, draw in (("configurations", configurations), ("plan", from_above), ("fields", fields),
                           ("history", history)):
            figure = draw(plt, run, options)
            if figure is None:
                continue
            path = os.path.join(out, name + ".png")
            figure.savefig(path, dpi=130)
            plt.close(figure)
            print(path)
    except (Refusal, vtu.FormatError, OSError) as problem:
        print(f"scarp plot: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
