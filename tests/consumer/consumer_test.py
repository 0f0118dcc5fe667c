"""Installs scarp into a folder and builds a project of somebody else's against it. Usage:
consumer_test.py CMAKE BUILD_FOLDER WORK_FOLDER GENERATOR COMPILER VERSION [TEST ...]

What must not reach that project: the processor that scarp was compiled for, its warnings, its optimisation. What must:
OpenMP, for headers that hold loops, and C++20.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
CMAKE, BUILD, WORK, GENERATOR, COMPILER, VERSION = sys.argv[1:7]
INSTALLED, CONSUMER = os.path.join(WORK, "installed"), os.path.join(WORK, "build")


def done(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=300)


def configured(folder, version):
    return done(CMAKE, "-S", HERE, "-B", folder, "-G", GENERATOR, f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DCMAKE_BUILD_TYPE=Release",
                f"-DCMAKE_PREFIX_PATH={INSTALLED}", f"-DWANTED_VERSION={version}", "-DCMAKE_CXX_FLAGS=")


def weak_or_strong(symbols):
    """The functions and data that an object file defines, from nm."""
    return [line.split(" ", 2)[2] for line in symbols.splitlines() if re.match(r"[0-9a-f]+ [A-Zuvw] ", line)]


class Consumer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        for step in (lambda: done(CMAKE, "--install", BUILD, "--prefix", INSTALLED),
                     lambda: configured(CONSUMER, VERSION),
                     lambda: done(CMAKE, "--build", CONSUMER)):
            result = step()
            if result.returncode != 0:
                raise AssertionError(f"{result.args}\n{result.stdout}{result.stderr}")
        with open(os.path.join(CONSUMER, "compile_commands.json"), encoding="utf-8") as file:
            cls.commands = {os.path.basename(entry["file"]): shlex.split(entry["command"]) for entry in json.load(file)}

    def test_its_answers_are_those_of_closed_forms(self):
        for name in ("consumer", "batches"):
            result = done(os.path.join(CONSUMER, name))
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            if name == "consumer":
                self.assertEqual(result.stdout.splitlines()[0], f"scarp {VERSION}")

    def test_no_flags_of_ours_reach_it(self):
        words = self.commands["main.cpp"]
        ours = [word for word in words if re.match(r"-[Wmf]|-D", word) and word != "-DNDEBUG"]
        self.assertEqual([word for word in ours if not word.startswith("-fopenmp")], [], words)
        self.assertTrue(any(word.startswith("-fopenmp") for word in words), words)
        self.assertFalse(any("-march" in word for word in words), words)

    def test_batches_are_as_wide_as_ours(self):
        words = self.commands["batches.cpp"]
        self.assertEqual(len([word for word in words if word.startswith("-march=")]), 1, words)
        self.assertFalse(any(re.match(r"-W|-ffast-math|-Ofast", word) for word in words), words)

    def test_it_makes_nothing_that_goes_by_the_processor(self):
        # Such a function of the same name, made for another processor, could take the place of the library's own.
        (path,) = [os.path.join(where, name) for where, _, names in os.walk(CONSUMER) for name in names if name == "main.cpp.o"]
        names = weak_or_strong(done("nm", "--demangle", path).stdout)
        self.assertIn("main", names)
        self.assertEqual([name for name in names if re.search(r"xsimd|scarp::transfer::", name)], [])

    def test_another_version_is_refused(self):
        result = configured(os.path.join(WORK, "refused"), "99.0")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn('version "99.0"', " ".join(result.stderr.split()))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[7:])
