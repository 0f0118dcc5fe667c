#!/usr/bin/env python3
"""Lists where src/scarp computes each equation of the report, 1 to 38: the lines of code that end in `// eq. N`.

Prints "eq. N  file:line" for each and exits with 1 where a number has no line; `--self-test` checks the check.
"""

import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
LAST = 38
NUMBER = re.compile(r"\beq\. (\d+)\b")
SOURCES = {".hpp", ".cpp"}


def equations_in(line):
    """Of a line with code before its comment; what a declaration is for (`///<`) computes nothing."""
    code, mark, comment = line.partition("//")
    computes = mark and code.strip() and not comment.startswith("/")
    return [int(n) for n in NUMBER.findall(comment)] if computes else []


def places(source):
    """{number: ["file:line", ...]} in the order of the files."""
    found = {}
    for path in sorted(p for p in source.rglob("*") if p.suffix in SOURCES):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for equation in equations_in(line):
                found.setdefault(equation, []).append(f"{path.relative_to(source.parents[1])}:{number}")
    return found


def missing(found):
    return [n for n in range(1, LAST + 1) if n not in found]


def self_test():
    assert equations_in("  a = b;  // eq. 7 and eq. 8") == [7, 8]
    assert equations_in("  // eq. 7: a line without code") == []
    assert equations_in("  a = b;  // as eqs 7–9") == []
    assert equations_in("  double m;  ///< eq. 1") == []
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "src" / "scarp"
        source.mkdir(parents=True)
        (source / "a.hpp").write_text("".join(f"x;  // eq. {n}\n" for n in range(1, LAST) if n != 12))
        found = places(source)
        assert missing(found) == [12, LAST], missing(found)
        assert found[13] == ["src/scarp/a.hpp:12"], found[13]


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return 0
    found = places(ROOT / "src" / "scarp")
    for n in sorted(found):
        print(f"eq. {n:<3} {', '.join(found[n])}")
    for n in missing(found):
        print(f"eq. {n} is computed nowhere: end the line that does with // eq. {n}")
    return 1 if missing(found) else 0


if __name__ == "__main__":
    sys.exit(main())
