#!/usr/bin/env python3
"""Prints the results of scarp_bench (JSON, with repetitions) as a table: median, least and largest ns per point, and
how many times as fast as the same work on double.

    build/bin/scarp_bench --benchmark_repetitions=9 --benchmark_out=kernels.json && bench/table.py kernels.json
"""

import json
import statistics
import sys


def times(path):
    """{name: [ns per point of each repetition]} in the order of the file."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for run in json.load(file)["benchmarks"]:
            if run["run_type"] == "iteration":
                if run.get("error_occurred"):
                    sys.exit(f"{run['name']}: {run['error_message']}")
                found.setdefault(run["run_name"], []).append(1e9 * run["ns_per_point"])
                for phase in (key for key in run if key.endswith(")") or key.startswith("order of")):
                    found.setdefault(f"{run['run_name']}: {phase}", []).append(run[phase])
    return found


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    all_times = times(sys.argv[1])
    print(f"{'ns per point, CPU time':46}{'median':>9}{'least':>9}{'largest':>9}{'double/batch':>14}")
    for name, values in sorted(all_times.items()):
        median = statistics.median(values)
        double = all_times.get(name.replace("batch", "double"))
        ratio = f"{statistics.median(double) / median:14.1f}" if double and "batch" in name else ""
        print(f"{name:46}{median:9.1f}{min(values):9.1f}{max(values):9.1f}{ratio}")


if __name__ == "__main__":
    main()
