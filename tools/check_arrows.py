#!/usr/bin/env python3
"""Checks the includes of src/scarp against the arrows of docs/architecture.md.

An include of another folder must follow an arrow; OpenMP is for exec/ only, MPI and PETSc for comm/ only, toml++ for
input/ only, HDF5 for io/ only. The picture on that page must be that of the arrows, which `--picture` prints. Prints each breach as
file:line and exits with 1 where there is one; `--self-test` checks the check.
"""

import pathlib
import re
import sys
import tempfile

# What each folder may include besides itself.
ARROWS = {
    "base": set(),
    "tensor": {"base"},
    "material": {"base", "tensor"},
    "lab": {"base", "tensor", "material"},
    "mesh": {"base", "tensor"},
    "points": {"base", "tensor", "material"},
    "transfer": {"base", "tensor", "material", "mesh", "points"},
    "boundary": {"base", "tensor", "material", "mesh", "points"},
    "exec": {"base", "tensor", "material", "mesh", "points", "transfer"},
    "comm": {"base"},
    "io": {"base", "tensor", "material", "mesh", "points"},
    "step": {"base", "tensor", "material", "mesh", "points", "transfer", "boundary", "exec", "comm"},
    "input": {"base", "tensor", "material", "lab", "mesh"},
    "run": {"base", "tensor", "material", "lab", "mesh", "points", "transfer", "boundary", "exec", "comm", "step", "io", "input"},
}
# What only one folder may have: (pattern, folder).
RESERVED = [
    (re.compile(r'#\s*include\s*[<"]omp\.h[>"]|#\s*pragma\s+omp\b'), "exec"),
    (re.compile(r'#\s*include\s*[<"](mpi\.h|petsc)'), "comm"),
    (re.compile(r'#\s*include\s*[<"]toml'), "input"),
    (re.compile(r'#\s*include\s*[<"]hdf5'), "io"),
]
INCLUDE = re.compile(r'#\s*include\s*[<"]scarp/([^/">]+)/')
SOURCES = {".hpp", ".cpp", ".h", ".inl"}


def breaches(source):
    """["file:line: what", ...] in the order of the files."""
    found = []
    for path in sorted(p for p in source.rglob("*") if p.suffix in SOURCES):
        folder = path.relative_to(source).parts[0]
        if folder not in ARROWS:
            found.append(f"{path}:1: the folder {folder}/ has no arrows; add it to tools/check_arrows.py")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            other = INCLUDE.search(line)
            if other and other[1] != folder and other[1] not in ARROWS[folder]:
                found.append(f"{path}:{number}: {folder}/ may not include {other[1]}/")
            for pattern, owner in RESERVED:
                if pattern.search(line) and folder != owner:
                    found.append(f"{path}:{number}: only {owner}/ may have {line.strip()}")
    return found


def picture(arrows):
    """The arrows as Mermaid draws them, without those that others imply."""
    lines = ["```mermaid", "flowchart LR"]
    for folder, below in arrows.items():
        implied = set().union(*(arrows[other] for other in below)) if below else set()
        lines += [f"    {other} --> {folder}" for other in arrows if other in below - implied]
    return "\n".join([*lines, "    run --> apps", "```"])


def self_test():
    if picture({"a": set(), "b": {"a"}, "c": {"a", "b"}}).count("-->") != 3:  # a to b, b to c, run to apps
        sys.exit("self-test: the picture has arrows that others imply, or lacks some")
    cases = [
        ("material/a.hpp", '#include "scarp/tensor/sym.hpp"', 0),
        ("material/a.hpp", '#include "scarp/mesh/mesh.hpp"', 1),
        ("step/a.cpp", "#pragma omp parallel for", 1),
        ("exec/a.cpp", "#pragma omp parallel for", 0),
        ("run/a.cpp", "#include <toml++/toml.h>", 1),
        ("step/a.cpp", "#include <mpi.h>", 1),
        ("step/a.cpp", '#include "scarp/io/vtu.hpp"', 1),
        ("exec/a.cpp", '#include "scarp/comm/alone.hpp"', 1),
        ("step/a.cpp", '#include "scarp/comm/alone.hpp"', 0),
        ("comm/a.hpp", '#include "scarp/mesh/mesh.hpp"', 1),
        ("cellar/a.cpp", "", 1),
    ]
    for name, text, expected in cases:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir()
            path.write_text(text + "\n", encoding="utf-8")
            found = breaches(pathlib.Path(folder))
            if len(found) != expected:
                sys.exit(f"self-test: {name} with {text!r} gave {found}, expected {expected}")


def main():
    self_test()
    if sys.argv[1:] == ["--self-test"]:
        return
    if sys.argv[1:] == ["--picture"]:
        print(picture(ARROWS))
        return
    root = pathlib.Path(__file__).resolve().parent.parent
    page = root / "docs" / "architecture.md"
    found = breaches(root / "src" / "scarp")
    if picture(ARROWS) not in page.read_text(encoding="utf-8"):
        found.append(f"{page}:1: the picture is not that of the arrows; replace it by `tools/check_arrows.py --picture`")
    print("\n".join(found) if found else "all includes follow the arrows")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
