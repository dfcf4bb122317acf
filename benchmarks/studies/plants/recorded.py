# SPDX-License-Identifier: MIT
"""Rows of the recordings: what an expert's box leaves, and what the program's answer does."""

import gzip

import numpy as np

from compiled import Model, Piece, error_of, fit
from grading import DELAY, called, equations_in, error_line, plain_numbers

CHAOTIC = 10  # pieces of a chaotic record that numbers are fitted to


def columns_of(path):
    """Names (units go) and numbers of a table of commas; an oscilloscope has two lines of names."""
    opened = gzip.open if path.suffix == ".gz" else open
    with opened(path, "rt") as file:
        lines = [line for line in file.read().splitlines() if line.strip() and line[0] != "#"]
    names = [name.split(" ")[0] for name in lines[0].strip(",").split(",") if name]
    while lines and not lines[0][:1].lstrip("-").isdigit():
        lines.pop(0)
    width = len(lines[0].rstrip(",").split(","))
    table = np.array([line.split(",")[:width] for line in lines], float)
    return dict(zip(names, table.T))


def rows_of(file):
    path, first, last = file if isinstance(file, tuple) else (file, 0, None)
    columns = columns_of(path)
    time = next(iter(columns.values()))
    return {name: values[first:last] for name, values in columns.items()}, time[first:last]


def called_in_file(recording, name):
    """The column of a name: --map NAME=COLUMN."""
    words = recording.options.split()
    pairs = words[words.index("--map") + 1].split(",") if "--map" in words else ()
    return dict(pair.split("=") for pair in pairs).get(name, name)


def record_of(recording, file):
    """Pieces without a gap."""
    columns, time = rows_of(file)
    time = time if recording.step is None else np.arange(len(time)) * recording.step
    step = float(np.median(np.diff(time)))
    ends = [*(np.flatnonzero(np.diff(time) > 3 * step) + 1), len(time)]
    pieces, begin = [], 0
    for end in ends:
        size = recording.pieces or end - begin
        for first in range(begin, end - size + 1, size):
            rows = slice(first, first + size)
            parts = [
                {name: columns[called_in_file(recording, name)][rows] for name in chosen}
                for chosen in (recording.channels, recording.holds)
            ]
            pieces.append(Piece(step, *parts, begin=float(time[first])))
        begin = end
    return pieces


def recorded_expert_row(recording):
    train, test = (record_of(recording, file) for file in recording.files)
    if recording.pieces:
        train = train[:: max(1, len(train) // CHAOTIC)]
    numbers, on_train = fit(recording.box, train)
    error = error_of(recording.box, test, numbers)
    equations = (f"d{state}/dt = {law}" for state, law in recording.box.equations.items())
    alone = ""
    if recording.plain:
        numbers_alone, _ = fit(recording.plain, train)
        alone = f"{100 * error_of(recording.plain, test, numbers_alone):.3g}"
    outputs = (f"{y} = {law}" for y, law in recording.box.outputs.items() if y != law)
    late = (f"{u} late" for u in recording.box.late)
    return {
        "case": recording.name,
        "structure": "; ".join((*equations, *outputs, *late)),
        "fit %": f"{100 * on_train:.3g}",
        "free run %": f"{100 * error:.3g}",
        "channels alone %": alone,
        "numbers": "; ".join(f"{name} {value:.5g}" for name, value in numbers.items()),
    }


def box_of(answer, recording):
    """The model of an answer, with numbers instead of names."""
    values = {entry["name"]: entry["value"] for entry in answer.get("parameters", ())}
    late, numbers, equations = {}, {}, {}
    for equation in answer["equations"]:
        terms = []
        for term in equation["terms"]:
            text = term["term"]
            for spot in DELAY.finditer(text):
                late[spot[1]] = f"{spot[1]}_late"
                numbers[late[spot[1]]] = float(values.get(spot[2].strip(), spot[2]))
            terms.append(f"({term['coefficient']!r})*({DELAY.sub(lambda s: s[1], text)})")
        equations[equation["state"]] = "+".join(terms) or "0.0"
    for name, value in values.items():
        numbers.setdefault(name, value)
    outputs = {name: name for name in recording.channels}
    starts = {f"{name}_d1": name for name in recording.channels}
    holds = {entry["name"]: entry.get("hold") for entry in answer.get("inputs", ())}
    holds = {name: hold or recording.holds[name] for name, hold in holds.items()}
    return Model(equations, numbers, outputs, holds, late, starts, recording.box.parts)


def written(recording, folder, name, file):
    """The path of a record; a part of one is written to a file of its own."""
    if not isinstance(file, tuple):
        return str(file)
    columns, _ = rows_of(file)
    lines = [",".join(columns)]
    lines += [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values())]
    (folder / name).write_text("\n".join(lines) + "\n")
    return name


def command_of(recording, folder):
    train, test = (
        written(recording, folder, name, file)
        for name, file in zip(("a.csv", "b.csv"), recording.files)
    )
    return ["identify", train, *recording.options.split(), "--holdout", test]


def recording_row(recording, program, folder):
    folder.mkdir(parents=True, exist_ok=True)
    command = [program, *command_of(recording, folder), "--threads", "1", "--json", "answer.json"]
    text, answer, seconds = called(command, folder, "answer.json")
    (folder / "answer.txt").write_text(text)
    row = {"case": recording.name, "options": recording.options, "seconds": f"{seconds:.1f}"}
    if answer is None:
        return row | {"verdict": "no answer", "answer": error_line(text)}
    box = box_of(answer["model"], recording)
    error = error_of(box, record_of(recording, recording.files[1]), box.numbers)
    return row | {
        "verdict": (answer.get("validation") or {}).get("verdict", ""),
        "free run %": f"{100 * error:.3g}" if error < 10 else "leaves",
        "answer": plain_numbers(equations_in(text)),
    }
