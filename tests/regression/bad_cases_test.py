"""Every bad case of the table bad_cases.py: the program ends with status 2 and the whole message. Usage: bad_cases_test.py PROGRAM [TEST ...]

Oracles: the places are counted in the spoilt text; messages are what the program said when it
was read: they guard against change.
"""

import fnmatch
import re

import cases
from bad_bases import BASES, spoilt
from bad_cases import BAD_CASES
from cases import ProgramTest


class Table(ProgramTest):
    def run_on(self, files, words, status):
        for name, text in files.items():
            self.write(name, text)
        return self.scarp(*words, status=status).stderr

    def test_the_good_files_are_good(self):
        for name, (spoilt_file, good, words, files) in BASES.items():
            if name in ("csv", "set"):  # made of nothing, and good as "column"
                continue
            with self.subTest(base=name):
                self.run_on({**files, spoilt_file: good}, words, 0)

    def test_every_bad_case_has_its_message(self):
        self.assertGreaterEqual(len(BAD_CASES), 150)
        for base, old, new, message, remedy in BAD_CASES:
            with self.subTest(base=base, new=new):
                files, words, place = spoilt(base, old, new)
                begin = place if "@" in new or base == "set" else ""
                expected = f"scarp: {begin}{message}\n  remedy: {remedy}\n"
                found = self.run_on(files, words, 2)
                found = found[found.index("scarp: "):]  # warnings go before it
                self.assertTrue(fnmatch.fnmatchcase(found, re.sub(r"([][?])", r"[\1]", expected)), f"\n{found}\n{expected}")

    def test_every_row_stands_once(self):
        self.assertEqual(len(BAD_CASES), len({row[:3] for row in BAD_CASES}))


if __name__ == "__main__":
    cases.main()
