#!/usr/bin/env bash
# Runs all tests with lines counted (preset coverage) and prints, as a table, the share of the lines
# of each folder that ran. Usage: scripts/coverage.sh [TABLE.md]
set -euo pipefail
cd "$(dirname "$0")/.."
table=${1:-build/coverage/coverage.md}

scripts/setup.sh check coverage
cmake --preset coverage
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
ctest --preset coverage -j "$(nproc)"
# Threads count beside each other: some branches have run less than 0 times, lines are right.
gcovr --root . --object-directory build/coverage -j "$(nproc)" --gcov-ignore-parse-errors \
  --filter '(include|src|bases|solvers|effects|apps)/' --csv build/coverage/lines.csv
# A header counts where its sources lie.
awk -F, 'NR > 1 {
    folder = $1
    sub("/[^/]*$", "", folder)
    sub("^include/lacuna/", "src/", folder)
    if (folder ~ "^src/(bases|solvers|effects)(/|$)") sub("^src/", "", folder)
    all[folder] += $2; ran[folder] += $3; lines += $2; good += $3
  }
  END {
    print "| folder | lines | ran % |\n|---|---|---|"
    for (folder in all)
      printf "| `%s` | %d | %.1f |\n", folder, all[folder], 100 * ran[folder] / all[folder] | "sort"
    close("sort")
    printf "| all | %d | %.1f |\n", lines, 100 * good / lines
  }' build/coverage/lines.csv | tee "$table"
