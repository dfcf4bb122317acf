#!/usr/bin/env bash
# Reports of six kinds, checked in Chromium at 390 and 1 400 pixels, light and dark: axe-core finds
# nothing serious, no text lies on another, nothing scrolls sideways, everything that answers a click
# answers the keyboard, text has a contrast of 4.5.
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
"$lacuna" simulate bench.ode --x0 0,0 --t-end 40 --dt 0.02 --noise x=0.005,v=0.01 -o run.csv
"$lacuna" identify run.csv --states x,v --inputs F --degree 1 --report identify.html >/dev/null
"$lacuna" diagnose --model nominal.ode run.csv --report diagnose.html >/dev/null
"$lacuna" fit nominal.ode run.csv --report fit.html >/dev/null
"$lacuna" sync nominal.ode run.csv --report sync.html >/dev/null
"$lacuna" fit nominal.ode square.ode run.csv --report rivals.html >/dev/null
"$lacuna" plan nominal.ode square.ode --data run.csv --input 'F=-1..1, hold 0.5' --duration 6 \
  --sample 0.1 --candidates 40 --searches 1 --evaluations 60 --report plan.html >/dev/null

npm install --silent --no-audit --no-fund axe-core@4 puppeteer-core@24
NODE_PATH=$here/node_modules node ../../scripts/report_checks.js ./*.html
