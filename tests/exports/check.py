#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads exported models as others read their languages. Usage: check.py FORMAT FOLDER RUN

FOLDER holds 0.FORMAT, 1.FORMAT, ... and models.json: numbers of states and inputs of each model
and its rates at some places. For every file: it is ASCII; the lexer of the language (Python's own,
Pygments' for the others) finds the marker of hostile texts in comments and strings only. The first
RUN of them are run: compilers and interpreters take them without a warning and compute the same
rates to 1e-12.
"""
import json
import os
import re
import sys

import languages

MARKER = "qzevil"
TOLERANCE = 1e-12
MOST_REFUSED = 0.25  # of all places: most have a number
SMALLEST = 1e-60  # ngspice has 1e-99 for 0 in places


class Model:
    """An exported file and what the model says."""

    def __init__(self, number, path, facts):
        self.number = number
        self.path = path
        with open(path, "rb") as stream:
            self.bytes = stream.read()
        self.text = self.bytes.decode("latin-1")
        self.states = facts["states"]
        self.inputs = facts["inputs"]
        self.points = [Point(point) for point in facts["points"]]


class Point:
    def __init__(self, facts):
        self.t = facts["t"]
        self.x, self.u = facts["x"], facts["u"]
        self.divides_by_zero = facts["divides_by_zero"]
        self.rate = [float(text) for text in facts["rate"]]
        self.size = [float(text) for text in facts["size"]]


def byte_faults(model):
    """What holds for every language."""
    if not re.fullmatch(rb"[ -~\n]*\n", model.bytes):
        yield "bytes that are not printable ASCII"


def same(found, expected, size):
    """Whether a number is the expected one, up to rounding errors of what size is."""
    if expected != expected or abs(expected) == float("inf"):
        return found == expected or found != found and expected != expected
    return abs(found - expected) <= TOLERANCE * max(SMALLEST, size if size < 1e300 else 0.0)


def value_faults(model, answers, has_nan):
    """Differences at the places; an answer of None is a refusal of the language, which is right
    where no number is. Without has_nan the language has others in the place of such, and refuses
    whole powers below 0 whose exponents are no numbers; nor is it compared where a number is
    divided by 0, which is a large one there."""
    for point, found in zip(model.points, answers):
        is_finite = all(abs(rate) < 1e30 for rate in point.rate)
        is_plain = is_finite and not point.divides_by_zero
        if found is None:
            if is_finite and has_nan:
                yield "no numbers, not %s" % point.rate
        elif len(found) != len(point.rate):
            yield "%d numbers, not %d" % (len(found), len(point.rate))
        elif (is_plain or has_nan) and not all(map(same, found, point.rate, point.size)):
            yield "%s, not %s" % (found, point.rate)


def main():
    language, folder = sys.argv[1], sys.argv[2]
    with open(os.path.join(folder, "models.json")) as stream:
        facts = json.load(stream)
    models = [Model(k, os.path.join(folder, "%d.%s" % (k, language)), one)
              for k, one in enumerate(facts)]
    reader = languages.READERS[language]
    faults = []
    for model in models:
        faults += [(model, fault) for fault in byte_faults(model)]
        faults += [(model, fault) for fault in reader.code_faults(model, MARKER)]
    answers = reader.run(models[:int(sys.argv[3])], folder) if not faults else {}
    for model in models:
        if model.number in answers:
            faults += [(model, fault) for fault in
                       value_faults(model, answers[model.number], reader.has_nan)]
    for model, fault in faults[:5]:
        print("%s: %s\n%s" % (model.path, fault, ascii(model.text)))
    compared = sum(len(one) for one in answers.values())
    refused = sum(point is None for one in answers.values() for point in one)
    skipped = 0 if reader.has_nan else sum(
        point.divides_by_zero for model in models if model.number in answers
        for point, _ in zip(model.points, answers[model.number]))
    print("%s: %d models, %d places, %d of them refused, %d that divide by 0 not compared, %d faults" %
          (language, len(models), compared, refused, skipped, len(faults)))
    sys.exit(1 if faults or not models or refused > MOST_REFUSED * compared else 0)


if __name__ == "__main__":
    main()
