#!/usr/bin/env bash
# The runs of elastic.md, one after the other: elastic.sh PROGRAM DIRECTORY [GROUP...], of the groups starts, mesh,
# steps, stiff and stop. What has been run is not run again. elastic.py DIRECTORY makes tables and pictures of it.
set -euo pipefail
program=$(realpath "$1") directory=$2
shift 2
table1=$(realpath "$(dirname "$0")/../../search/patterns/table1.json")
mkdir -p "$directory"
cd "$directory"
export OMP_NUM_THREADS=1

# run NAME OPTION...
run() {
  local name=$1
  shift
  [ -e "$name/table1-stress.json" ] && return
  "$program" stress "$table1" --output "$name" "$@" > "$name.txt" 2> "$name.log" || { cat "$name.log" >&2; return 1; }
  rm -f "$name"/*.frd "$name"/*.dat # most of what ccx writes, and read by now
  echo "$name: $(grep -e '^  outside' -e '^CalculiX' "$name.txt" | tr '\n' ' ')"
}

# 36 deg, the first shake.
mesh() {
  local n
  for n in 2 4 8; do run "mesh-$n" --mesh $n --time-limit 0.006; done
  run mesh-8-step-1e-4 --mesh 8 --time-limit 0.002 --time-step 1e-4
  run mesh-16 --mesh 16 --time-limit 0.002
  for n in 4 8 12 16; do run "first-mesh-$n" --mesh $n --time-limit 0.001 --time-step 1e-4; done
  run mesh-20-disc-0 --mesh 20 --time-limit 0.0012 --disc 0
}

steps() {
  local step
  for step in 4e-4 2e-4 1e-4 5e-5; do run "step-$step" --mesh 4 --time-limit 0.006 --time-step $step; done
}

# From other angles.
starts() {
  local from
  for from in 20 36 60 90 108 120 144; do run "start-$from-mesh-2" --from $from --mesh 2 --time-limit 0.01; done
  for from in 36 53 54 55 60 68 72 90 120; do run "start-$from-mesh-4" --from $from --mesh 4 --time-limit 0.01; done
  run start-53-mesh-20-disc-0 --from 53 --mesh 20 --time-limit 0.0012 --disc 0
}

# material GPA
material() { echo "{ \"name\": \"$1 GPa\", \"e_gpa\": $1 }" > "e-$1.json"; }

# Towards rigid panels.
stiff() {
  local e_gpa
  for e_gpa in 70 700 7000 70000 700000; do
    material $e_gpa
    run "stiff-$e_gpa" --material "e-$e_gpa.json" --mesh 2 --time-limit 0.1
  done
}

# stop_from FROM GPA DAMPING SECONDS: springs relaxed at 30 deg.
stop_from() {
  material "$2"
  run "stop-$1-$2" --rest-deg 30 --from "$1" --material "e-$2.json" --damping "$3" --time-step 4e-3 --time-limit "$4"
}
stop() {
  stop_from 15 7000 30 1
  stop_from 36 7000 30 1
  stop_from 15 70 10 2.5
}

for group in ${*:-mesh steps starts stiff stop}; do "$group"; done
