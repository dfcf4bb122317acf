#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Faults that machines have, hidden in records, and how often `diagnose` finds them.

    python3 benchmarks/studies/machines/run.py PROGRAM FOLDER servos|jumps|page [--case NAME...]

Writes records and answers to FOLDER/cases, a table of each part to FOLDER (.csv) and the page to
FOLDER/machines.md; rows of cases that are not run stay as they are. The friction of a servo is
right when it is off by at most 20 % rms of what the nominal model lacks, on the record that chose
nothing, where the joint moves; a jump when its instant is. Needs NumPy.
"""

import argparse
import csv
import datetime
import json
import os
import pathlib
import platform
import re
import resource
import subprocess

import numpy as np

import jumps
import servos

LIMIT = 240  # s of one processor for one call
COLUMNS = ("case", "kept", "kind", "judged", "verdict", "off", "seconds", "answer")
FUNCTIONS = {
    "sign": np.sign, "abs": np.abs, "exp": np.exp, "tanh": np.tanh, "sin": np.sin, "cos": np.cos,
    "sqrt": np.sqrt, "clip": np.clip, "min": np.minimum, "max": np.maximum, "log": np.log,
}  # fmt: skip


def write_record(path, columns):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows([f"{v:.9g}" for v in row] for row in zip(*columns.values()))


def diagnosed(program, folder, held_out):
    """The answer (None: none), its text, user seconds."""
    for old in ("answer.json", "answer.ode"):
        (folder / old).unlink(missing_ok=True)
    command = [program, "diagnose", "--model", "nominal.ode", "a.csv", "--threads", "1"]
    command += ["--holdout", "b.csv"] if held_out else []
    command += ["--json", "answer.json", "--model-out", "answer.ode"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        ["prlimit", f"--cpu={LIMIT}", *command],
        cwd=folder, capture_output=True, text=True, check=False,
    )  # fmt: skip
    text = done.stdout + done.stderr
    if done.returncode < 0:
        text = f"no answer after {LIMIT} s\n{text}"
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    (folder / "answer.txt").write_text(text)
    path = folder / "answer.json"
    return (json.loads(path.read_text()) if path.exists() else None), text, seconds


def row_of(case, kind, answer, text, seconds):
    row = {"case": case.name, "kept": "kept" if case.kept else "", "kind": kind}
    row |= {"seconds": f"{seconds:.1f}", "judged": "no", "verdict": "none"}
    if answer is None:
        return row | {"answer": text.strip().splitlines()[0]}
    named = [f"{e['equation']}: {e['name']} {e['term']}" for e in answer["effects"]]
    return row | {"verdict": answer["verdict"], "answer": "; ".join(named)}


def rate_in(text, q, w, current):
    """dw/dt of a model's text at these states; None where this reader lacks a function."""
    formula = re.search(r"^\s*dw/dt\s*=\s*(.*)$", text, re.M).group(1).replace("^", "**")
    numbers = dict(re.findall(r"^\s*param (\w+) = ([^\s\[]+)", text, re.M))
    values = {name: float(value) for name, value in numbers.items()}
    values |= FUNCTIONS | {"q": q, "w": w, "i": current}
    try:
        return eval(formula, {"__builtins__": {}}, values)
    except NameError:
        return None


def error_of(servo, folder, current, states):
    """What is off of what the nominal model lacks, as a fraction of that."""
    q, w = states.T
    moves = np.abs(w) > 0.02 * np.abs(w).max()
    truth = servo.rate(q, w, current)
    lacks = truth - rate_in((folder / "nominal.ode").read_text(), q, w, current)
    found = rate_in((folder / "answer.ode").read_text(), q, w, current)
    if found is None:
        return None

    def rms(x):
        return float(np.sqrt(np.mean(np.square(x[moves]))))

    return rms(found - truth) / rms(lacks)


def servo_row(case, program, folder):
    servo = servos.Servo(case)
    for number, name in enumerate(("a.csv", "b.csv")):
        current, states, measured = servo.record(number)
        time = servos.STEP * np.arange(servos.COUNT)
        columns = {"t [s]": time, "q [rad]": measured[:, 0], "w [rad/s]": measured[:, 1]}
        write_record(folder / name, columns | {"i [A]": current})
    (folder / "nominal.ode").write_text(servo.nominal())
    answer, text, seconds = diagnosed(program, folder, True)
    row = row_of(case, case.rung, answer, text, seconds)
    if answer is None:
        return row
    error = error_of(servo, folder, current, states)
    right = error is not None and error <= 0.2
    explained = answer["verdict"] == "explained"
    row["off"] = "" if error is None else f"{100 * error:.1f} %"
    row["judged"] = ("right" if right else "false") if explained else "near" if right else "no"
    return row


def jump_row(case, program, folder):
    for number, name in enumerate(("a.csv", "b.csv")[: 1 + case.second]):
        time, u, states = jumps.record_of(case, number)
        columns = {"t": time, "u": u} | dict(zip(jumps.SYSTEMS[case.system].states, states.T))
        write_record(folder / name, columns)
    (folder / "nominal.ode").write_text(jumps.nominal_of(case))
    answer, text, seconds = diagnosed(program, folder, case.second)
    row = row_of(case, case.number or "null", answer, text, seconds)
    if answer is None:
        return row
    if not case.number:
        row["judged"] = "false" if answer["effects"] else "right"
        return row
    changes = [e for e in answer["effects"] if e["name"] == "change"]
    if not changes:
        row["judged"] = "false" if answer["verdict"] == "explained" else "no"
        return row
    truth = jumps.instant_of(case)
    found = changes[0]["parameters"]["time"]
    off = abs((found["value"] if isinstance(found, dict) else found) - truth)
    row["off"] = f"{off:.3g} s"
    alone = len(answer["effects"]) == 1
    near = off <= max(0.1, 0.5 * jumps.SYSTEMS[case.system].step)
    row["judged"] = "right" if alone and near else "near" if near else "false"
    return row


PARTS = {"servos": (servos.CASES, servo_row), "jumps": (jumps.JUMPS, jump_row)}


def read_table(path):
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        return {row["case"]: row for row in csv.DictReader(file)}


def run_part(part, program, folder, names):
    cases, make = PARTS[part]
    path = folder / f"{part}.csv"
    rows = read_table(path)
    for case in cases:
        if names and case.name not in names:
            continue
        place = folder / "cases" / part / case.name
        place.mkdir(parents=True, exist_ok=True)
        rows[case.name] = row = make(case, program, place)
        print(*(row.get(name) or "-" for name in COLUMNS), sep=" | ", flush=True)
        with open(path, "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, restval="")
            writer.writeheader()
            writer.writerows(rows[one.name] for one in cases if one.name in rows)


def summary(rows):
    """A line for each kind, and one for all."""
    lines = ["| kind | cases | right, in use | right, kept | near | false | longest, s |"]
    lines.append("| --- | --- | --- | --- | --- | --- | --- |")
    for kind in sorted({row["kind"] for row in rows}) + ["all"]:
        group = [row for row in rows if kind in (row["kind"], "all")]
        halves = [[r for r in group if bool(r["kept"]) is kept] for kept in (False, True)]
        right = [f"{sum(r['judged'] == 'right' for r in h)} of {len(h)}" for h in halves]
        others = [sum(r["judged"] == word for r in group) for word in ("near", "false")]
        longest = max(float(row["seconds"]) for row in group)
        lines.append(f"| {kind} | {len(group)} | {' | '.join(map(str, right + others))} "
                     f"| {longest:.1f} |")  # fmt: skip
    return lines


def write_page(folder):
    lines = ["# Faults that machines have", "", f"`run.py PROGRAM FOLDER`; {platform.machine()}, "]
    lines[-1] += f"{os.cpu_count()} cores, {datetime.date.today()}."
    titles = {"servos": "Friction of geared servos", "jumps": "Numbers that change at an instant"}
    for part, title in titles.items():
        rows = list(read_table(folder / f"{part}.csv").values())
        if rows:
            lines += ["", f"## {title}", "", *summary(rows)]
    (folder / "machines.md").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("part", choices=(*PARTS, "page"))
    parser.add_argument("--case", nargs="*", default=[])
    asked = parser.parse_args()
    program, folder = str(pathlib.Path(asked.program).resolve()), asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    if asked.part != "page":
        run_part(asked.part, program, folder, asked.case)
    write_page(folder)


if __name__ == "__main__":
    main()
