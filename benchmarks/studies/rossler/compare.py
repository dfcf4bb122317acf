#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the exact structures of two runs of study_rossler against each other, cell by cell.
Usage: compare.py BEFORE/rossler.csv AFTER/rossler.csv. Ends with status 1 where a cell is worse."""
import csv
import sys

RATE = "exact structure rate"
CELL = ["filter", "regressor", "pruner", "derivative", "samples", "noise %"]


def rates(path):
    with open(path, newline="") as stream:
        return {tuple(row[name] for name in CELL): float(row[RATE])
                for row in csv.DictReader(stream)}


def main():
    before, after = rates(sys.argv[1]), rates(sys.argv[2])
    common = [cell for cell in before if cell in after]
    better = [cell for cell in common if after[cell] > before[cell]]
    worse = [cell for cell in common if after[cell] < before[cell]]
    for name, cells in [("better", better), ("worse", worse)]:
        for cell in cells:
            print("%s: %s: %g -> %g" % (name, ", ".join(cell), before[cell], after[cell]))
    print("%d cells: %d better, %d worse" % (len(common), len(better), len(worse)))
    return 1 if worse or not common else 0


if __name__ == "__main__":
    sys.exit(main())
