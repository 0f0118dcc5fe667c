"""Stops runs at random moments and goes on with them: the results are those of a run that nobody disturbed.

Usage: faults.py PROGRAM [--kills N] [--seed N] [--umat LIBRARY] [--only NAME ...] [--json FILE]

A run is stopped by SIGKILL, SIGTERM, SIGINT or SIGHUP after a random time, with checkpoints at random intervals, on one to three threads; so
is what goes on with it, at random, until it is done. Frames, points.pvd and history.csv are compared byte by byte with the undisturbed
run's, and summary.json but for wall_seconds, ns_per_point_step and threads. Exits with 1 where anything differs.
"""

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import fault_cases

OF_THE_CLOCK = ("wall_seconds", "ns_per_point_step", "threads")
SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP)


def differences(expected, found):
    """(names of the files that differ, bytes compared)"""
    def files(folder):
        return {name for name in os.listdir(folder) if name.endswith((".vtu", ".pvd", ".csv"))}

    def read(folder, name):
        with open(os.path.join(folder, name), "rb") as file:
            return file.read()

    differ, compared = sorted(files(expected) ^ files(found)), 0
    for name in sorted(files(expected) & files(found)):
        first, second = read(expected, name), read(found, name)
        compared += len(first)
        if first != second:
            differ.append(name)
    first, second = (json.loads(read(folder, "summary.json")) for folder in (expected, found))
    differ += [f"summary.json: {key}" for key in first if key not in OF_THE_CLOCK and first[key] != second.get(key)]
    return differ, compared


class Trials:
    def __init__(self, program, folder, seed, umat):
        self.program, self.folder, self.random = program, folder, random.Random(seed)
        self.cases = fault_cases.cases(umat)
        self.undisturbed = {}  # name: seconds
        self.stops = self.starts_again = self.compared = 0
        with open(os.path.join(folder, "triangles.msh"), "w", encoding="utf-8") as file:
            file.write(fault_cases.triangles("triangles.msh"))

    def call(self, *words, stop=None):
        """Runs the program; `stop` is (signal, seconds). Returns (exit status, standard error)."""
        with subprocess.Popen([self.program, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            if stop:
                try:
                    process.wait(stop[1])
                except subprocess.TimeoutExpired:
                    process.send_signal(stop[0])
            error = process.communicate(timeout=300)[1]
            return process.returncode, error

    def prepare(self, name):
        """The undisturbed run of a case, once."""
        if name in self.undisturbed:
            return
        with open(os.path.join(self.folder, name + ".toml"), "w", encoding="utf-8") as file:
            file.write(self.cases[name])
        start = time.monotonic()
        status, error = self.call("run", name + ".toml", "--out", name + ".undisturbed", "--quiet", "--threads", "1")
        if status != 0:
            sys.exit(f"{name} does not run by itself:\n{error}")
        self.undisturbed[name] = time.monotonic() - start

    def stop_at_random(self, seconds):
        return self.random.choice(SIGNALS), self.random.uniform(0, 1.1) * seconds

    def trial(self, name):
        """Stops one run, perhaps several times. Returns what is wrong with its results."""
        self.prepare(name)
        out, seconds = name + ".stopped", self.undisturbed[name]
        shutil.rmtree(os.path.join(self.folder, out), ignore_errors=True)
        checkpoint = self.random.choice(["{ steps = 1 }", "{ steps = %d, keep = %d }" % (self.random.randint(2, 40), self.random.randint(1, 3)),
                                         "{ every = 0.05 }", "{ time = 0.07, every = 0 }", "{}", "{ steps = 13, stages = false }"])
        threads = lambda: str(self.random.randint(1, 3))
        status, error = self.call("run", name + ".toml", "--out", out, "--quiet", "--threads", threads(), "--set", f"output.checkpoint={checkpoint}",
                                  stop=self.stop_at_random(seconds))
        self.stops += 1
        story, from_kept_case = [f"{checkpoint}: {status}"], False
        while True:
            if not os.path.exists(os.path.join(self.folder, out, "case.toml")):  # stopped before there was anything to go on with
                self.starts_again += 1
                status, error = self.call("run", name + ".toml", "--out", out, "--quiet", "--overwrite")
            else:
                again = self.random.random() < 0.4
                self.stops += again
                status, error = self.call("resume", out, "--quiet", "--threads", threads(), stop=self.stop_at_random(seconds) if again else None)
            story.append(str(status))
            from_kept_case = from_kept_case or "has no checkpoint" in error
            if status == 0:
                break
            if status not in (130, -signal.SIGKILL, -signal.SIGTERM, -signal.SIGINT, -signal.SIGHUP):
                return [f"{' '.join(story)}\n{error}"]
        differ, compared = differences(os.path.join(self.folder, name + ".undisturbed"), os.path.join(self.folder, out))
        self.compared += compared
        # A run that was stopped before its first checkpoint starts again from the case that the folder keeps, and its warnings name places
        # in that.
        differ = [what for what in differ if what != "summary.json: warnings" or not from_kept_case]
        return [f"{' '.join(story)}: {what}" for what in differ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--umat", help="the library of tests/data/umat/kinematic.f")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--json")
    arguments = parser.parse_args()
    wrong, start = [], time.monotonic()
    with tempfile.TemporaryDirectory(prefix="scarp_faults_") as folder:
        trials = Trials(os.path.abspath(arguments.program), folder, arguments.seed, arguments.umat and os.path.abspath(arguments.umat))
        names = arguments.only or list(trials.cases)
        trials.random.shuffle(names)
        count = 0
        while trials.stops < arguments.kills:
            name = names[count % len(names)]
            count += 1
            found = trials.trial(name)
            wrong += [f"{name}: {what}" for what in found]
            print(f"{name}: {found or 'the same'}", flush=True)
        figures = {"stops": trials.stops, "runs": count, "cases": len(trials.undisturbed), "started_again": trials.starts_again,
                   "bytes_compared": trials.compared, "minutes": (time.monotonic() - start) / 60, "wrong": wrong}
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=2)
    print("\n".join(wrong))
    print(f"{figures['stops']} stops of {count} runs of {figures['cases']} cases, {figures['bytes_compared']} bytes compared in "
          f"{figures['minutes']:.1f} min: {len(wrong)} differences")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
