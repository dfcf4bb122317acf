#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants, swings and fits as a user measures them, each with what holds.

    python3 benchmarks/studies/plants/run.py PROGRAM FOLDER [PART...] [--case NAME...]
        [--python PYTHON]

PART: experts, plants, swings, fits (all without one), peers, recorded_experts and recordings
(those of the environment's LACUNA_DATA), or page. Writes records and answers to
FOLDER/cases, and a table of each part to FOLDER (.csv) and of all to FOLDER/plants.md. Tables of
parts that are not run stay as they are: with results/*.csv in FOLDER, `page` alone makes the page,
and `plants` compares with the experts and peers that are committed. `peers`
needs a PYTHON that has PySINDy. The program's own parts need NumPy, experts SciPy too.
"""

import argparse
import json
import os
import pathlib
import subprocess

import numpy as np

from fits import TASKS, problem_of
from grading import (
    called,
    equations_in,
    error_line,
    free_run_error,
    identify,
    judged,
    plain_numbers,
    terms_of,
    write_columns,
)
from plants import CASES, plant_of, record_of
from swings import SWINGS, swing_record, terms_of as terms_of_swing
from tables import compare_with_experts, read_table, write_page, write_table

LONGEST = 20  # s that a fit may take


def text_of(value, digits=3):
    return "" if value is None else f"{value:.{digits}g}"


def write_plant(folder, plant):
    """Both records, and what other programs need to know of the case."""
    records = [record_of(plant, number) for number in (0, 1)]
    folder.mkdir(parents=True, exist_ok=True)
    for name, record in zip(("a.csv", "b.csv"), records):
        write_columns(folder / name, record.time, record.channels | record.inputs)
    known = {
        "channels": list(records[0].channels),
        "inputs": list(plant.shape.inputs),
        "order": plant.shape.order,
        "equations": plant.shape.equations,
        "delays": plant.delays,
        "asymmetric": plant.asymmetry > 0,
        "start": {name: float(value) for name, value in records[1].start.items()},
    }
    (folder / "case.json").write_text(json.dumps(known, indent=1) + "\n")
    return records


def plant_row(case, program, folder):
    plant = plant_of(case)
    records = write_plant(folder, plant)
    shape = plant.shape
    embed = {name: shape.order for name in shape.channels} if shape.order > 1 else {}
    answer, text, seconds = identify(program, folder, embed, shape.inputs)
    late = ", ".join(f"{name} {value:g}" for name, value in plant.delays.items())
    row = {"case": case.name, "kept": "kept" if case.kept else "", "shape": case.shape}
    row |= {"drive": " ".join(filter(None, (case.drive, case.disturbed))), "dead time s": late}
    row |= {"seconds": f"{seconds:.1f}"}
    if answer is None:
        return row | {"judged": "no answer", "answer": error_line(text)}
    states = [state["name"] for state in answer["model"]["states"]]
    error = free_run_error(program, folder, records[1], states)
    return row | {
        "judged": judged(plant, terms_of(answer["model"], shape.chain)),
        "verdict": (answer.get("validation") or {}).get("verdict", ""),
        "free run %": "leaves" if error is None else text_of(100 * error),
        "answer": plain_numbers(equations_in(text)),
    }


def expert_row(case):
    from expert import box_of, error_of, fit
    from grey_boxes import GREY_BOXES

    plant = plant_of(case)
    first, second = (record_of(plant, number) for number in (0, 1))
    box = GREY_BOXES.get(case.name, box_of)(plant)
    numbers = fit(box, first, case.seed)
    start = tuple(second.start.values())
    return {
        "case": case.name,
        "model": "grey box" if case.name in GREY_BOXES else "plain structure",
        "free run %": text_of(100 * error_of(box, numbers, second, start)),
        "with the truth %": text_of(100 * error_of(box, box.truth, second, start)),
        "numbers": "; ".join(f"{name} {value:.5g}" for name, value in numbers.items()),
        "truth": "; ".join(f"{name} {value:.5g}" for name, value in box.truth.items()),
    }


def swing_row(swing, program, folder):
    record = swing_record(swing)
    folder.mkdir(parents=True, exist_ok=True)
    write_columns(folder / "a.csv", record.time, {"th": record.angle})
    answer, text, seconds = identify(program, folder, {"th": 2}, ())
    row = {"case": swing.name, "kept": "kept" if swing.kept else "", "kind": swing.kind}
    row |= {"steps": swing.steps, "amplitude": swing.amplitude, "seconds": f"{seconds:.1f}"}
    row |= {"stiffness": text_of(record.stiffness, 5), "damping": text_of(record.damping)}
    if answer is None:
        return row | {"judged": "no answer", "answer": error_line(text)}
    found = set(terms_of(answer["model"]).get("th_d1", ()))
    verdict = (answer.get("validation") or {}).get("verdict", "")
    faults = [] if found == terms_of_swing(swing) else ["terms"]
    faults += [] if verdict == "fits to noise" else ["verdict"]
    row |= {"judged": " and ".join(faults) or "right", "verdict": verdict}
    return row | {"answer": plain_numbers(equations_in(text))}


def missed(truth, answer):
    """Names of numbers outside their intervals, those without one, and the largest distance."""
    found = {entry["name"]: entry for entry in answer["parameters"]}
    outside, without, largest = [], [], 0.0
    for name, value in truth.items():
        entry = found.get(name, {})
        if not entry.get("ci95") or None in entry["ci95"]:
            without.append(name)
            continue
        if not entry["ci95"][0] <= value <= entry["ci95"][1]:
            outside.append(name)
        if entry.get("stderr"):
            largest = max(largest, abs(entry["value"] - value) / entry["stderr"])
    return outside, without, largest


def fit_row(task, program, folder):
    problem = problem_of(task)
    folder.mkdir(parents=True, exist_ok=True)
    columns = dict(problem.columns)
    write_columns(folder / "a.csv", columns.pop("t"), columns)
    (folder / "model.ode").write_text(problem.model)
    command = [program, "fit", "model.ode", "a.csv", "--threads", "1", "--json", "answer.json"]
    text, answer, seconds = called(command, folder, "answer.json")
    (folder / "answer.txt").write_text(text)
    row = {"case": task.name, "kept": "kept" if task.kept else "", "kind": task.kind}
    row |= {"seconds": f"{seconds:.1f}"}
    row["truth"] = "; ".join(f"{name} {value:.5g}" for name, value in problem.truth.items())
    if answer is None:
        return row | {"judged": "no answer", "answer": error_line(text)}
    outside, without, largest = missed(problem.truth, answer)
    faults = [f"outside: {', '.join(outside)}"] if outside else []
    faults += [f"not determined: {', '.join(without)}"] if without else []
    faults += ["slow"] if seconds > LONGEST else []
    found = [f"{e['name']} {text_of(e['value'], 5)}" for e in answer["parameters"]]
    row |= {"judged": "; ".join(faults) or "right", "largest error in sigma": f"{largest:.2f}"}
    return row | {"answer": "; ".join(found), "verdict": answer["verdict"]["sentence"]}


def peer_rows(python, folder, chosen):
    """The same records with PySINDy and a transfer function: peers.py in another Python."""
    for case in chosen:
        write_plant(folder / "cases" / case.name, plant_of(case))
    here = pathlib.Path(__file__).with_name("peers.py")
    command = [python, str(here), str(folder / "cases"), *(case.name for case in chosen)]
    rows = []
    alone = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=alone) as running:
        for line in running.stdout:
            rows.append(json.loads(line))
            print(*rows[-1].values(), sep=" | ", flush=True)
    return rows


def shown(rows):
    """Rows of a part, each printed as it comes."""
    names = ("case", "judged", "verdict", "free run %", "seconds", "numbers", "answer")
    found = []
    for row in rows:
        found.append(row)
        print(*(row.get(name) or "-" for name in names), sep=" | ", flush=True)
    return found


def merged(before, rows, order):
    """All rows of a part in the order of its list; those that were not made again stay."""
    again = {row["case"] for row in rows}
    kept = [row for row in before if row["case"] not in again]
    return sorted(kept + rows, key=lambda row: order.index(row["case"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("parts", nargs="*", default=[])
    parser.add_argument("--case", nargs="*", default=[])
    parser.add_argument("--python", default="python3")
    asked = parser.parse_args()
    program, folder = str(pathlib.Path(asked.program).resolve()), asked.folder.resolve()
    parts = asked.parts or ["experts", "plants", "swings", "fits"]
    lists = {"plants": CASES, "swings": SWINGS, "fits": TASKS, "experts": CASES, "peers": CASES}
    folder.mkdir(parents=True, exist_ok=True)
    at = folder / "cases"
    rows_of = {
        "experts": expert_row,
        "plants": lambda case: plant_row(case, program, at / case.name),
        "swings": lambda case: swing_row(case, program, at / case.name),
        "fits": lambda case: fit_row(case, program, at / case.name),
    }
    if {"recordings", "recorded_experts"} & set(parts):
        from recorded import recorded_expert_row, recording_row
        from recordings import RECORDINGS

        lists |= dict.fromkeys(("recordings", "recorded_experts"), RECORDINGS)
        rows_of["recordings"] = lambda case: recording_row(case, program, at / case.name)
        rows_of["recorded_experts"] = recorded_expert_row
    for part in (part for part in parts if part != "page"):
        chosen = [case for case in lists[part] if not asked.case or case.name in asked.case]
        if part == "peers":
            rows = peer_rows(asked.python, folder, chosen)
        else:
            rows = shown(map(rows_of[part], chosen))
        order = [case.name for case in lists[part]]
        write_table(folder, part, merged(read_table(folder, part), rows, order))
    compare_with_experts(folder)
    write_page(folder, np.__version__)


if __name__ == "__main__":
    main()
