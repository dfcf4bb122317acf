#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What calls of the Python package cost beside the same calls in C++.

    cmake -DLACUNA_BUILD_BENCHMARKS=ON build/python/cmake
    ninja -C build/python/cmake study_python
    build/python/fresh/bin/python benchmarks/studies/python/calls.py \
      build/python/cmake/benchmarks/study_python FOLDER

The build is that of the package's extension (scripts/python.sh). Each call is one process, programs
take turns, numbers are medians. Writes FOLDER/calls.md.
"""

import argparse
import datetime
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

BOUNDS = {"identify": (1.05, 10.0), "evaluate": (1.5, 10.0)}
ROWS = {"identify": 10_000, "evaluate": 1_000_000}


def megabytes(name):
    """A number of this process's status, in MB."""
    text = pathlib.Path("/proc/self/status").read_text()
    return float(text.split(f"{name}:")[1].split()[0]) / 1024


def metered(call):
    """Seconds, seconds of all threads and MB of a call, as benchmarks/support/meter.hpp."""
    pathlib.Path("/proc/self/clear_refs").write_text("5")
    before, cpu, begin = megabytes("VmRSS"), time.process_time(), time.perf_counter()
    call()
    wall = time.perf_counter() - begin
    return wall, time.process_time() - cpu, megabytes("VmHWM") - before


def call_once(call, file):
    """The same call as study_python; prints the same numbers."""
    import numpy as np

    import lacuna

    table = np.load(file)
    t, x = table[:, 0].copy(), table[:, 1:].copy()
    if call == "identify":
        names = ["x", "y", "z"]
        numbers = metered(lambda: lacuna.identify(x, t, states=names, threads=1).to_json())
    else:
        model = lacuna.Model.load("lorenz")
        model(0.0, x[:1])
        numbers = metered(lambda: model(0.0, x))
    print(*numbers)


def numbers_of(*command):
    """What a program prints."""
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [float(word) for word in done.stdout.split()]


def record(call, folder):
    """A file with a noisy orbit of Lorenz' system, as long as the call takes it."""
    import numpy as np

    import lacuna

    run = lacuna.simulate("lorenz", [1, 1, 20], np.arange(ROWS[call]) * 0.01)
    noise = 0.01 * np.random.default_rng(1).normal(size=run.x.shape)
    np.save(folder / f"{call}.npy", np.column_stack([run.t, run.x + noise * run.x.std(axis=0)]))
    file = folder / f"{call}.npy"
    np.save(file, np.column_stack([run.t, run.x + noise * run.x.std(axis=0)]))
    return file


def compared(call, program, draws):
    """Medians of both, and a row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        file = record(call, pathlib.Path(folder))
        pairs = [
            (numbers_of(program, call, str(file)), numbers_of(sys.executable, __file__, call, file))
            for _ in range(draws)
        ]
    cpp, python = (
        [statistics.median(n) for n in zip(*one, strict=True)] for one in zip(*pairs, strict=True)
    )
    ratio, added = python[1] / cpp[1], python[2] - cpp[2]
    most, memory = BOUNDS[call]
    verdict = "yes" if ratio <= most and added <= memory else "no"
    rows = f"{ROWS[call]} x 3"
    return (
        f"| {call} | {rows} | {cpp[1]:.3g} | {python[1]:.3g} | {ratio:.3f} | {most} "
        f"| {cpp[2]:.1f} | {python[2]:.1f} | {added:.1f} | {memory:.0f} | {verdict} |"
    )


def import_seconds(draws):
    """CPU seconds, by the interpreter's own account, in processes of their own."""
    script = "import time; b = time.process_time(); import lacuna; print(time.process_time() - b)"
    return statistics.median(numbers_of(sys.executable, "-c", script)[0] for _ in range(draws))


def main():
    """Write and print the table."""
    reader = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    reader.add_argument("program")
    reader.add_argument("folder", type=pathlib.Path)
    reader.add_argument("draws", nargs="?", type=int, default=9)
    given = reader.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    import lacuna

    rows = [compared(call, given.program, given.draws) for call in BOUNDS]
    build = lacuna.build_info()
    cpu = pathlib.Path("/proc/cpuinfo").read_text().split("model name\t: ")[1].splitlines()[0]
    lines = [
        "# Calls of the Python package beside C++",
        "",
        f"{cpu}, {os.cpu_count()} cores, {build['compiler']}, Python {platform.python_version()}, "
        f"{datetime.date.today()}. CPU seconds of one thread, MB above those before the call; "
        f"medians of {given.draws}, each in a process of its own, the programs take turns.",
        f"Command: `benchmarks/studies/python/calls.py study_python FOLDER {given.draws}`",
        "",
        "| call | array | C++ s | Python s | ratio | at most | C++ MB | Python MB | more | at most "
        "| holds |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
        *rows,
        "",
        f"`import lacuna` takes {import_seconds(given.draws):.3f} s of CPU (at most 0.15).",
    ]
    (given.folder / "calls.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in BOUNDS:
        call_once(*sys.argv[1:])
    else:
        main()
