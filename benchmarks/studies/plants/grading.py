# SPDX-License-Identifier: MIT
"""Runs the program as a user types it, and compares the answer with what holds."""

import csv
import itertools
import json
import re
import resource
import subprocess

import numpy as np

DELAY = re.compile(r"delay\((\w+),\s*([^(),]+)\)")
LIMIT = 1200  # s for one call


def write_columns(path, time, columns):
    table = np.column_stack([time, *columns.values()])
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["t [s]", *columns])
        writer.writerows([[f"{value:.9g}" for value in row] for row in table])


def called(command, folder, answer=None):
    """What the program wrote, the JSON of its answer (None: none), user seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    if answer:
        (folder / answer).unlink(missing_ok=True)
    try:
        done = subprocess.run(
            command, cwd=folder, capture_output=True, text=True, timeout=LIMIT, check=False
        )
        text = done.stdout + done.stderr
    except subprocess.TimeoutExpired:
        text = f"error: no answer after {LIMIT} s"
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    found = None
    if answer and (folder / answer).exists():
        found = json.loads((folder / answer).read_text())
    return text, found, seconds


def error_line(text):
    lines = [line for line in text.splitlines() if "rror:" in line]
    return (lines or text.strip().splitlines() or ["nothing"])[0].strip()


def identify(program, folder, embed, inputs):
    """The answer of `identify`, its text, seconds."""
    command = [program, "identify", "a.csv", "--threads", "1"]
    command += [part for name, order in embed.items() for part in ("--embed", f"{name}={order}")]
    if inputs:
        command += ["--inputs", ",".join(inputs)]
        command += [part for name in inputs for part in ("--hold", f"{name}=zero")]
    command += ["--json", "answer.json", "--model-out", "answer.ode"]
    (folder / "answer.ode").unlink(missing_ok=True)
    text, answer, seconds = called(command, folder, "answer.json")
    (folder / "answer.txt").write_text(text)
    return answer, text, seconds


def terms_of(model, chain=()):
    """The terms of each equation that is not a chain's; dead times with a name as numbers."""
    values = {entry["name"]: entry["value"] for entry in model.get("parameters", ())}

    def in_numbers(found):
        return f"delay({found[1]},{values.get(found[2].strip(), found[2])})"

    return {
        equation["state"]: [DELAY.sub(in_numbers, term["term"]) for term in equation["terms"]]
        for equation in model["equations"]
        if equation["state"] not in chain
    }


def without_delays(terms):
    """Plain terms, and the dead times (s) that each input has in them (0: none)."""
    plain, late = set(), {}
    for term in terms:
        spots = DELAY.findall(term)
        short = DELAY.sub(r"\1", term)
        short = re.sub(r"^tanh\((\w+_d1)[^()]*\)$", r"sign(\1)", short)
        plain.add(short)
        for name in re.findall(r"[A-Za-z_]\w*", short):
            found = [float(value) for spot, value in spots if spot == name]
            late.setdefault(name, []).extend(found or [0.0])
    return plain, late


def structures(plain, asymmetric):
    """The sets of terms that are right; an asymmetry has to be there in one of its spellings."""
    plain = set(plain)
    if not asymmetric:
        return [plain]
    extra = ("abs(u)", "max(u,0)", "min(u,0)", "max(0,u)", "min(0,u)", "u*step(u)", "u*sign(u)")
    pairs = itertools.product(("max(u,0)", "max(0,u)"), ("min(u,0)", "min(0,u)"))
    right = [plain | {term} for term in extra]
    return right + [plain - {"u"} | set(pair) for pair in pairs]


def judged(plant, terms):
    """right, or what is wrong: terms, dead time."""
    faults = []
    for state, plain in plant.shape.equations.items():
        found, late = without_delays(terms.get(state, ()))
        if found not in structures(plain, plant.asymmetry > 0):
            faults.append("terms")
        for name, value in plant.delays.items():
            if any(abs(late_one - value) > 0.5 * plant.step for late_one in late.get(name, ())):
                faults.append("dead time")
    return " and ".join(dict.fromkeys(faults)) or "right"


def free_run_error(program, folder, record, states):
    """The error of the program's model on the held-out record, over the motion; None: no run."""
    start = ",".join(f"{record.start[name]:.9g}" for name in states)
    command = [program, "simulate", "answer.ode", f"--x0={start}", "--input-data", "b.csv"]
    (folder / "free.csv").unlink(missing_ok=True)
    called([*command, "-o", "free.csv"], folder)
    try:
        with open(folder / "free.csv") as file:
            rows = list(csv.reader(file))
        header = [name.split(" ")[0] for name in rows[0]]
        table = np.array(rows[1:], float)
    except (OSError, ValueError, IndexError):
        return None
    if len(table) != len(record.time) or not np.isfinite(table).all():
        return None
    parts = [
        np.mean((table[:, header.index(name)] - values) ** 2) / values.var()
        for name, values in record.channels.items()
    ]
    return float(np.sqrt(np.mean(parts)))


def equations_in(text):
    """The equations as the program prints them, in one line; not those that name a rate."""
    lines, inside = [], False
    for line in text.splitlines():
        if line.startswith("Equations"):
            inside = True
        elif inside and not line.strip():
            break
        elif inside and line.strip().startswith("d"):
            lines.append(line.strip())
        elif inside and lines:
            lines[-1] += " " + line.strip()
    return "; ".join(line for line in lines if not re.fullmatch(r"d\w+/dt = \w+_d\d", line))


def plain_numbers(equations):
    """Without intervals: what a table has room for."""
    return re.sub(r"\((-?[0-9.eE+-]+) \+- [^)]*\)", r"\1", equations)
