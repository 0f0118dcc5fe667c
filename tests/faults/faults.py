"""Stops runs at random moments, fills their disk, and goes on with them: the results are those of a run that nobody disturbed.

Usage: faults.py PROGRAM [--kills N] [--scan N] [--fills N] [--seed N] [--umat LIBRARY] [--only NAME ...] [--json FILE]

A run is stopped by SIGKILL, SIGTERM, SIGINT or SIGHUP after a random time, with checkpoints at random intervals, on one to three threads; so
is what goes on with it, at random, until it is done. Frames, points.pvd and history.csv are compared byte by byte with the undisturbed
run's, and summary.json but for wall_seconds, ns_per_point_step and threads. For the scan each case goes on from each of some N checkpoints,
evenly spread, and from the end of each stage. For the fills a run writes into a disk of memory (tmpfs, which
only root may mount; left out otherwise) that is too small by more or less: it ends with status 3 and says so, what it leaves is whole, and
with more room it goes on. Exits with 1 where anything is wrong.
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


def steps_of(name):
    """(step, whether it is the end of a stage) of a checkpoint, by its name."""
    return int(name[-13:-3]), name.startswith("stage_")


def scan(trials, name, count):
    """Goes on from some checkpoints of a case. Returns (what is wrong, how many)."""
    trials.prepare(name)
    kept = os.path.join(trials.folder, name + ".kept")
    shutil.rmtree(kept, ignore_errors=True)
    with open(os.path.join(trials.folder, name + ".undisturbed", "summary.json"), encoding="utf-8") as file:
        every = max(1, json.load(file)["steps"] // (count + 1))
    status, error = trials.call("run", name + ".toml", "--out", name + ".kept", "--quiet", "--set",
                                f"output.checkpoint={{ steps = {every}, keep = 100000 }}")
    if status != 0:
        return [f"status {status}: {error}"], 0
    names = sorted((one for one in os.listdir(kept) if one.startswith(("checkpoint_", "stage_"))), key=steps_of)
    wrong = []
    for one in names:
        out = os.path.join(trials.folder, name + ".again")
        shutil.rmtree(out, ignore_errors=True)
        later = {other for other in names if steps_of(other) > steps_of(one)}
        shutil.copytree(kept, out, ignore=lambda _, inside: [other for other in inside if other in later])
        status, error = trials.call("resume", name + ".again", "--quiet", "--threads", str(trials.random.randint(1, 3)))
        if status != 0:
            wrong.append(f"from {one}: status {status}: {error}")
            continue
        differ, compared = differences(os.path.join(trials.folder, name + ".undisturbed"), out)
        trials.compared += compared
        wrong += [f"from {one}: {what}" for what in differ]
    return wrong, len(names)


class SmallDisk:
    """A folder of its own size."""

    def __init__(self, folder, size):
        self.folder = folder
        os.makedirs(folder, exist_ok=True)
        self.there = self.mount(f"size={size}")

    def mount(self, options):
        try:
            return subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", self.folder], capture_output=True).returncode == 0
        except FileNotFoundError:
            return False

    def enlarge(self, size):
        return subprocess.run(["mount", "-o", f"remount,size={size}", self.folder], capture_output=True).returncode == 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.there:
            subprocess.run(["umount", "-l", self.folder], check=True)


def half_files(folder):
    """What is not whole of the files of a run."""
    wrong = []
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            content = file.read()
        if name.endswith(".part"):
            wrong.append(f"{name} was left behind")
        elif name.endswith((".vtu", ".pvd")) and not content.rstrip().endswith(b"</VTKFile>"):
            wrong.append(f"{name} is half a file")
        elif name == "history.csv":
            lines = content.split(b"\n")
            if lines[-1] or len({line.count(b",") for line in lines[:-1]}) > 1:
                wrong.append("history.csv ends within a row")
    return wrong


def size_of(folder):
    """Bytes, in whole pages, as tmpfs counts."""
    return sum((os.path.getsize(os.path.join(folder, name)) + 4095) // 4096 * 4096 for name in os.listdir(folder))


def fill(trials, name, share):
    """A run on a disk with this share of the room that it needs. Returns what is wrong; None where no such disk can be had."""
    trials.prepare(name)
    undisturbed = os.path.join(trials.folder, name + ".undisturbed")
    whole = size_of(undisturbed)
    with SmallDisk(os.path.join(trials.folder, "disk"), int(share * whole)) as disk:
        if not disk.there:
            return None
        status, error = trials.call("run", name + ".toml", "--out", "disk/r", "--quiet", "--set", "output.checkpoint={ steps = 25, keep = 1 }")
        if status == 0:
            return [f"at {share:.2f} of {whole} bytes: it was done"]
        wrong = half_files(os.path.join(disk.folder, "r")) if os.path.isdir(os.path.join(disk.folder, "r")) else []
        if status != 3 or "No space left on device" not in error or "remedy: make room" not in error:
            wrong.append(f"status {status}: {error}")
        disk.enlarge(4 * whole + (1 << 20))
        if not os.path.exists(os.path.join(disk.folder, "r", "case.toml")):
            status, error = trials.call("run", name + ".toml", "--out", "disk/r", "--quiet", "--overwrite")
        else:
            status, error = trials.call("resume", "disk/r", "--quiet")
        if status != 0:
            return [f"at {share:.2f}: {what}" for what in [*wrong, f"status {status}: {error}"]]
        differ, compared = differences(undisturbed, os.path.join(disk.folder, "r"))
        trials.compared += compared
        differ = [what for what in differ if what != "summary.json: warnings" or "has no checkpoint" not in error]
        return [f"at {share:.2f}: {what}" for what in [*wrong, *differ]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--scan", type=int, default=8)
    parser.add_argument("--fills", type=int, default=20)
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
        scanned = 0
        for name in names if arguments.scan > 0 else []:
            found, number = scan(trials, name, arguments.scan)
            scanned += number
            wrong += [f"{name}: {what}" for what in found]
            print(f"{name} from {number} checkpoints: {found or 'the same'}", flush=True)
        fills = 0
        for k in range(arguments.fills):
            name = names[k % len(names)]
            found = fill(trials, name, (k + 0.5) / (arguments.fills + 1))
            if found is None:
                print("no disk of memory can be mounted here: the fills are left out")
                break
            fills += 1
            wrong += [f"{name}: {what}" for what in found]
            print(f"{name} on a full disk: {found or 'the same'}", flush=True)
        figures = {"fills": fills, "scanned": scanned, "stops": trials.stops, "runs": count, "cases": len(trials.undisturbed), "started_again": trials.starts_again,
                   "bytes_compared": trials.compared, "minutes": (time.monotonic() - start) / 60, "wrong": wrong}
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=2)
    print("\n".join(wrong))
    print(f"{scanned} checkpoints gone on from, {fills} full disks, {figures['stops']} stops of {count} runs of {figures['cases']} cases, {figures['bytes_compared']} bytes compared in "
          f"{figures['minutes']:.1f} min: {len(wrong)} differences")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
