#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""PySINDy's time and memory for the fit that `study_scaling speed` measures, in the same run.

    python3 -m venv build/peers && build/peers/bin/pip install pysindy==2.1.0
    build/peers/bin/python benchmarks/peers/pysindy_speed.py build/check/benchmarks/study_scaling FOLDER

A million rows of Lorenz' system with derivatives given, sequentially thresholded least squares,
both on one thread, then both on two. Writes FOLDER/speed.md.
"""

import csv
import datetime
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import time

REPEATS = 5


def lacuna_times(study, folder):
    subprocess.run([study, "speed", folder], check=True)
    with open(pathlib.Path(folder) / "speed.csv") as file:
        return list(csv.DictReader(file))


def pysindy_time(folder, degree):
    """Median of the times of a fit, and MB it takes beside the data, in this process."""
    import numpy as np
    import pysindy as ps

    table = np.load(pathlib.Path(folder) / "lorenz.npy")
    t, x, rates = table[:, 0], table[:, 1:4].copy(), table[:, 4:].copy()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    times = []
    for _ in range(REPEATS):
        model = ps.SINDy(
            optimizer=ps.STLSQ(threshold=0.1),
            feature_library=ps.PolynomialLibrary(degree=degree),
        )
        start = time.perf_counter()
        model.fit(x, t=t, x_dot=rates)
        times.append(time.perf_counter() - start)
    megabytes = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    return statistics.median(times), megabytes


def main(study, folder):
    ours = lacuna_times(study, folder)
    lines = [
        "# Speed beside PySINDy 2.1",
        "",
        "A fit of 10^6 x 3 samples of Lorenz' system with derivatives given, preset `sindy` and "
        "STLSQ, medians of 5 in one run; threads: of lacuna, and of the BLAS behind PySINDy; MB beside the data.",
        "",
        f"Made by `benchmarks/peers/pysindy_speed.py study_scaling FOLDER` on {datetime.date.today()}.",
        "",
        "| degree | threads | lacuna / s | PySINDy / s | ratio | lacuna / MB | PySINDy / MB |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in ours:
        # A process of its own, so that memory is that of one degree.
        answer = subprocess.run(
            [sys.executable, __file__, "--fit", folder, row["degree"]],
            check=True, capture_output=True, text=True,
            env={**os.environ, "OMP_NUM_THREADS": row["threads"],
                 "OPENBLAS_NUM_THREADS": row["threads"]},
        ).stdout.split()
        seconds, megabytes = float(answer[0]), float(answer[1])
        lines.append(
            f"| {row['degree']} | {row['threads']} | {row['seconds']} | {seconds:.2f} | "
            f"{seconds / float(row['seconds']):.0f} | {row['MB']} | {megabytes:.0f} |"
        )
    text = "\n".join(lines) + "\n"
    (pathlib.Path(folder) / "speed.md").write_text(text)
    print(text)


if __name__ == "__main__":
    if sys.argv[1] == "--fit":
        print(*pysindy_time(sys.argv[2], int(sys.argv[3])))
    else:
        main(sys.argv[1], sys.argv[2])
