#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs lacuna on every case of cases.py and of cases_*.py, as many at once as there are cores.
Usage: run.py PROGRAM [PART OF A NAME]

For all of them: the status is the expected one and no crash; an error is one line "lacuna: error:
PLACE: PROBLEM; REMEDY" without control characters; an answer does not contradict itself
(consistency.py); nothing takes 20 s of a core or does not end; no temporary file is left; inputs
are as they were. All together there are at least 700, and they take less than 10 minutes of a core.
"""
import concurrent.futures
import glob
import importlib
import json
import os
import re
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import threading
import time

import cases
import consistency

LONGEST = 20.0  # seconds of a core for one
PATIENCE = 120.0  # seconds, on a machine with much else to do
FEWEST = 700  # cases
MOST = 600.0  # seconds of a core for all: 5 minutes on two


def all_cases():
    """Those of cases.py, then those of each cases_*.py, in the order of names."""
    yield from cases.all_cases()
    for path in sorted(glob.glob(os.path.join(os.path.dirname(__file__), "cases_*.py"))):
        yield from importlib.import_module(os.path.basename(path)[:-3]).cases()


def run(program, case, folder):
    """Status (none where it did not end), seconds of a core, standard output, errors."""
    command = "%s; '%s' %s > '%s' 2> err" % (case.before, program, case.arguments, case.out)
    shell = subprocess.Popen(["bash", "-c", os.fsencode(command)], cwd=folder,
                             stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL, start_new_session=True)
    ended = threading.Event()
    watch = threading.Timer(PATIENCE, lambda: ended.is_set() or os.killpg(shell.pid, signal.SIGKILL))
    watch.start()
    _, code, used = os.wait4(shell.pid, 0)
    ended.set()
    watch.cancel()
    shell.returncode = os.waitstatus_to_exitcode(code)
    status = None if shell.returncode == -signal.SIGKILL else shell.returncode
    return (status, used.ru_utime + used.ru_stime, read(os.path.join(folder, case.out)),
            read(os.path.join(folder, "err")))


def read(path):
    if not os.path.isfile(path):
        return b""
    with open(path, "rb") as stream:
        return stream.read()


def status_faults(case, status, core):
    if status is None:
        return ["does not end"]
    if core > LONGEST:
        return ["takes %.0f s of a core" % core]
    if status < 0 or status > 130:  # by a signal, as this process or as the shell sees it
        return ["crashes: status %d" % status]
    return [] if status == case.status else ["status %d, not %d" % (status, case.status)]


def json_name(arguments):
    """The file that --json names; "-" is standard output, none where it is not asked for."""
    try:
        words = shlex.split(arguments)
    except ValueError:
        return None
    for i, word in enumerate(words):
        if word.startswith("--json="):
            return word[len("--json="):]
        if word == "--json" and i + 1 < len(words):
            return words[i + 1]
    return None


def answer_faults(case, out, folder):
    """Contradictions of what was answered; JSON has to be read whole."""
    name = json_name(case.arguments)
    answer = None
    if name is not None and case.out == "out":
        text = out if name == "-" else read(os.path.join(folder, name))
        try:
            answer = json.loads(text)
        except ValueError as error:
            return ["JSON cannot be read: %s" % error]
    return consistency.faults(case.arguments, out.decode("utf-8", "replace"), answer)


def error_faults(err):
    found = []
    if not re.fullmatch(rb"lacuna: error: [^\n]*; [^\n]*\n", err):
        found.append("not one line of place, problem and remedy")
    return found


def faults(case, status, core, out, err, folder):
    """What is wrong with a run, in words."""
    found = status_faults(case, status, core)
    text = err if case.status else out
    unfolded = b" ".join(text.split())  # what people read is folded at the width of a screen
    if case.part and case.part.encode() not in text and case.part.encode() not in unfolded:
        found.append("no %r" % case.part)
    if status:
        found += error_faults(err)
    elif status == 0:
        found += answer_faults(case, out, folder)
    if any(byte < 32 and byte not in (9, 10) or byte == 127 for byte in err):
        found.append("control characters")
    found += ["leaves " + name for name in os.listdir(folder) if name.endswith(".tmp")]
    found += ["changed " + name for name, content in case.files.items()
              if read(os.path.join(folder, name)) != content]
    return found


def examine(program, case):
    """What is wrong with one case, and its message."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in case.files.items():
            with open(os.path.join(folder, name), "wb") as stream:
                stream.write(content)
        status, core, out, err = run(program, case, folder)
        return faults(case, status, core, out, err, folder), err


def main():
    program = os.path.abspath(sys.argv[1])
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    chosen = [case for case in all_cases() if part in case.name]
    begin = time.monotonic()
    mishandled = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda case: examine(program, case), chosen)
        for case, (wrong, err) in zip(chosen, results):
            if wrong:
                mishandled += 1
                print("%s: %s\n    %s" % (ascii(case.name), "; ".join(wrong), ascii(err[:200])),
                      flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    core = used.ru_utime + used.ru_stime
    print("%d inputs, %d mishandled, %.0f s, %.0f s of a core" % (
        len(chosen), mishandled, time.monotonic() - begin, core))
    if not part and len(chosen) < FEWEST:
        print("fewer than %d inputs" % FEWEST)
    if core > MOST:
        print("more than %.0f s of a core" % MOST)
    return 1 if mishandled or core > MOST or not part and len(chosen) < FEWEST else 0


if __name__ == "__main__":
    sys.exit(main())
