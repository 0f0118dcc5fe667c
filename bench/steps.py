#!/usr/bin/env python3
"""Times whole steps over the cases of docs/benchmarks.md, writes them as JSON and prints a table: `make bench`.

Each case is a process of its own, which prepares it once and runs some steps whenever asked. Before each repetition the
yardsticks run, if there are any (stand-alone programs, no part of the project), so that both see the same machine.
"""

import argparse
import contextlib
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import limits

# What each case is to reach, in times of the yardsticks: E, an elastic step, and L, an update of the law.
GOALS = {
    "q4-elastic": (1.1, 0.0),
    "mesh-elastic": (1.5, 0.0),
    "mesh-elastic-t3": (1.5, 0.0),
    "bspline-elastic": (2.2, 0.0),
    "q4-subloading": (1.1, 1.1),
    "slope-cut-failing": (1.4, 1.4),
    "h8-elastic": (3.2, 0.0),
    "h8-subloading": (3.2, 1.6),
}
LONG = {"slope-cut-failing"}  # seconds to a minute a repetition: three of them, with the phases timed in each


class Answering:
    """A program that answers each line with a line of JSON."""

    def __init__(self, *command):
        words = [str(word) for word in command]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def read(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"{self.process.args[0]} ended: status {self.process.wait()}")
        return json.loads(line)

    def ask(self, what):
        self.process.stdin.write(what + "\n")
        self.process.stdin.flush()
        return self.read()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Yardsticks:
    """step.cpp and law.cpp of a folder, built for this machine; each run prints ns per point."""

    def __init__(self, source, folder):
        self.programs = {}
        if not source:
            return
        flags = ["g++", "-std=c++20", "-O3", "-march=native", "-ffast-math"]
        for name, arguments, libraries in (("step", ["158", "40"], []), ("law", [], ["-lmvec", "-lm"])):
            program = str(pathlib.Path(folder) / name)
            subprocess.run([*flags, str(pathlib.Path(source) / f"{name}.cpp"), "-o", program, *libraries], check=True)
            self.programs[name] = [program, *arguments]

    def run(self, times):
        for name, command in self.programs.items():
            times.setdefault(name, []).append(float(output_of(command)))


def output_of(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def median_of(times, name):
    return statistics.median(times[name]) if name in times else None


def measure_machine(program, threads, repetitions):
    """Medians of bandwidth [bytes/s] and arithmetic [flops/s] on so many threads."""
    machine = Answering(program, threads)
    answers = [machine.ask("run") for _ in range(repetitions)]
    machine.close()
    return {key: statistics.median(a[key] for a in answers) for key in answers[0]}


def measure_case(program, name, points, threads, repetitions, yardsticks):
    """One record of the results, without its limit."""
    steps = Answering(program, name, points, threads)
    found = steps.read()
    long = name in LONG
    if not long:
        steps.ask("run")  # the first after the preparation finds its pages and caches cold
    runs, times = [], {}
    for _ in range(min(repetitions, 3) if long else repetitions):
        yardsticks.run(times)
        runs.append(steps.ask("profile" if long else "run"))
    profile = runs[-1] if long else steps.ask("profile")
    steps.close()
    work = runs[-1]["point_steps"]
    ns = [1e9 * r["seconds"] / r["point_steps"] for r in runs]
    spent = sum(profile["phases"].values())
    return {
        "case": name,
        "threads": threads,
        "points": found["points"],
        "ns_per_point_step": statistics.median(ns),
        "low": min(ns),
        "high": max(ns),
        "bytes_per_point": max(r["bytes"] for r in runs) / found["points"],
        "yardstick_elastic_ns": median_of(times, "step"),
        "yardstick_law_ns": median_of(times, "law"),
        "shares": {phase: seconds / spent for phase, seconds in profile["phases"].items()},
        "repetitions": len(ns),
        "cpu_ns_per_point_step": statistics.median(1e9 * r["cpu_seconds"] / r["point_steps"] for r in runs),
        "points_per_element": found["points"] / found["elements"],
        "steps": runs[-1]["steps"],
        "substeps_per_point": runs[-1]["substeps"] / work,
        "changed_element_per_point_step": runs[-1]["changed_element"] / work,
    }


def goal_of(record):
    """ns, or None without yardsticks."""
    if record["yardstick_elastic_ns"] is None or record["case"] not in GOALS:
        return None
    of_step, of_law = GOALS[record["case"]]
    return of_step * record["yardstick_elastic_ns"] + of_law * record["yardstick_law_ns"]


def finish(records, machine, laws):
    """Adds goal, limit and speed-up to the records."""
    alone = {(r["case"], r["points"]): r["ns_per_point_step"] for r in records if r["threads"] == 1}
    for record in records:
        goal = goal_of(record)
        record["goal_ns"] = goal
        record["ratio_to_goal"] = None if goal is None else record["ns_per_point_step"] * record["threads"] / goal
        one = alone.get((record["case"], record["points"]))
        record["speed_up"] = one / record["ns_per_point_step"] if one and record["threads"] > 1 else None
        record.update(limits.of_case(record, machine[record["threads"]], laws))


def text(value, form):
    return "-" if value is None else format(value, form)


def print_table(records, machine):
    for threads, found in machine.items():
        print(f"{threads} thread{'s' * (threads > 1)}: memory {1e-9 * found['bytes_per_second']:.1f} GB/s, "
              f"arithmetic {1e-9 * found['flops_per_second']:.1f} Gflop/s in batches of {found['lanes']:.0f}")
    print("\nns per point and step: median, least and largest of the repetitions; CPU: of all threads; E, L: yardsticks;\n"
          "x goal: on one thread; limit: what memory or arithmetic of this machine allow; of it: how near the median\n")
    head = ("case", "threads", "points", "ns", "low", "high", "CPU", "E", "L", "goal", "x goal", "speed-up", "limit",
            "of it", "bytes/pt", "substeps")
    rows = [head]
    for r in records:
        rows.append((r["case"], str(r["threads"]), str(r["points"]), f"{r['ns_per_point_step']:.1f}", f"{r['low']:.1f}",
                     f"{r['high']:.1f}", f"{r['cpu_ns_per_point_step']:.1f}", text(r["yardstick_elastic_ns"], ".1f"),
                     text(r["yardstick_law_ns"], ".1f"), text(r["goal_ns"], ".1f"),
                     text(r["ratio_to_goal"] if r["threads"] == 1 else None, ".2f"), text(r["speed_up"], ".2f"),
                     text(r["limit_ns"], ".1f"), text(r["fraction_of_limit"], ".0%"), f"{r['bytes_per_point']:.0f}",
                     f"{r['substeps_per_point']:.3f}"))
    widths = [max(len(row[c]) for row in rows) for c in range(len(head))]
    for row in rows:
        print(row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:])), sep="  ")
    print("\nshare of each phase [%]")
    phases = list(records[0]["shares"])
    for number, phase in enumerate(phases):
        print(f"  {chr(ord('a') + number)}: {phase}")
    for r in records:
        print(r["case"].ljust(widths[0]), str(r["threads"]).rjust(2), str(r["points"]).rjust(9),
              *(f"{100 * r['shares'][p]:5.0f}" for p in phases))


def read_arguments():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", default=here.parent / "build/bench", type=pathlib.Path, help="their folder")
    parser.add_argument("--out", default=here.parent / "build/bench.json", type=pathlib.Path)
    parser.add_argument("--cases", nargs="+", default=list(GOALS), choices=list(GOALS))
    parser.add_argument("--points", nargs="+", type=int, default=[96000], help="about so many, but slope-cut-failing")
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--repetitions", type=int, default=7)
    parser.add_argument("--yardstick", default=os.environ.get("YARDSTICK", ""), help="folder with step.cpp and law.cpp")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    laws = json.loads(output_of([arguments.programs / "operations"]))
    threads = [t for t in arguments.threads if t <= (os.cpu_count() or 1)]
    started = time.strftime("%Y-%m-%dT%H:%M:%S")
    load = os.getloadavg()[0]
    machine = {t: measure_machine(arguments.programs / "machine", t, arguments.repetitions) for t in threads}
    records, program = [], arguments.programs / "step_bench"
    with tempfile.TemporaryDirectory() as folder:
        yardsticks = Yardsticks(arguments.yardstick, folder)
        for case in arguments.cases:
            for points in arguments.points if case not in LONG else [0]:
                for t in threads:
                    print(f"{case}, {points or 'its own number of'} points, {t} thread{'s' * (t > 1)}", file=sys.stderr)
                    records.append(measure_case(program, case, points, t, arguments.repetitions, yardsticks))
    finish(records, machine, laws)
    about = {
        "started": started,
        "processor": processor(),
        "load": {"start": load, "end": os.getloadavg()[0]},
        "low_and_high": "least and largest of the repetitions",
        "bytes_per_point": "resident memory after the steps, less that before the case was made",
        "threads": {str(t): found for t, found in machine.items()},
    }
    arguments.out.write_text(json.dumps({"machine": about, "records": records}, indent=1) + "\n", encoding="utf-8")
    print_table(records, machine)


def processor():
    with contextlib.suppress(OSError):
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


if __name__ == "__main__":
    main()
