#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs lacuna on every case of cases.py. Usage: run.py PROGRAM [PART OF A NAME]

For all of them: the status is the expected one; an error is one line "lacuna: error: PLACE:
PROBLEM; REMEDY" without control characters; nothing takes longer than 20 s; no temporary file is
left; inputs are as they were.
"""
import os
import subprocess
import sys
import tempfile
import time

from cases import all_cases

LONGEST = 20.0  # seconds


def run(program, case, folder):
    """Status, standard output, errors; -1 where it did not end."""
    command = "%s; '%s' %s > '%s' 2> err" % (case.before, program, case.arguments, case.out)
    try:
        status = subprocess.run(["bash", "-c", os.fsencode(command)], cwd=folder, timeout=LONGEST,
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        status = -1
    out = os.path.join(folder, case.out)
    return status, read(out) if os.path.isfile(out) else b"", read(os.path.join(folder, "err"))


def read(path):
    with open(path, "rb") as stream:
        return stream.read()


def faults(case, status, out, err, folder):
    """What is wrong with a run, in words."""
    found = []
    if status != case.status:
        found.append("status %d, not %d" % (status, case.status))
    text = err if case.status else out
    if case.part and case.part.encode() not in text:
        found.append("no %r" % case.part)
    if status > 0 and (not err.startswith(b"lacuna: error: ") or err.count(b"\n") != 1 or
                       b"; " not in err):
        found.append("not one line of place, problem and remedy")
    if any(byte < 32 and byte not in (9, 10) or byte == 127 for byte in err):
        found.append("control characters")
    found += ["leaves " + name for name in os.listdir(folder) if name.endswith(".tmp")]
    found += ["changed " + name for name, content in case.files.items()
              if read(os.path.join(folder, name)) != content]
    return found


def main():
    program = os.path.abspath(sys.argv[1])
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    cases = [case for case in all_cases() if part in case.name]
    begin = time.monotonic()
    mishandled = 0
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            for name, content in case.files.items():
                with open(os.path.join(folder, name), "wb") as stream:
                    stream.write(content)
            status, out, err = run(program, case, folder)
            wrong = faults(case, status, out, err, folder)
        if wrong:
            mishandled += 1
            print("%s: %s\n    %s" % (ascii(case.name), "; ".join(wrong), ascii(err[:200])))
    print("%d inputs, %d mishandled, %.0f s" % (len(cases), mishandled, time.monotonic() - begin))
    return 1 if mishandled else 0


if __name__ == "__main__":
    sys.exit(main())
