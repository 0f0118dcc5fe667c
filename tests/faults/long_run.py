"""A long run of a small body: neither memory nor open files grow with its steps. Usage: long_run.py PROGRAM [--steps N] [--json FILE]

A block that rocks between walls, elastic, on one thread; a day of a real slope has about as many steps. Memory in use and open files are looked
at while it runs: after the first tenth they stay. The time of a step is reported, not judged: machines are shared. Exits with 1 where something grows.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time

CASE = """title = "a block that rocks"
gravity = [0.3, -9.81]

[mesh]
grid = { size = [4.0, 3.0], element = 0.5 }

[[material]]
name = "ground"
model = "mohr-coulomb"
density = 2.0
E = 2e4
nu = 0.3
c = 2.0
phi = 25.0
psi = 0.0

[[region]]
name = "block"
material = "ground"
polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.5], [1.0, 1.5]]
spacing = 0.25
stress = [0.0, 0.0, 0.0, 0.0]
velocity = [1.0, 0.0]

[[boundary]]
nodes = "bottom"
fix = ["y"]

[[boundary]]
nodes = "left"
fix = ["x"]

[[boundary]]
nodes = "right"
fix = ["x"]

[[stage]]
name = "rock"
duration = %(duration)g

[output]
every = %(every)g
history = %(history)g
checkpoint = { steps = %(checkpoint)d }
"""


def in_use(process):
    """(bytes of memory, open files) of a process, or nothing where it has ended."""
    try:
        with open(f"/proc/{process.pid}/statm", encoding="ascii") as file:
            pages = int(file.read().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE"), len(os.listdir(f"/proc/{process.pid}/fd"))
    except (FileNotFoundError, ProcessLookupError, IndexError):
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--json")
    arguments = parser.parse_args()
    step = 3.4e-3  # about, [s]
    duration = arguments.steps * step
    with tempfile.TemporaryDirectory(prefix="scarp_long_") as folder:
        with open(os.path.join(folder, "long.toml"), "w", encoding="utf-8") as file:
            file.write(CASE % {"duration": duration, "every": duration / 50, "history": duration / 1000, "checkpoint": max(1, arguments.steps // 50)})
        seen, start = [], time.monotonic()
        with subprocess.Popen([os.path.abspath(arguments.program), "run", "long.toml", "--out", "r", "--quiet", "--threads", "1", "--set",
                               "method.largest_energy_error=0"], cwd=folder, stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None:
                found = in_use(process)
                if found:
                    seen.append((time.monotonic() - start, *found))
                time.sleep(0.05 if arguments.steps < 500_000 else 0.2)
            error = process.stderr.read()
        if process.returncode != 0:
            sys.exit(f"the run ended with {process.returncode}: {error}")
        with open(os.path.join(folder, "r", "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        with open(os.path.join(folder, "r", "history.csv"), encoding="utf-8") as file:
            rows = len(list(csv.reader(file)))
    whole = seen[-1][0]
    early = [one for one in seen if 0.1 * whole <= one[0] <= 0.3 * whole]
    late = [one for one in seen if one[0] >= 0.7 * whole]
    if not early or not late:
        sys.exit("the run was too short to see anything")
    grown = max(one[1] for one in late) - max(one[1] for one in early)
    opened = max(one[2] for one in late) - max(one[2] for one in early)
    figures = {"steps": summary["steps"], "rows": rows, "wall_seconds": summary["wall_seconds"], "memory": max(one[1] for one in seen),
               "memory_grown": grown, "files_grown": opened}
    print(json.dumps(figures))
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)
    # The heap may take some pages more; a leak of a byte a step is half a megabyte in a million of them.
    if grown > 384 * 1024 or opened > 0:
        sys.exit(f"memory grew by {grown} bytes, open files by {opened}")


if __name__ == "__main__":
    main()
