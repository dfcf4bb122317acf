#!/usr/bin/env bash
# Changes one line of the library at a time and counts how many changes the tests notice.
# Usage: scripts/mutants.sh [--check] [--preset NAME] [--day COUNT] [PATTERN]
#   --check   only looks whether every entry's text is found exactly once
#   --preset  builds as this preset does; default variant, whose library is shared: there the changed
#             source alone is compiled and loaded before the library. What the tests do not notice
#             so is built as a whole
#   --day     only so many entries, whose turn it is by the day of the year; the table stays
#   PATTERN   only entries that hold this text; the others keep the result of an earlier run
# Works on the last commit, in a copy below build/mutants; the list is tests/mutants/mutants.txt,
# the result the table in tests/mutants/results.md. A change that does not build is an error, not noticed.
set -euo pipefail
cd "$(dirname "$0")/.."
check=false preset=variant day=0
while [ $# -gt 0 ]; do
  case $1 in
    --check) check=true; shift ;;
    --preset) preset=$2; shift 2 ;;
    --day) day=$2; shift 2 ;;
    *) break ;;
  esac
done
pattern=${1:-}
list=tests/mutants/mutants.txt
tree=build/mutants
results=build/mutants.results  # "RESULT in COMMIT<tab>ENTRY" of all runs
limit=300  # seconds of a core for the tests of one change; one that goes on longer is noticed

# So many in turn, each day those behind the ones of the day before.
of_the_day() {
  awk -v count="$day" -v day="$(date -u +%j)" '{ all[NR] = $0 }
    END { for (i = 0; i < count && i < NR; ++i) print all[(day * count + i) % NR + 1] }'
}

entries() {
  grep -v '^#' "$list" | grep -F -- "$pattern" |
    if [ "$day" -gt 0 ]; then of_the_day; else cat; fi
}

# occurrences FILE TEXT
occurrences() {
  TEXT=$2 perl -0777 -ne 'my $n = () = /\Q$ENV{TEXT}\E/g; print $n' "$1"
}

# replace FILE TEXT OTHER
replace() {
  TEXT=$2 OTHER=$3 perl -0777 -i -pe 's/\Q$ENV{TEXT}\E/$ENV{OTHER}/' "$1"
}

# read_entry LINE: sets file, text, other, tests
read_entry() {
  local rest=$1
  file=${rest%% | *} rest=${rest#* | }
  text=${rest%% | *} rest=${rest#* | }
  other=${rest%% | *} tests=${rest#* | }
}

# Paths are told ccache as relative ones: what another checkout has compiled is known here.
build() {
  CCACHE_BASEDIR=$PWD/$tree nice ninja -C "$tree/build/$preset" "$@" > "$log" 2>&1
}

check_entries() {
  local bad=0
  while IFS= read -r line; do
    read_entry "$line"
    local found=0
    [ -f "$1/$file" ] && found=$(occurrences "$1/$file" "$text")
    if [ "$found" != 1 ]; then
      echo "$file: '$text' is there $found times, not once" >&2
      bad=1
    fi
  done < <(entries)
  return "$bad"
}

# A copy of the last commit, of which ccache knows what is as it was.
prepare() {
  mkdir -p "$tree"
  find "$tree" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git archive HEAD | tar -x -m -C "$tree"  # all newer than what was built
  (cd "$tree" && cmake --preset "$preset") > /dev/null
}

# run_tests TEST [LIBRARY]: one executable, or its tests that "EXECUTABLE:FILTER" names, with
# a library that is loaded before all others
run_tests() {
  local filter='*'
  case $1 in *:*) filter=${1#*:} ;; esac
  (ulimit -c 0 -t "$limit"
    exec timeout "$((10 * limit))" env LD_PRELOAD="${2:-}" \
      "$tree/build/$preset/tests/${1%%:*}" --gtest_brief=1 --gtest_fail_fast --gtest_filter="$filter") > /dev/null 2>&1
}

# tests_notice [LIBRARY]: whether one of the entry's tests fails
tests_notice() {
  local test
  for test in $tests; do
    if ! run_tests "$test" "${1:-}"; then return 0; fi
  done
  return 1
}

# The command by which the shared library's sources are compiled, without source and object; empty
# where the library is not shared.
library_command() {
  perl -MJSON::PP -0777 -ne '
    for my $entry (@{decode_json($_)}) {
      next unless $entry->{command} =~ /-Dlacuna_EXPORTS/ && $entry->{command} !~ /-emit-pch/;
      print "cd $entry->{directory} && ", $entry->{command} =~ s/ -o \S+ -c \S+$//r;
      last;
    }' "$tree/build/$preset/compile_commands.json"
}

# compile_alone SOURCE: the source as a library of its own ($alone); of a header all the sources of
# its folder.
compile_alone() {
  local source=$root/$1
  case $1 in
    *.hpp) source=$root/build/$preset/CMakeFiles/lacuna.dir/Unity/unity_$(dirname "$1")_cxx.cxx ;;
  esac
  [ -n "$command" ] && bash -c "$command -shared -o '$alone' '$source'" > "$log" 2>&1
}

# targets_of TESTS...: their executables
targets_of() { printf '%s\n' "${@%%:*}" | sort -u; }

# stands_alone FILE TESTS: whether the tests pass with the source as it is loaded before the library;
# where they do not, what they notice of a change there says nothing.
declare -A alone_passes
stands_alone() {
  if [ -z "${alone_passes[$1 $2]:-}" ]; then
    alone_passes[$1 $2]=false
    compile_alone "$1" && ! tests_notice "$alone" && alone_passes[$1 $2]=true
  fi
  ${alone_passes[$1 $2]}
}

# One change; sets result: "noticed", "not noticed" or "does not build".
try_entry() {
  local quick=false
  stands_alone "$file" "$tests" && quick=true
  cp "$tree/$file" "$tree/build/original"
  replace "$tree/$file" "$text" "$other"
  result="not noticed"
  if $quick && compile_alone "$file" && tests_notice "$alone"; then
    result=noticed
  elif ! build $(targets_of $tests); then
    result="does not build"
  elif tests_notice; then
    result=noticed
  fi
  cp "$tree/build/original" "$tree/$file"
}

# result_of ENTRY: of the last run of it
result_of() {
  ENTRY=$1 perl -ne 'chomp; my ($r, $e) = split /\t/, $_, 2; $last = $r if $e eq $ENV{ENTRY};
    END { print $last // "not run" }' "$results"
}

# Rows of the table of all entries.
rows() {
  local line
  while IFS= read -r line; do
    read_entry "$line"
    printf '| `%s` | `%s` | `%s` | %s | %s |\n' \
      "$file" "${text//|/\\|}" "${other//|/\\|}" "$tests" "$(result_of "$line")"
  done < <(pattern='' day=0 entries)
}

# Writes the table as a page.
write_table() {
  local machine
  machine="$(nproc) cores, $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)"
  rows > build/mutants.rows
  {
    echo "# Mutants"
    echo
    echo "\`scripts/mutants.sh\` on $(date -u +%Y-%m-%d), $machine:" \
      "$(grep -c '| noticed in' build/mutants.rows) of $(wc -l < build/mutants.rows) noticed."
    echo
    echo "| file | line | instead | tests | result |"
    echo "|---|---|---|---|---|"
    cat build/mutants.rows
  } > build/mutants.md
  mv build/mutants.md tests/mutants/results.md
}

check_entries .
if $check; then exit 0; fi
prepare
check_entries "$tree"
root=$PWD/$tree log=$PWD/build/mutants.log alone=$PWD/build/mutant.so
command=$(library_command)
build $(targets_of $(entries | sed 's/.* | //')) || { cat "$log"; exit 1; }
# What is not noticed where nothing is changed says nothing.
for test in $(entries | sed 's/.* | //' | tr ' ' '\n' | sort -u); do
  run_tests "$test" || { echo "$test fails without a change" >&2; exit 1; }
done
touch "$results"
commit=$(git rev-parse --short HEAD)
all=0 noticed=0 broken=0
while IFS= read -r line; do
  read_entry "$line"
  try_entry
  all=$((all + 1))
  if [ "$result" = noticed ]; then noticed=$((noticed + 1)); fi
  if [ "$result" = "does not build" ]; then broken=$((broken + 1)); fi
  echo "$result: $file: $text -> $other"
  printf '%s in %s\t%s\n' "$result" "$commit" "$line" >> "$results"
  if [ "$day" -eq 0 ]; then write_table; fi
done < <(entries)
echo "$noticed of $all noticed, $broken do not build"
[ "$broken" -eq 0 ] && { [ "$day" -eq 0 ] || [ "$noticed" -eq "$all" ]; }
