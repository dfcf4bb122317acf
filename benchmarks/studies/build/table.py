# SPDX-License-Identifier: MIT
"""Times of the scripts that build and check, as results/build.md. Usage: table.py LOG...

Reads what cold.sh here, scripts/demo.sh, check.sh and try_python.sh print: lines such as "demo: built
after 170 s, 320 s of a core". A line that begins with "# " says on which machine and beside what.
"""

import datetime
import pathlib
import re
import sys

LINE = re.compile(r"(\w+: .*) (?:in|after) (\d+) s, (\d+) s of a core")


def rows_of(path):
    """What a log says: where it was made, and its steps with their seconds."""
    where = ""
    for line in path.read_text(errors="replace").splitlines():
        found = LINE.match(line)
        if line.startswith("# "):
            where = line[2:]
        elif found:
            yield (found[1], found[2], found[3], where)


def main():
    print("# Builds\n")
    print(
        "%s. Seconds are elapsed, of `demo` since it began; CPU seconds are of all processes,"
        " user and system.\nCommand: `table.py LOG...`, with what the scripts print.\n"
        % datetime.date.today()
    )
    print("| step | s | CPU s | where |\n| --- | --- | --- | --- |")
    for path in map(pathlib.Path, sys.argv[1:]):
        for row in rows_of(path):
            print("| %s |" % " | ".join(row))


if __name__ == "__main__":
    main()
