#!/usr/bin/env bash
# The ten best candidates of a catalogue with springs relaxed at 30, 60, 90 and 120 degrees, let go with damping
# from half of that and from D (179 if that is 180, where it stands still): how far from there they come to rest. stops.sh PROGRAM CATALOGUE
set -euo pipefail
program=$1 catalogue=$2
echo "| draw | D | R | from | damping | outcome | rest | apart | stiffness N mm/rad | barrier N mm |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for draw in $(sqlite3 -readonly "$catalogue" "SELECT draw FROM candidates
    ORDER BY goes_back, deploys_from_deg DESC, miscut_margin_mm DESC LIMIT 10"); do
  D=$(sqlite3 -readonly "$catalogue" "SELECT min(deploys_from_deg, 179.0) FROM candidate WHERE draw = $draw")
  for R in 30 60 90 120; do
    for from in $((R / 2)) "$D"; do
      # Enough not to swing over flat from D, where the energy is many times the barrier.
      damping=0.1
      "$program" deploy "$catalogue" "$draw" --rest-deg $R --from "$from" --damping $damping --time-limit 600 --json \
        > /tmp/stop.$$.json || { echo "| $draw | $D | $R | $from | refused |"; continue; }
      sqlite3 :memory: "WITH f AS (SELECT readfile('/tmp/stop.$$.json') AS j)
        SELECT '| $draw | $D | $R | ' || $from || ' | $damping | ' || (j ->> '\$.outcome') || ' | ' ||
          printf('%.4f', j ->> '\$.end.pilot_deg') || ' | ' ||
          printf('%.4f', abs((j ->> '\$.end.pilot_deg') - $R)) || ' | ' ||
          (SELECT printf('%.4g', value ->> '\$.stiffness_n_mm_per_rad') FROM json_each(j, '\$.equilibria')
           WHERE abs((value ->> '\$.pilot_deg') - $R) < 1e-3) || ' | ' ||
          printf('%.4g', j ->> '\$.barrier_n_mm') || ' |' FROM f"
    done
  done
done
rm -f /tmp/stop.$$.json
