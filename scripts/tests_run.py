#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a run of the tests did. Usage: tests_run.py FOLDER

Reads the result of each executable in the folder (test_results/ of a build: XML of GoogleTest),
prints the time of each and the tests that were skipped with their reasons, and ends with status 1
where there are any, but for those on measured records where LACUNA_DATA does not say where these
are.
"""
import collections
import os
import pathlib
import sys
import xml.etree.ElementTree as xml

NO_DATA = "LACUNA_DATA is not set"


def cases_of(path):
    """Name, seconds, and the reason why it was skipped (None where it ran) of each test."""
    for case in xml.parse(path).getroot().iter("testcase"):
        if case.get("status") != "run":
            continue  # another shard has it
        skipped = case.find("skipped")
        reason = None
        if skipped is not None:  # "file:line" and what the test says
            said = (skipped.get("message") or skipped.text or "").strip().split("\n")
            reason = said[-1].strip() or "no reason given"
        yield (case.get("classname") + "." + case.get("name"), float(case.get("time")), reason)


def main():
    seconds, counts, skipped = collections.Counter(), collections.Counter(), []
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.xml")):
        executable = path.name.split(".")[0]
        for name, time, reason in cases_of(path):
            seconds[executable] += time
            counts[executable] += 1
            if reason is not None:
                skipped.append((executable + "." + name, reason))
    if not counts:
        sys.exit("tests_run: no results in " + sys.argv[1])
    for executable, time in seconds.most_common():
        print("%8.1f s %5d tests  %s" % (time, counts[executable], executable))
    without_data = [name for name, reason in skipped
                    if reason == NO_DATA and not os.environ.get("LACUNA_DATA")]
    others = [(name, reason) for name, reason in skipped if name not in without_data]
    print("%d tests ran in %d executables, %d of them skipped"
          % (sum(counts.values()), len(counts), len(skipped)))
    if without_data:
        print("  %d on measured records: LACUNA_DATA does not say where these are"
              % len(without_data))
    for name, reason in others:
        print("  %s: %s" % (name, reason))
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
