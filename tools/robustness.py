#!/usr/bin/env python3
"""Runs the studies of docs/robustness.md one after the other, measures the last frame of each run, and writes
docs/figures/robustness.csv and the tables of the page: `make robustness`.

Results stay in the folder of --out; a run is done again where its settings have changed or the program is newer.
tools/figures/robustness.py draws them.
"""

import argparse
import csv
import dataclasses
import json
import os
import pathlib
import re
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python/scarp"))
import vtu  # noqa: E402

CSV = ROOT / "docs/figures/robustness.csv"
FIELDS = ("study", "name", "status", "begins", "toe", "furthest", "crest", "moved", "mean", "behind", "front", "height",
          "volume", "separated", "speed", "energy_error", "largest_energy_error", "removed", "steps", "wall")


@dataclasses.dataclass
class Run:
    """A case with changes to it; `measure` tells what of its frames goes into the table, with `place` its arguments."""
    study: str
    name: str
    case: str
    changes: dict
    measure: str = "cut"
    place: dict = dataclasses.field(default_factory=dict)
    threads: int = 1

    @property
    def folder(self):
        return "/".join(text.replace("/", "_").replace(" ", "_").replace("=", "") for text in (self.study, self.name))

    def arguments(self):
        return [word for key, value in self.changes.items() for word in ("--set", f"{key}={toml(value)}")]


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


# The studies -----------------------------------------------------------------------------------------------------------

CUT = "examples/slope_cut_grid/slope_cut_grid.toml"
CUT_ON_MESH = "examples/slope_cut/slope_cut.toml"
PLAIN = "examples/slope_plain/slope_plain.toml"
COLUMN = "examples/column_collapse/column_collapse.toml"
GRIDS = {1.2: (38, 14), 0.8: (56, 21), 0.6: (75, 28), 0.4: (112, 42), 0.3: (150, 56)}  # elements of 45 m × 16.8 m
SAFETIES = (0.3, 0.6, 0.95)
SCHEMES = ("two-term", "report", "apic")


def method(scheme="two-term", safety=0.6, **more):
    return {"scheme": scheme, "safety": safety, **({"flip": 0.95} if scheme == "report" else {}), **more}


def cut(study, name, h=0.8, spacing=None, shift=0.0, case=CUT, threads=1, **of_method):
    """The cut slope with elements of h; `shift` moves its surface and the cut to the right and up, over mesh and points."""
    s = shift
    changes = {"method": method(**of_method), "stage.cut.duration": 20.0, "output.every": 1.0, "output.history": 0.05}
    if case != CUT_ON_MESH:
        changes |= {"mesh.grid": {"size": [45.0, 16.8], "elements": list(GRIDS[h])},
                    "region.slope.spacing": spacing or 0.4 * h}
    elif spacing:
        changes["region.slope.spacing"] = spacing
    if s:
        changes["region.slope.polygon"] = [[0.0, 0.0], [45.0, 0.0], [45.0, 5 + s], [30 + s, 5 + s], [15 + s, 15 + s],
                                           [0.0, 15 + s]]
        changes["stage.cut.remove.polygon"] = [[22 + s, 5 + s], [46.0, 5 + s], [46.0, 16.79], [22 + s, 16.79]]
    place = {"x": 22 + s, "above": 13.5 + s, "behind": 8.0, "front": 35.0}
    return Run(study, name, case, changes, "cut", place, threads)


def of_steps(h):
    return [cut(f"time step, h = {h}", f"{scheme} {safety}", h, scheme=scheme, safety=safety)
            for scheme in SCHEMES for safety in SAFETIES]


def held_sides(out):
    """The case with sides that stay held: absorbing ones ask for linear functions."""
    case = out / "held_sides.toml"
    text = re.sub(r"^(absorbing|from) = .*\n", "", (ROOT / CUT).read_text(encoding="utf-8"), flags=re.MULTILINE)
    if not case.exists() or case.read_text(encoding="utf-8") != text:
        case.write_text(text, encoding="utf-8")
    return str(case)


def of_places(h, held):
    """Elements, points and functions; the run of the standard is in of_steps."""
    return [*(cut(f"place, h = {h}", f"shift {part} h", h, shift=part * h) for part in (0.3, 0.7)),
            *(cut(f"points, h = {h}", f"{part} h", h, spacing=part * h) for part in (0.33, 0.37, 0.5)),
            *(cut(f"held sides, h = {h}", shape, h, case=held, shape=shape) for shape in ("linear", "gimp", "b-spline"))]


LENGTH = 1.6  # [m]


def with_length(out):
    """The slope of a weaker clay (p_c = 220 kPa) on 48 m of ground that softens over a length."""
    case = out / "length.toml"
    text = (ROOT / CUT).read_text(encoding="utf-8")
    for line, side in (("[[0.0, 0.0], [45.0, 0.0]]", "bottom"), ("[[0.0, 0.0], [0.0, 16.4]]", "left"),
                       ("[[45.0, 0.0], [45.0, 16.4]]", "right")):
        text = text.replace(f"line = {line}", f'nodes = "{side}"')
    text = text.replace("p_c = 250.0", "p_c = 220.0").replace("density = 1.8", f"density = 1.8\nlength = {LENGTH}")
    if not case.exists() or case.read_text(encoding="utf-8") != text:
        case.write_text(text, encoding="utf-8")
    return str(case)


def of_length(out):
    """Nine places of the grid for each size of elements."""
    runs = []
    for parts, cells in ((2, [60, 21]), (3, [90, 32]), (4, [120, 42])):
        h = LENGTH / parts
        for i, j in ((i, j) for i in range(3) for j in range(3)):
            x, y = i * h / 3, j * h / 3
            changes = {"mesh.grid": {"size": [48.0, cells[1] * h], "elements": cells}, "region.slope.spacing": 0.4 * h,
                       "method": {"safety": 0.8}, "stage.cut.duration": 20.0, "output.every": 4.0, "output.history": 0.05,
                       "region.slope.polygon": [[0.0, 0.0], [48.0, 0.0], [48.0, 5 + y], [30 + x, 5 + y], [15 + x, 15 + y],
                                                [0.0, 15 + y]],
                       "stage.cut.remove.polygon": [[22 + x, 5 + y], [49.0, 5 + y], [49.0, cells[1] * h - 0.01],
                                                    [22 + x, cells[1] * h - 0.01]]}
            place = {"x": 22 + x, "above": 13.5 + y, "behind": 8.0, "front": 35.0}
            runs.append(Run(f"length, 1/{parts}", f"place {i} {j}", with_length(out), changes, "cut", place))
    return runs


def plain(name, h, spacing=None, **of_method):
    changes = {"mesh.grid": {"size": [60.0, 16.0], "element": h}, "region.slope.spacing": spacing or h / 2,
               "method": method(**of_method)}
    return Run("no softening", name, PLAIN, changes, "cut", {"x": 30.0, "above": 13.5})


def of_plain():
    return [plain("1 m", 1.0), plain("0.5 m", 0.5), plain("0.25 m", 0.25), plain("0.5 m, points 0.2", 0.5, 0.2),
            *(plain(f"0.5 m, {scheme}", 0.5, scheme=scheme) for scheme in SCHEMES[1:]),
            *(plain(f"0.5 m, safety {safety}", 0.5, safety=safety) for safety in (0.3, 0.95)),
            *(plain(f"0.5 m, {shape}", 0.5, shape=shape) for shape in ("gimp", "b-spline"))]


def of_undrained():
    """The same with the undrained strength of a clay, whose flow is associated and keeps its volume."""
    soil = {"name": "soil", "model": "tresca", "density": 1.8, "E": 1.0e4, "nu": 0.3, "s_u": 22.0}
    found = [plain(f"{h} m, s_u = 22", h) for h in (1.0, 0.5, 0.25)]
    for one in found:
        one.changes |= {"material.soil": soil, "region.slope.K0": 0.9}
    return found


def column(a, parts, phi=31.0, **of_method):
    """A column of the aspect ratio a on elements of a part of its length of 1 m."""
    top = float(a)
    width = 2.0 + round(3.0 * a ** (2 / 3) + 0.5)
    high = top + 0.4
    changes = {"mesh.grid": {"size": [width, high], "element": 1.0 / parts}, "region.column.spacing": 0.5 / parts,
               "region.column.polygon": [[0.0, 0.0], [1.0, 0.0], [1.0, top], [0.0, top]],
               "stage.collapse.duration": round(0.5 + 4.0 * (a / 9.81) ** 0.5, 1),
               "method": method(leaving="remove", **of_method)}
    name = f"a = {a}, L0/{parts}" + (f", {of_method['scheme']}" if of_method else "")
    if phi != 31.0:
        name, changes["material.sand.phi"] = f"{name}, {phi}°", phi
    return Run("column", name, COLUMN, changes, "column", {"a": a, "h": 1.0 / parts})


def of_columns():
    return [column(a, parts) for parts in (10, 20) for a in (0.5, 1, 2, 4, 6)] + [
        column(2, 10, scheme=scheme) for scheme in SCHEMES[1:]] + [
        column(a, parts, phi=36.9) for parts in (10, 20) for a in (1, 2, 4)]  # sin 36.9° = tan 31°


GAP = """gravity = [0.0, -9.81]
[mesh]
grid = { size = [6.0, 4.0], element = 0.5 }
[[material]]
name = "elastic"
model = "linear-elastic"
density = 1.8
E = 1.0e4
nu = 0.2
[[region]]
name = "bed"
material = "elastic"
polygon = [[0.0, 0.0], [6.0, 0.0], [6.0, 1.0], [0.0, 1.0]]
spacing = 0.25
K0 = 0.25
[[region]]
name = "block"
material = "elastic"
polygon = [[2.0, 2.0], [4.0, 2.0], [4.0, 3.0], [2.0, 3.0]]
spacing = 0.25
stress = [0.0, 0.0, 0.0, 0.0]
[[boundary]]
nodes = "bottom"
fix = ["x", "y"]
[[boundary]]
nodes = "left"
fix = ["x"]
[[boundary]]
nodes = "right"
fix = ["x"]
[[stage]]
name = "drop"
duration = 1.0
[[stage]]
name = "rest"
duration = 3.0
damping = 0.7
"""


def of_gap(out):
    """A block dropped by 1 m on a bed of the same."""
    case = out / "gap.toml"
    if not case.exists() or case.read_text(encoding="utf-8") != GAP:
        case.write_text(GAP, encoding="utf-8")
    return [Run("gap", f"h = {h}", str(case), {"mesh.grid.element": h, "region.0.spacing": h / 2, "region.1.spacing": h / 2},
                "gap", {"h": h}) for h in (0.5, 0.25)]


def studies(out):
    return {"steps": of_steps(0.8), "places": of_places(0.8, held_sides(out)),
            "mesh": [cut("elements", f"h = {h}", h) for h in (1.2, 0.6)],
            "waves": [cut("damping of 5 ms", f"h = {h}", h, stress_damping_time=0.005) for h in (0.8, 0.4)],
            "threads": [cut("threads", "two", threads=2)],
            "fine": of_steps(0.4), "fine places": of_places(0.4, held_sides(out)),
            "triangles": [cut("slope_cut", f"safety {safety}", case=CUT_ON_MESH, safety=safety) for safety in SAFETIES],
            "length": of_length(out), "plain": of_plain(), "undrained": of_undrained(), "column": of_columns(), "gap": of_gap(out)}


# Running ---------------------------------------------------------------------------------------------------------------

def run(program, one, out):
    """The folder of the results of `one`, made anew where it is not up to date."""
    folder = out / one.folder
    said, summary = folder / "settings.json", folder / "summary.json"
    settings = json.dumps([one.case, one.arguments(), one.threads])
    newest = max(os.path.getmtime(program), os.path.getmtime(ROOT / one.case))
    if (said.exists() and said.read_text() == settings and summary.exists() and summary.stat().st_mtime > newest
            and json.loads(summary.read_text())["status"] in ("done", "failed")):
        return folder
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{one.study}: {one.name}", file=sys.stderr, flush=True)
    command = [program, "run", str(ROOT / one.case), "--out", str(folder), "--threads", str(one.threads), "--quiet", "--overwrite"]
    done = subprocess.run(command + one.arguments(), capture_output=True, text=True, check=False)
    if done.stderr.strip():
        print(done.stderr.strip(), file=sys.stderr, flush=True)
    if not summary.exists():
        raise SystemExit(f"{one.study}, {one.name}: no result")
    said.write_text(settings)
    return folder


# Measuring -------------------------------------------------------------------------------------------------------------

def mass(frame):
    return frame["density"] * frame["volume"]


def beyond(x, weight, share):
    """The place that `share` of the weight lies behind."""
    order = np.argsort(x)
    total = np.cumsum(weight[order])
    return x[order][np.searchsorted(total, share * total[-1])]


def start_of_cut(folder, summary):
    """The frame before the first removal."""
    start = next((stage["start"] for stage in summary["stages"] if stage["removal"]), 0.0)
    return vtu.read_vtu([path for time, path in vtu.read_pvd(folder / "points.pvd") if time <= start + 1e-9][-1])


def bonds_lost(folder, summary, frame, place):
    """Shares of R_b - 1 that went since the cut, of the soil that was at x < behind and x > front then."""
    if "R_b" not in frame:
        return {}
    before = start_of_cut(folder, summary)
    then = before["R_b"][np.searchsorted(before["id"], frame["id"])] - 1
    x = (frame["Points"] - frame["displacement"])[:, 0]
    return {name: 1 - (frame["R_b"][mine] - 1).sum() / then[mine].sum()
            for name, mine in (("behind", x < place["behind"]), ("front", x > place["front"]))}


def begins(folder):
    """When the slide begins: time since the start of the last stage at which the kinetic energy first is above 5 kJ/m."""
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        history = [(int(row["stage"]), float(row["time"]), float(row["kinetic_energy"])) for row in csv.DictReader(file)]
    last = [(time, energy) for stage, time, energy in history if stage == history[-1][0]]
    return next((time - last[0][0] for time, energy in last if energy > 5), np.nan)


def measure_cut(folder, summary, frame, place):
    """Of the soil that moved by more than 1 m: how far beyond place["x"] 98 % of its mass and all of it lie, the
    least x that it came from above place["above"], its mass, how far it moved."""
    length = np.linalg.norm(frame["displacement"], axis=1)
    moved = length > 1.0
    found = {"moved": mass(frame)[moved].sum(), "begins": begins(folder), **bonds_lost(folder, summary, frame, place)}
    if moved.any():
        x, origin = frame["Points"][moved, 0], (frame["Points"] - frame["displacement"])[moved]
        high = origin[origin[:, 1] > place["above"], 0]
        weight = mass(frame)[moved]
        found |= {"mean": np.average(length[moved], weights=weight), "toe": beyond(x, weight, 0.98) - place["x"],
                  "furthest": x.max() - place["x"], "crest": high.min() if len(high) else np.nan}
    return found


def measure_column(folder, summary, frame, place):
    """Run-out over L0 = 1: of 98 % of the mass, and of the deposit as far as it has no gap wider than an element; height at
    the wall; volume of what is still there over that at the start."""
    x, spacing = np.sort(frame["Points"][:, 0]), place["h"] / 2
    gaps = np.flatnonzero(np.diff(x) > place["h"])
    front = x[gaps[0]] if len(gaps) else x[-1]
    at_wall = frame["Points"][frame["Points"][:, 0] < 2 * place["h"], 1]
    first = vtu.read_vtu(vtu.read_pvd(folder / "points.pvd")[0][1])
    kept = first["volume"][np.searchsorted(first["id"], frame["id"])]
    return {"toe": beyond(frame["Points"][:, 0], mass(frame), 0.98) - 1, "furthest": front + spacing / 2 - 1,
            "height": at_wall.max() + spacing / 2, "volume": frame["volume"].sum() / kept.sum(), "moved": np.nan}


def measure_gap(folder, summary, frame, place):
    """What is between bed and block under its middle, in parts of an element."""
    y, spacing, middle = frame["Points"][:, 1], place["h"] / 2, np.abs(frame["Points"][:, 0] - 3) < 0.5
    bed, block = (y[middle & (frame["region"] == region)] for region in (0, 1))
    return {"height": (block.min() - bed.max() - spacing) / place["h"]}


MEASURES = {"cut": measure_cut, "column": measure_column, "gap": measure_gap}


def measure(one, folder):
    summary = json.loads((folder / "summary.json").read_text())
    frame = vtu.read_vtu(vtu.read_pvd(folder / "points.pvd")[-1][1])
    row = {"study": one.study, "name": one.name, "status": summary["status"], "steps": summary["steps"],
           "wall": summary["wall_seconds"], "energy_error": summary["energy_error"],
           "largest_energy_error": summary["largest_energy_error"], "removed": summary["removed_points"],
           "separated": frame["separated"].mean(), "speed": np.linalg.norm(frame["velocity"], axis=1).max()}
    return row | MEASURES[one.measure](folder, summary, frame, one.place)


# Writing ---------------------------------------------------------------------------------------------------------------

DIGITS = {"begins": 1, "mean": 2, "toe": 2, "furthest": 2, "crest": 2, "moved": 1, "behind": 3, "front": 3,
          "height": 2, "volume": 3, "separated": 2, "speed": 2, "energy_error": 4, "largest_energy_error": 4, "wall": 0}


def cell(key, value):
    if value is None or value == "" or (isinstance(value, float) and np.isnan(value)):
        return ""
    return f"{float(value):.{DIGITS[key]}f}" if key in DIGITS else str(value)


def print_table(rows, keys):
    print("| " + " | ".join(keys) + " |\n" + "| --- " * len(keys) + "|")
    for row in rows:
        print("| " + " | ".join(cell(key, row.get(key)) for key in keys) + " |")


def save(rows, runs):
    """In the order of `runs`. Of those that were not made this time the rows stay."""
    found = {}
    if CSV.exists():
        with open(CSV, newline="", encoding="utf-8") as file:
            found = {(row["study"], row["name"]): {key: row.get(key) for key in FIELDS} for row in csv.DictReader(file)}
    found |= {(row["study"], row["name"]): {key: cell(key, row.get(key)) for key in FIELDS} for row in rows}
    with open(CSV, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, FIELDS, lineterminator="\n")
        table.writeheader()
        table.writerows(found[one.study, one.name] for one in runs if (one.study, one.name) in found)


def same_frames(one, other):
    """Do two folders hold the same frames to the last bit?"""
    names = sorted(path.name for path in one.glob("points_*.vtu"))
    return names == sorted(path.name for path in other.glob("points_*.vtu")) and all(
        (one / name).read_bytes() == (other / name).read_bytes() for name in names)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/bin/scarp"), help="(build/bin/scarp)")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/robustness", help="(build/robustness)")
    parser.add_argument("--only", nargs="*", help="names of studies")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    chosen = studies(options.out)
    for name in options.only or chosen:
        rows = []
        for one in chosen[name]:
            rows.append(measure(one, run(options.program, one, options.out)))
            save(rows, [one for each in chosen.values() for one in each])
        print(f"\n{name}\n")
        print_table(rows, [key for key in FIELDS if any(cell(key, row.get(key)) for row in rows) and key != "wall"])
        if name == "threads":
            one = run(options.program, chosen["steps"][1], options.out)
            print("\nthe same bits with one thread:", same_frames(options.out / chosen[name][0].folder, one))


if __name__ == "__main__":
    main()
