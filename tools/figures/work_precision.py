"""Error against work: the ten reference curves of tests/material by both schemes over tolerances 1e-2 ... 1e-11.

Draws docs/figures/work_precision.png, writes docs/figures/work_precision.csv and prints the tables of
docs/integration.md. Takes some minutes.

The reference has 11 digits (replay) and 8 to 10 (curve). Below them the error is measured against the limit that scarp
itself tends to, Dormand-Prince at 1e-13.
"""

import csv
import json
import pathlib
import sys
import tempfile

import numpy as np

from laboratory import COMPONENTS, ROOT, arguments, lab, pyplot

TOLERANCES = [10.0**-k for k in range(2, 12)]
SCHEMES = ("modified-euler", "dormand-prince")
OUT = ROOT / "docs/figures"
LIMIT = 1e-13
ERRORS = ("stress", "strain", "limit_stress", "limit_strain")
FIELDS = ("curve", "way", "scheme", "tolerance", "substeps", *ERRORS, "row", "says")
ASYMPTOTIC = (1e-4, 1e-10)  # tolerances between which an order is read off


def material_text(reference):
    lines = ["[material]", 'model = "subloading"']
    lines += [f"{key} = {float(value)!r}" for key, value in reference["params"].items()]
    initial = reference["initial"]
    lines += ["[initial]", f"stress = {floats(initial['sigma'])}", f"p_c = {float(initial['p_c'])!r}",
              f"R_b = {float(initial['R_b'])!r}", f"beta = {floats(initial['beta'])}", f"a = {floats(initial['a'])}"]
    return lines + ["[integration]", "tolerance = 1e-7", 'scheme = "dormand-prince"']


def floats(values):
    return [float(x) for x in values]


def write_replay(reference, folder):
    """The strain points reached along straight segments."""
    path = folder / f"{reference['name']}.csv"
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join("eps_" + c for c in COMPONENTS) + "\n")
        for row in reference["replay"][1:]:
            file.write(",".join(repr(float(x)) for x in row[:6]) + "\n")
    test = folder / f"{reference['name']}_replay.toml"
    stage = ["[[stage]]", 'type = "strain-path"', f'file = "{path.name}"']
    test.write_text("\n".join(material_text(reference) + stage) + "\n")
    return test


def write_program(reference, folder):
    """The constraints that the curve was made under."""
    lines = material_text(reference)
    for stage in reference["program"]:
        rows = np.array(stage["constraints"], dtype=float)
        lines += ["[[stage]]", 'type = "constraints"', f"increments = {stage['n']}", f"E = {rows[:, :6].tolist()}",
                  f"S = {rows[:, 6:12].tolist()}", f"b = {rows[:, 12].tolist()}"]
    test = folder / f"{reference['name']}_program.toml"
    test.write_text("\n".join(lines) + "\n")
    return test


def relative_error(found, expected):
    """Largest error of a component over the largest component, and the row (from 1) that has it."""
    n = len(found)
    difference = np.abs(found - expected[:n]).max(axis=1)
    return difference.max() / np.abs(expected).max(), int(difference.argmax()) + 1


def run(program, test, scheme, tolerance):
    """Rows of strain and stress, substeps over the whole curve, and what the program says."""
    curve, says = lab(program, test, f"integration.tolerance={tolerance!r}", f"integration.scheme={scheme}")
    found = np.array([curve[k + c] for k in ("eps_", "sig_") for c in COMPONENTS]).T
    return found, int(curve["substeps"].sum()), says.split("\n")[0]


def measure(program, test, scheme, tolerance, expected, limit):
    found, substeps, says = run(program, test, scheme, tolerance)
    result = {"scheme": scheme, "tolerance": tolerance, "substeps": substeps, "says": says}
    if len(found) < len(expected):
        return {**result, **dict.fromkeys(ERRORS, np.nan), "row": len(found) + 1}
    of_limit, row = relative_error(found[:, 6:], limit[:, 6:])
    return {**result, "row": row, "limit_stress": of_limit,
            "limit_strain": relative_error(found[:, :6], limit[:, :6])[0],
            "stress": relative_error(found[:, 6:], expected[:, 6:])[0],
            "strain": relative_error(found[:, :6], expected[:, :6])[0]}


def references():
    for path in sorted((ROOT / "tests/material/reference").glob("*.json")):
        yield json.loads(path.read_text())


WAYS = {"replay": write_replay, "program": write_program}


def measure_all(program):
    results = []
    with tempfile.TemporaryDirectory() as name:
        for reference in references():
            for way, write in WAYS.items():
                test = write(reference, pathlib.Path(name))
                expected = np.array(reference["replay" if way == "replay" else "curve"], dtype=float)[1:, :12]
                limit = run(program, test, "dormand-prince", LIMIT)[0]
                for scheme in SCHEMES:
                    for tolerance in TOLERANCES:
                        one = measure(program, test, scheme, tolerance, expected, limit)
                        results.append({"curve": reference["name"], "way": way, **one})
            print(reference["name"], file=sys.stderr, flush=True)
    return results


def save(results):
    with open(OUT / "work_precision.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, FIELDS, lineterminator="\n")
        table.writeheader()
        for r in results:
            table.writerow({**r, "tolerance": f"{r['tolerance']:.0e}", **{e: f"{r[e]:.2e}" for e in ERRORS}})


def of(results, way, scheme, name):
    return [r for r in results if (r["curve"], r["way"], r["scheme"]) == (name, way, scheme)]


def slope(x, y):
    return np.polyfit(np.log10(x), np.log10(y), 1)[0]


def print_tables(results):
    """Error over tolerance at each tolerance; the power of the tolerance and of the substeps that errors follow."""
    names = sorted({r["curve"] for r in results})
    for way, key in (("replay", "stress"), ("replay", "limit_stress"), ("program", "limit_stress"),
                     ("program", "limit_strain")):
        for scheme in SCHEMES:
            print(f"\n{way}, {scheme}: {key} error over tolerance; error ~ tolerance^a, error ~ substeps^-b\n")
            print("| curve | " + " | ".join(f"{t:.0e}" for t in TOLERANCES) + " | a | b |")
            print("| --- " * (len(TOLERANCES) + 3) + "|")
            for name in names:
                mine = of(results, way, scheme, name)
                used = [r for r in mine if ASYMPTOTIC[1] * 0.99 <= r["tolerance"] <= ASYMPTOTIC[0] * 1.01]
                error = [max(r[key], 1e-300) for r in used]
                a = slope([r["tolerance"] for r in used], error)
                b = -slope([r["substeps"] for r in used], error)
                cells = [f"{r[key] / r['tolerance']:.2g}" for r in mine]
                print(f"| {name} | " + " | ".join(cells) + f" | {a:.2f} | {b:.1f} |")


PANELS = (("replay", "stress", "strain replay:\nlargest stress error / largest stress"),
          ("program", "limit_stress", "constraint program:\nlargest stress error / largest stress"),
          ("program", "limit_strain", "constraint program:\nlargest strain error / largest strain"))


def draw(results):
    plt = pyplot()
    names = sorted({r["curve"] for r in results})
    colours = plt.get_cmap("tab10")(np.arange(len(names)))
    figure, axes = plt.subplots(3, 2, figsize=(8.6, 10.5), sharex="col")
    ends = np.array([1e-2, 1e-11])
    for (left, right), (way, key, text) in zip(axes, PANELS):
        for name, colour in zip(names, colours):
            for scheme, marker in zip(SCHEMES, ("s--", "o-")):
                mine = of(results, way, scheme, name)
                error = np.array([max(r[key], 1e-13) for r in mine])
                label = name if scheme == "dormand-prince" else None
                style = {"color": colour, "ms": 2.5, "lw": 0.8, "label": label}
                left.loglog([r["substeps"] for r in mine], error, marker, **style)
                right.loglog(TOLERANCES, error, marker, **style)
        right.loglog(ends, 10 * ends, "k-", lw=1.2)
        right.loglog(ends, ends, "k:", lw=1.2)
        left.set_ylabel(text)
        for one in (left, right):
            one.set_ylim(5e-14, 0.2)
    axes[2, 0].set_xlabel("substeps over the whole curve")
    axes[2, 1].set_xlabel("tolerance")
    axes[2, 1].invert_xaxis()
    axes[0, 0].set_title("error against work")
    axes[0, 1].set_title("error against tolerance")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=5,
                  title="circles: Dormand–Prince; squares, dashed: modified Euler; "
                        "black: 10 × tolerance, dotted: tolerance")
    figure.tight_layout(rect=(0, 0.055, 1, 1))
    figure.savefig(OUT / "work_precision.png", dpi=80)


def main():
    program = arguments(__doc__).parse_args().program
    OUT.mkdir(parents=True, exist_ok=True)
    results = measure_all(program)
    save(results)
    print_tables(results)
    draw(results)


if __name__ == "__main__":
    main()
