"""Where the reference curves have kinks, and which of them the errors of Dormand-Prince come from.

Each increment is followed in a hundred parts to find where plastic strain sets in, where it ends, and where the
direction of eq. 32 turns round. Prints the tables of docs/integration.md.
"""

import pathlib
import tempfile

import numpy as np

from laboratory import COMPONENTS, ROOT, arguments, lab
from work_precision import LIMIT, WAYS, references, relative_error

PARTS = 100
TOLERANCES = [10.0**-k for k in range(4, 10)]
ONCE = np.array([1, 1, 1, 2, 2, 2])  # tensor components to a full contraction


def tensor(curve, key):
    return np.array([curve[key + c] for c in COMPONENTS]).T


def finer(reference, way):
    """The same test with every increment in PARTS."""
    if way == "program":
        return {**reference, "name": reference["name"] + "_fine",
                "program": [{**stage, "n": stage["n"] * PARTS} for stage in reference["program"]]}
    eps = np.array([row[:6] for row in reference["replay"]], dtype=float)
    rows = [a + (b - a) * j / PARTS for a, b in zip(eps[:-1], eps[1:]) for j in range(1, PARTS + 1)]
    return {**reference, "name": reference["name"] + "_fine", "replay": [eps[0], *rows]}


def kinks(curve):
    """By increment (from 1): what happens in it. Each is (kind, value)."""
    p = curve["p"][:, None]
    s_bar = tensor(curve, "sig_") - p * tensor(curve, "beta_")
    s_bar[:, :3] -= p
    size = np.sqrt((s_bar**2 * ONCE).sum(axis=1))
    grown = np.abs(np.diff(tensor(curve, "epsp_"), axis=0)).max(axis=1)
    plastic = np.concatenate([[grown[0] > 0], grown > 0])
    found = {}
    for i in range(1, len(plastic)):
        here = found.setdefault(i // PARTS + 1, [])
        cosine = (s_bar[i] * s_bar[i - 1] * ONCE).sum() / max(size[i] * size[i - 1], 1e-300)
        if size[i] > 1e-9 and cosine < 0.3:
            here.append(("turn", size[i]))
        if plastic[i] and not plastic[i - 1]:
            here.append(("onset", curve["R"][i - 1]))
        if plastic[i - 1] and not plastic[i]:
            here.append(("unloading", curve["R"][i - 1]))
    return found


def text(here):
    words = {"turn": "s̄ turns round", "onset": "onset of plastic strain at R = {:.2g}", "unloading": "unloading"}
    return ", ".join(words[kind].format(value) for kind, value in here) or "no kink"


def growth(errors):
    return np.abs(np.diff(errors, axis=0, prepend=0 * errors[:1])).max(axis=1)


def heading(*names):
    print("\n| " + " | ".join(names) + " |\n" + "| --- " * len(names) + "|")


def line(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def print_kinks(name, way, found):
    every = [event for here in found.values() for event in here]
    R = [value for kind, value in every if kind == "onset"]
    count = {kind: sum(event[0] == kind for event in every) for kind in ("onset", "unloading", "turn")}
    span = f" ({min(R):.2g} to {max(R):.2g})" if R else ""
    print(line(name, way, f"{count['onset']}{span}", count["unloading"], count["turn"]), flush=True)


def large_errors(program, test, name, way, found):
    """Lines of a table: where errors above the tolerance grow most."""
    limit, _ = lab(program, test, f"integration.tolerance={LIMIT}")
    lines = []
    for tolerance in TOLERANCES:
        curve, _ = lab(program, test, f"integration.tolerance={tolerance!r}")
        for key, what in (("sig_", "stress"), ("eps_", "strain")):
            of_limit = tensor(limit, key)
            errors = (tensor(curve, key) - of_limit) / np.abs(of_limit).max() / tolerance
            most, row = np.abs(errors).max(), int(growth(errors).argmax())
            if most > 1:
                lines.append(line(name, way, what, f"{tolerance:.0e}", f"{most:.2g}", row + 1,
                                  f"{growth(errors)[row]:.2g}", text(found.get(row + 1, []))))
    return lines


def print_cyclic(program):
    """The example of cyclic triaxial loading, whose strains show what is missed."""
    heading("scheme", "tolerance", "stress error / tolerance", "strain error / tolerance")
    test, cycles = ROOT / "examples/lab/cyclic_triaxial.toml", "stage.0.cycles=20"
    limit, _ = lab(program, test, cycles, f"integration.tolerance={LIMIT}")
    for scheme in ("modified-euler", "dormand-prince"):
        for tolerance in TOLERANCES:
            curve, _ = lab(program, test, cycles, f"integration.tolerance={tolerance!r}",
                           f"integration.scheme={scheme}")
            errors = [relative_error(tensor(curve, key), tensor(limit, key))[0] for key in ("sig_", "eps_")]
            print(line(scheme, f"{tolerance:.0e}", *(f"{e / tolerance:.2g}" for e in errors)))


def main():
    program = arguments(__doc__).parse_args().program
    heading("curve", "way", "onsets of plastic strain (R there)", "unloadings", "turns of s̄")
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        for reference in references():
            for way, write in WAYS.items():
                test = write(reference, pathlib.Path(folder))
                fine = write(finer(reference, way), pathlib.Path(folder))
                found = kinks(lab(program, fine, "integration.tolerance=1e-11")[0])
                print_kinks(reference["name"], way, found)
                lines += large_errors(program, test, reference["name"], way, found)
    heading("curve", "way", "of", "tolerance", "error / tolerance", "grows most in increment", "by", "there")
    print("\n".join(lines))
    print_cyclic(program)


if __name__ == "__main__":
    main()
