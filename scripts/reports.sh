#!/usr/bin/env bash
# Reports of six kinds, checked in Chromium at 390 and 1 400 pixels, light and dark: axe-core finds
# nothing serious, no text lies on another, nothing scrolls sideways, every term of the equations
# is whole within its line, what answers a click answers the keyboard, text has a contrast of 4.5;
# pictures that show the same agree to 1e-6 of its range, with one another and with the JSON, as
# they are read from what is drawn.
# Usage: scripts/reports.sh [PROGRAM]   (needs node, npm and Chromium; writes build/reports)
set -euo pipefail
cd "$(dirname "$0")/.."
lacuna=$(realpath "${1:-build/check/lacuna}")
here=$PWD/build/reports
mkdir -p "$here"
cd "$here"

printf '%s\n' 'state a' 'state b' 'da/dt = b' \
  'db/dt = -2*a - 0.5*b - 0.3*tanh(b/0.01) + 2*sin(1.1*t) + sin(2.7*t)' \
  'x = a [m]' 'v = b [m/s]' 'F = 2*sin(1.1*t) + sin(2.7*t) [m/s^2]' >bench.ode
printf '%s\n' 'time s' 'input F [m/s^2] hold smooth' 'state x [m]' 'state v [m/s]' \
  'param c = 0.3 in 0..5' 'dx/dt = v' 'dv/dt = -2*x - c*v + F' >nominal.ode
sed 's/c\*v/c*v*abs(v)/' nominal.ode >square.ode
# Few enough samples that every one of them is drawn.
"$lacuna" simulate bench.ode --x0 0,0 --t-end 40 --dt 0.1 --noise x=0.005,v=0.01 -o run.csv
"$lacuna" simulate lorenz --x0 1,1,20 --t-end 8 --dt 0.02 --noise x=0.05,y=0.05,z=0.05 -o lorenz.csv

# report NAME ARGUMENTS...: NAME.html and the same answer as NAME.json.
report() { "$lacuna" "${@:2}" --report "$1.html" --json "$1.json" >/dev/null; }
report identify identify run.csv --states x,v --inputs F --degree 1
report orbit identify lorenz.csv --degree 2
report diagnose diagnose --model nominal.ode run.csv
report fit fit nominal.ode run.csv
report sync sync nominal.ode run.csv
report rivals fit nominal.ode square.ode run.csv
report plan plan nominal.ode square.ode --data run.csv --input 'F=-1..1, hold 0.5' --duration 6 \
  --sample 0.1 --candidates 40 --searches 1 --evaluations 60

npm install --silent --no-audit --no-fund axe-core@4 puppeteer-core@24
NODE_PATH=$here/node_modules node ../../scripts/report_checks.js ./*.html
