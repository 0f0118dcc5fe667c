#!/usr/bin/env python3
"""Does the cost per point stay flat, how long is the way to the first step, what does a frame cost? `make bench-scaling`

For q4-subloading at 10⁴ to 10⁷ points: ns per point and step, bytes per point, seconds from the case to the first step
(filling, location, initial state), and the time of an uncompressed VTU frame in steps.
"""

import argparse
import os
import pathlib
import statistics
import tempfile

import steps


def measure(program, case, points, threads, repetitions, folder):
    ground = steps.Answering(program, case, points, threads)
    found = ground.read()
    ground.ask("run")
    runs = [ground.ask("run") for _ in range(repetitions)]
    frame_path = pathlib.Path(folder) / "frame.vtu"
    frames = []
    for _ in range(3):
        frames.append(ground.ask(str(frame_path)))
        size = frame_path.stat().st_size
        frame_path.unlink()
    ground.close()
    return {
        "points": found["points"],
        "start": found["start_seconds"],
        "start_cpu": found["start_cpu_seconds"],
        "peak_bytes": found["start_peak_bytes"] / found["points"],
        "ns": statistics.median(1e9 * r["seconds"] / r["point_steps"] for r in runs),
        "cpu_ns": statistics.median(1e9 * r["cpu_seconds"] / r["point_steps"] for r in runs),
        "bytes": runs[0]["bytes"] / found["points"],
        "frame": statistics.median(f["seconds"] for f in frames),
        "frame_cpu": statistics.median(f["cpu_seconds"] for f in frames),
        "frame_bytes": size / found["points"],
    }


def row(found, to_reference):
    step, step_cpu = (1e-9 * found[ns] * found["points"] for ns in ("ns", "cpu_ns"))
    return (f"{found['points']:9} {found['ns']:7.1f} ({found['cpu_ns']:6.1f}) {to_reference:8.2f} {found['bytes']:9.0f}"
            f" {found['start']:9.2f} ({found['start_cpu']:6.2f}) {found['peak_bytes']:14.0f}"
            f" {found['frame']:6.3f} ({found['frame_cpu']:5.3f})"
            f" {found['frame'] / step:7.1f} ({found['frame_cpu'] / step_cpu:5.1f}) {found['frame_bytes']:9.0f}")


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", default=here.parent / "build/bench", type=pathlib.Path, help="their folder")
    parser.add_argument("--case", default="q4-subloading", choices=[c for c in steps.GOALS if c not in steps.LONG])
    parser.add_argument("--points", nargs="+", type=int, default=[10**4, 10**5, 10**6, 10**7])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--folder", default=os.environ.get("TMPDIR", "/tmp"), help="where frames are written")
    arguments = parser.parse_args()
    print(f"{arguments.case}, {arguments.threads} thread(s); in brackets: processor time")
    print(f"{'points':>9} {'ns/pt/step':>16} {'to 10^5':>8} {'bytes/pt':>9} {'to first step [s]':>18} {'peak bytes/pt':>14}"
          f" {'frame [s]':>14} {'in steps':>15} {'bytes/pt':>9}", flush=True)
    all_found = []
    for points in arguments.points:
        with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
            found = measure(arguments.programs / "step_bench", arguments.case, points, arguments.threads,
                            arguments.repetitions, folder)
        all_found.append(found)
        reference = min(all_found, key=lambda f: abs(f["points"] - 10**5))
        print(row(found, found["ns"] / reference["ns"]), flush=True)


if __name__ == "__main__":
    main()
