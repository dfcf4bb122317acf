# SPDX-License-Identifier: MIT
"""A heater with a core that nobody measures (two thermal capacities), fitted by scipy's
least_squares, beside `lacuna fit`: records of the temperature control laboratory as in
dowlinglab/pyomo-doe (BSD-3-Clause).

python3 heater.py LACUNA FOLDER   (FOLDER has the model heater.ode of docs/fit/heater.md and
tclab_sine_test_5min_period.csv)

The model is linear, and its input held between samples: each step is a matrix exponential.
results/heater.csv: 2026-11-27."""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np
from scipy.linalg import expm
from scipy.optimize import least_squares

AMBIENT, GAIN, SENSOR = 22.2, 0.032, 0.3
NAMES, START = ["Ua", "Ub", "CH"], [0.05, 0.02, 5.0]


def run(numbers, time, power):
    """Temperature of the sensor at the samples."""
    ua, ub, ch = numbers
    rates = np.zeros((3, 3))  # of the two temperatures above the ambient one, and the input
    rates[0] = [-(ua + ub) / ch, ub / ch, GAIN / ch]
    rates[1, :2] = [ub / SENSOR, -ub / SENSOR]
    steps = {}
    state, values = np.zeros(2), [0.0]
    for h, q in zip(np.diff(time), power):
        key = round(h, 6)
        if key not in steps:
            steps[key] = expm(rates * h)
        state = steps[key][:2, :2] @ state + steps[key][:2, 2] * q
        values.append(state[1])
    return AMBIENT + np.array(values)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    record = folder / "tclab_sine_test_5min_period.csv"
    with open(record) as file:
        rows = [[float(row[name]) for name in ["Time", "T1", "Q1"]]
                for row in csv.DictReader(file)]
    time, measured, power = np.array(rows).T
    found = least_squares(lambda p: run(p, time, power) - measured, START, x_scale=START,
                          xtol=1e-12, ftol=1e-12, gtol=1e-12)
    answer = json.loads(subprocess.run(
        [program, "fit", folder / "heater.ode", record, "--json", "-"],
        capture_output=True, text=True, check=True).stdout)
    ours = {one["name"]: one["value"] for one in answer["parameters"]}
    print("number,scipy,lacuna,difference %")
    for name, value in zip(NAMES, found.x):
        print(f"{name},{value:.6g},{ours[name]:.6g},{100 * (ours[name] / value - 1):.2g}")
    rmse = np.sqrt(2.0 * found.cost / len(time))
    print(f"rmse,{rmse:.4g},{answer['fit'][0]['rmse']:.4g},")


if __name__ == "__main__":
    main()
