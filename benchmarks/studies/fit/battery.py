# SPDX-License-Identifier: MIT
"""A lithium cell with two RC pairs, fitted by scipy's least_squares, beside `lacuna fit`: the
record and the model of data/ (docs/fit/battery.md).

python3 battery.py LACUNA DATA

The current is constant between samples, so each pair has its exact step. results/battery.csv:
2026-11-27."""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np
from scipy.optimize import least_squares

NAMES = ["V0", "S", "R0", "R1", "T1", "C2", "T2"]
START = [3.1, 0.3, 2.0, 2.0, 100.0, 10.0, 1000.0]


def run(numbers, time, current):
    """Voltage at the samples: current in A, resistances in mOhm, the capacitance in kF."""
    v0, slope, r0, r1, t1, c2, t2 = numbers
    charge, pairs = 0.0, np.zeros(2)
    gains, times = np.array([r1, t2 / c2]) / 1000.0, np.array([t1, t2])
    values = [v0 + r0 * current[0] / 1000.0]
    for k, h in enumerate(np.diff(time)):
        charge += current[k] * h / 3600.0
        decay = np.exp(-h / times)
        pairs = decay * pairs + (1.0 - decay) * gains * current[k]
        values.append(v0 + slope * charge + r0 * current[k + 1] / 1000.0 + pairs.sum())
    return np.array(values)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    record = folder / "leaf_cell_pulse.csv"
    with open(record) as file:
        rows = [[float(text) if text else np.nan for text in row]
                for row in list(csv.reader(file))[1:]]
    time, current, measured = np.array(rows).T
    seen = ~np.isnan(measured)
    found = least_squares(lambda p: (run(np.exp(p), time, current) - measured)[seen],
                          np.log(START), xtol=1e-13, ftol=1e-13, gtol=1e-13)
    answer = json.loads(subprocess.run(
        [program, "fit", folder / "leaf_cell.ode", record, "--json", "-"],
        capture_output=True, text=True, check=True).stdout)
    ours = {one["name"]: one["value"] for one in answer["parameters"]}
    print("number,scipy,lacuna,difference %")
    for name, value in zip(NAMES, np.exp(found.x)):
        print(f"{name},{value:.6g},{ours[name]:.6g},{100 * (ours[name] / value - 1):.2g}")
    rmse = 1e3 * np.sqrt(2.0 * found.cost / seen.sum())
    print(f"rmse mV,{rmse:.4g},{1e3 * answer['fit'][0]['rmse']:.4g},")


if __name__ == "__main__":
    main()
