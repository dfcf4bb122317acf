#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists the tests that a run of CTest skipped, each with its reason. Usage: skipped.py JUNIT.xml

Ends with status 1 where there are any, but for those on measured records where LACUNA_DATA does
not say where these are.
"""
import os
import re
import sys
import xml.etree.ElementTree as xml

NO_DATA = "LACUNA_DATA is not set"


def skipped_tests(path):
    """Name and reason of each; of a test of GoogleTest, what it says behind "Skipped"."""
    for case in xml.parse(path).getroot().iter("testcase"):
        if case.find("skipped") is None:
            continue
        said = re.search(r": Skipped\n(.*)", case.findtext("system-out") or "")
        yield case.get("name"), said.group(1).strip() if said else "no reason given"


def main():
    all_skipped = list(skipped_tests(sys.argv[1]))
    without_data = [name for name, reason in all_skipped
                    if reason == NO_DATA and not os.environ.get("LACUNA_DATA")]
    others = [(name, reason) for name, reason in all_skipped if name not in without_data]
    print("%d tests skipped" % len(all_skipped))
    if without_data:
        print("  %d of them on measured records: LACUNA_DATA does not say where these are"
              % len(without_data))
    for name, reason in others:
        print("  %s: %s" % (name, reason))
    return 1 if others else 0


if __name__ == "__main__":
    sys.exit(main())
