"""Runs libFuzzer on every reader and counts. Usage: fuzz.py BUILD [--time SECONDS] [--jobs N] [READER ...]

It starts from tests/fuzz/corpus; what it learns stays in BUILD/corpus, what ends a reader goes to BUILD/findings. To keep a finding, mend it
and copy the file into tests/fuzz/corpus. Exit status 1 where there are findings.
"""

import argparse
import concurrent.futures
import pathlib
import re
import subprocess
import sys

READERS = ["case", "lab", "gmsh", "stl", "csv", "checkpoint"]
HERE = pathlib.Path(__file__).resolve().parent


def run(build, reader, seconds):
    """(executions, findings) of one reader."""
    learnt, findings = build / "corpus" / reader, build / "findings" / reader
    for folder in (learnt, findings):
        folder.mkdir(parents=True, exist_ok=True)
    words = [build / "fuzz" / f"fuzz_{reader}", learnt, HERE / "corpus" / reader, f"-max_total_time={seconds}", "-max_len=4096", "-timeout=20",
             "-rss_limit_mb=2000", "-print_final_stats=1", f"-artifact_prefix={findings}/"]
    dictionary = HERE / f"{'case' if reader == 'lab' else reader}.dict"
    if dictionary.exists():
        words.append(f"-dict={dictionary}")
    log = build / f"{reader}.log"
    with open(log, "w", encoding="utf-8") as file:
        subprocess.run(["nice", "-n", "19", *map(str, words)], stdout=file, stderr=file, check=False)
    done = re.search(r"number_of_executed_units: (\d+)", log.read_text(encoding="utf-8", errors="replace"))
    return int(done[1]) if done else 0, sorted(findings.iterdir())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--time", type=int, default=600)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("readers", nargs="*", metavar="READER")
    its = parser.parse_intermixed_args()  # readers may stand after the options
    readers = its.readers or READERS
    with concurrent.futures.ThreadPoolExecutor(its.jobs) as pool:
        results = list(pool.map(lambda reader: run(its.build.resolve(), reader, its.time), readers))
    for reader, (executions, findings) in zip(readers, results):
        print(f"{reader:6} {executions:12,} executions, {len(findings)} findings", *findings, sep="\n    ")
    sys.exit(1 if any(findings for _, findings in results) or not all(executions for executions, _ in results) else 0)


if __name__ == "__main__":
    main()
