"""The documents: links, the index of docs/, the length of README.md, the commands that are quoted, the case in README.md, and one
version everywhere. Usage: documents_test.py PROGRAM [TEST ...]

PlantedErrors writes a small tree of pages, spoils it in one way after the other, and demands that each is found.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import pages

ROOT = Path(__file__).resolve().parent.parent.parent
LONGEST_README = 120
PROGRAM = os.path.abspath(sys.argv.pop(1))


def help_of(subcommand):
    done = subprocess.run([PROGRAM, *([subcommand] if subcommand else []), "--help"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done
    return done.stdout


class Documents:
    """What is checked of a tree of pages; made for the project, and for trees with an error in them."""

    def __init__(self, root, program):
        self.root, self.program = root, program
        self.pages = pages.pages_of(root)

    def case_exists(self, page, name):
        """A case file from the root or from beside the page; of the examples where docs/ name one; or the one that README.md shows."""
        places = [self.root / name, page.path.parent / name]
        if self.root / "docs" in page.path.parents:
            places += self.root.glob(f"examples/*/{name}")
        return any(place.is_file() for place in places) or name in self.shown_cases()

    def shown_cases(self):
        """Case files that README.md shows whole: blocks whose first line is a comment with the file's name."""
        found = {}
        for language, _, lines in self.pages[self.root / "README.md"].fenced:
            name = re.match(r"# ([\w-]+\.toml)\b", lines[0]) if language == "toml" and lines else None
            if name:
                found[name[1]] = "\n".join(lines) + "\n"
        return found

    def problems(self):
        found = pages.broken_links(self.root, self.pages) + pages.unlisted_pages(self.root, self.pages)
        found += pages.too_long(self.root / "README.md", LONGEST_README)
        targets = pages.targets_of(self.root / "Makefile")
        for page in self.pages.values():
            found += pages.wrong_commands(page, targets, self.program, lambda name, page=page: self.case_exists(page, name))
        version = pages.version_of(self.root / "src/scarp/base/version.hpp")
        return found + pages.other_versions(version, self.root / "CITATION.cff", self.root / "CHANGELOG.md")


class TheProject(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.documents = Documents(ROOT, pages.Program(help_of))

    def test_pages(self):
        self.assertEqual(self.documents.problems(), [])

    def test_there_is_something_to_check(self):
        readme = self.documents.pages[ROOT / "README.md"]
        self.assertGreater(len(readme.links()), 20)
        self.assertGreater(len(readme.commands()), 8)
        self.assertGreater(sum(len(page.links()) for page in self.documents.pages.values()), 200)
        self.assertLessEqual({"run", "check", "lab", "models", "plot"}, self.documents.program.subcommands)

    def test_the_program_has_that_version(self):
        done = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stdout.split()[1], pages.version_of(ROOT / "src/scarp/base/version.hpp"))

    def test_the_case_of_the_readme_fails_as_it_says(self):
        (name, text), = self.documents.shown_cases().items()
        self.assertLessEqual(len([line for line in text.splitlines() if line and not line.startswith("#")]), 10)
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, name).write_text(text, encoding="utf-8")
            done = subprocess.run([PROGRAM, "run", name, "--out", "r", "--threads", "1", "--quiet"], cwd=folder, capture_output=True,
                                  text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            summary = json.loads(Path(folder, "r", "summary.json").read_text(encoding="utf-8"))
        self.assertEqual((summary["status"], summary["failures"], summary["warnings"]), ("done", 0, []))
        # It slides by more than its height, and does not leave the mesh.
        self.assertGreater(summary["stages"][-1]["max_displacement"], 6)
        self.assertEqual(summary["removed_points"], 0)


GOOD = {
    "README.md": """# Program

See [docs](docs/README.md), [a place](docs/one.md#a-section-with-code-1) and <https://example.org>.

    make demo      # builds
    scarp run examples/a/a.toml --out DIR [--set key=value]...
    scarp run bank.toml && scarp check bank.toml

```toml
# bank.toml: shown whole
title = "[no link](nowhere.md)"
```
""",
    "CHANGELOG.md": "# Changes\n\n## [Unreleased]\n\nIt becomes 1.2.3.\n\n## [1.0.0] - 2026-01-01\n\n- All.\n",
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.3\n",
    "CONTRIBUTING.md": "# How\n\n`make demo` and `scarp check examples/a/a.toml`, [this](#how).\n",
    "Makefile": ".PHONY: demo\nBUILD := build\ndemo: build\n\techo\nbuild:\n\techo\n",
    "docs/README.md": "# Pages\n\n- [One](one.md)\n- [Two](models/two.md)\n",
    "docs/one.md": "# One\n\n## A section, with `code`\n\n## A section with code\n\n- a list\n\n      scarp is no command here\n",
    "docs/models/two.md": "# Two\n\n[up](../one.md#one)\n\n```\nscarp run a.toml\n```\n",
    "examples/a/README.md": "# A\n\n    scarp run a.toml\n\n![picture](a.png)\n",
    "examples/a/a.png": "",
    "examples/a/a.toml": "",
    "src/scarp/base/version.hpp": 'inline constexpr const char* version = "1.2.3";\n',
}
HELP = {"": "Options:\n  --version   it\n\nSubcommands:\n  run    Run\n  check  Look\n", "run": "  --out TEXT\n  --set TEXT\n", "check": "  --set TEXT\n"}

# File, what stands there, what is planted in its place, what is said.
PLANTED = [
    ("README.md", "docs/README.md", "docs/nowhere.md", r"README\.md:3: \(docs/nowhere\.md\) is not there"),
    ("README.md", "#a-section-with-code-1", "#a-section-with-code-2", r"README\.md:3: .*no heading of that name"),
    ("README.md", "docs/one.md#a-section-with-code-1", "Makefile#demo", "names a place in what is no page"),
    ("README.md", "docs/one.md#a-section-with-code-1", "../elsewhere.md", "leaves the project"),
    ("README.md", "\n```toml", "\n" * 120 + "```toml", "131 lines, more than 120"),
    ("README.md", "make demo", "make tea", "the Makefile has no target tea"),
    ("README.md", "make demo", "make BUILD", "the Makefile has no target BUILD"),
    ("README.md", "scarp check", "scarp chek", r"README\.md:7: .*scarp has no command chek"),
    ("README.md", "--out DIR", "--into DIR", "scarp run has no option --into"),
    ("README.md", "scarp check bank.toml", "scarp --versoin", "scarp has no option --versoin"),
    ("README.md", "[--set key", "[--sat key", "scarp run has no option --sat"),
    ("README.md", "run examples/a/a.toml", "run examples/a/b.toml", r"there is no file examples/a/b\.toml"),
    ("README.md", "# bank.toml", "# bench.toml", r"there is no file bank\.toml"),
    ("CONTRIBUTING.md", "make demo", "make dema", r"CONTRIBUTING\.md:3: .*no target dema"),
    ("CONTRIBUTING.md", "(#how)", "(#why)", r"CONTRIBUTING\.md:3: .*no heading"),
    ("docs/README.md", "models/two.md", "one.md", r"two\.md:1: docs/README\.md has no link to it"),
    ("docs/models/two.md", "scarp run a.toml", "scarp run b.toml", r"two\.md:6: .*no file b\.toml"),
    ("docs/models/two.md", "../one.md", "one.md", r"two\.md:3: .*is not there"),
    ("examples/a/README.md", "a.png", "b.png", r"a/README\.md:5: .*is not there"),
    ("examples/a/README.md", "scarp run", "scarp run --fast", r"a/README\.md:3: .*scarp run has no option --fast"),
    ("CITATION.cff", "\nversion: 1.2.3", "\nversion: 1.2.4", r"CITATION\.cff:1: version 1\.2\.4, the program is 1\.2\.3"),
    ("CITATION.cff", "\nversion: 1.2.3", "", r"CITATION\.cff:1: version missing"),
    ("CHANGELOG.md", "becomes 1.2.3", "becomes 1.3.0", r"CHANGELOG\.md:1: version 1\.3\.0"),
    ("CHANGELOG.md", "It becomes 1.2.3.", "Nothing.", r"CHANGELOG\.md:1: version 1\.0\.0"),
]


class PlantedErrors(unittest.TestCase):
    def problems_of(self, texts):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in texts.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return Documents(Path(folder), pages.Program(lambda subcommand: HELP[subcommand])).problems()

    def test_a_good_tree_has_none(self):
        self.assertEqual(self.problems_of(GOOD), [])

    def test_each_is_found(self):
        for name, old, new, said in PLANTED:
            with self.subTest(file=name, planted=new):
                self.assertEqual(GOOD[name].count(old), 1)
                found = self.problems_of({**GOOD, name: GOOD[name].replace(old, new)})
                self.assertTrue(found)
                for problem in found:
                    self.assertRegex(problem, said)


if __name__ == "__main__":
    unittest.main()
