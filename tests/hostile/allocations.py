#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs lacuna with large allocations failing, at many places. Usage:
allocations.py PROGRAM FAILING_MALLOC_LIBRARY [RUNS PER COMMAND]

Each run must end with status 2 and one line that speaks of memory, or as without failures where
the allocation that failed was not needed. A crash, a hang or another message is a finding.
"""
import gzip
import json
import os
import random
import struct
import subprocess
import sys
import tempfile

from cases import MODEL, npy, oscillation

COMMANDS = ["identify r.csv", "identify r.csv.gz --degree 2", "identify r.npy --degree 1",
            "identify noisy.csv --degree 1 --preset robust", "sync m.json r.csv",
            "diagnose --model m.json r.csv --threads 1 --max-effects 1",
            "simulate m.json --x0 1,0 --t-end 100 --dt 0.01"]


def write_inputs(folder):
    source = random.Random(1)
    record = oscillation(2000)
    table = [[float(value) for value in line.split(",")] for line in record.decode().split()[1:]]
    noisy = "t,x,y\n" + "".join("%.6f,%.6f,%.6f\n" % (
        t, x + source.gauss(0, 0.01), y + source.gauss(0, 0.01)) for t, x, y in table[:600])

    data = b"".join(struct.pack("<3d", *row) for row in table)
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2000, 3), }\n"
    for name, content in {"r.csv": record, "r.csv.gz": gzip.compress(record),
                          "r.npy": npy(header, data), "noisy.csv": noisy.encode(),
                          "m.json": json.dumps(MODEL).encode()}.items():
        with open(os.path.join(folder, name), "wb") as stream:
            stream.write(content)


def run(program, library, arguments, folder, **settings):
    environment = dict(os.environ, LD_PRELOAD=library, **settings)
    try:
        return subprocess.run([program] + arguments.split(), cwd=folder, env=environment,
                              capture_output=True, timeout=120)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(arguments, -99, b"", b"it does not end")


def is_right(result, normal):
    if result.returncode == normal.returncode and result.returncode != 2:
        return True
    lines = result.stderr.count(b"\n")
    return result.returncode == 2 and lines == 1 and b"memory" in result.stderr


def main():
    program, library = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 30
    findings = total = 0
    with tempfile.TemporaryDirectory() as folder:
        write_inputs(folder)
        for arguments in COMMANDS:
            normal = run(program, library, arguments, folder, FAIL_COUNT="1")
            count = int(normal.stderr.split(b"LARGE")[1])
            source = random.Random(arguments)
            places = set(range(1, min(runs // 2, count) + 1))
            places |= {source.randint(1, count) for _ in range(runs // 2)}
            for place in sorted(places):
                for settings in [{}, {"FAIL_ONCE": "1"}]:
                    result = run(program, library, arguments, folder, FAIL_AT=str(place),
                                 **settings)
                    total += 1
                    if is_right(result, normal):
                        continue
                    findings += 1
                    print("%s, allocation %d of %d %s: status %d, %r" % (
                        arguments, place, count, settings, result.returncode,
                        result.stderr[-200:]))
    print("%d runs, %d findings" % (total, findings))
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
