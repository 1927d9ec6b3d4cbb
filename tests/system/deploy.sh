# A sheet that is let go: the verb, the functions in SQL, what is refused.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 1200 --progress none \
  --catalogue a.db > /dev/null || fail "search"
draw=$(sql a.db 'SELECT max(draw) FROM candidate')

# json_test FILE CONDITION: of the JSON j.

"$program" deploy "$table1" --json > free.json || fail "deploy"
# What programs that share no code with this one found: 5.538 N mm, 30 degrees passed after 0.0433 s.
json_test free.json "abs(json_extract(j, '\$.energy_n_mm[0]') - 5.538) < 5e-4" || fail "energy"
json_test free.json "(SELECT abs(json_extract(j, '\$.time_s[' || key || ']') - 0.0433) < 5.1e-5
  FROM json_each(j, '\$.pilot_deg') WHERE abs(value - 30) < 1e-9)" || fail "time of 30 degrees"
[ "$(field free.json outcome)" = passed_flat ] || fail "outcome"
json_test free.json "(SELECT max(abs(a.value - b.value)) <= 0.5 + 1e-9 FROM json_each(j, '\$.pilot_deg') a
  JOIN json_each(j, '\$.pilot_deg') b ON b.key = a.key + 1)" || fail "rows are farther apart than 0.5 deg"
json_test free.json "json_array_length(j, '\$.time_s') = json_array_length(j, '\$.rate_deg_per_s')" ||
  fail "columns"

# The critical friction is critical; with it springs of the campaign are what is needed.
critical=$(field free.json critical_friction_n_mm_per_mm)
for share in 0.999 1.001; do
  "$program" deploy "$table1" --friction "$(awk "BEGIN { print $share * $critical }")" --json > some.json
  case $share-$(field some.json outcome) in
    0.999-passed_flat | 1.001-flat | 1.001-stalled) ;;
    *) fail "with $share of the critical friction: $(field some.json outcome)" ;;
  esac
done
json_test some.json "abs(json_extract(j, '\$.stiffness_needed_n_per_mm') / 50.05 - 1) < 1e-3" ||
  fail "the stiffness that is needed"

# Every outcome can be had, and is said in words.
while IFS='|' read -r options outcome words; do
  # shellcheck disable=SC2086
  "$program" deploy "$table1" $options --json > some.json || fail "deploy $options"
  [ "$(field some.json outcome)" = "$outcome" ] || fail "$options: $(field some.json outcome)"
  # shellcheck disable=SC2086
  "$program" deploy "$table1" $options | grep -q "^$words" || fail "$options: no '$words'"
done << 'END'
--latch|latched|latched flat
--swings 3|passed_flat|passes through flat
--friction 0.1|stalled|stalls at 36 deg
--damping 0.0003 --swings 1000|flat|comes to rest flat
--rest-deg 60 --from 90 --damping 0.01|at_rest|comes to rest at 
--rest-deg 60 --from 50|turned_back|turns round
--rest-deg 150 --from 20 --time-limit 10|fold_limit|folds up to 156.3
--time-limit 0.01|time_limit|still moves
END

# Panels that bend: less than rigid ones, whose numbers stay as they are; thicker, more. What programs
# that share no code found of Table 1: 0.1265 N mm at 36 deg (4 x 4 elements a panel), 1.1e-4 N mm/mm.
"$program" deploy "$table1" --panels bend --json > bent.json || fail "--panels bend"
json_test bent.json "abs(json_extract(j, '\$.bent.bent_energy_n_mm') / 0.1265 - 1) < 0.03" || fail "bent energy"
json_test bent.json "abs(json_extract(j, '\$.bent.bent_critical_friction_n_mm_per_mm') / 1.1e-4 - 1) < 0.05" ||
  fail "bent critical friction"
[ "$(field bent.json critical_friction_n_mm_per_mm)" = "$critical" ] || fail "--panels bend changes rigid numbers"
json_test bent.json "json_extract(j, '\$.bent.static_margin') IS NULL" || fail "a margin without friction"
echo '{ "e_gpa": 7e5 }' > rock.json
"$program" deploy "$table1" --material rock.json --friction 0.0001 --json > some.json || fail "--material"
json_test some.json "json_extract(j, '\$.bent.material.name') = 'rock' AND
  json_extract(j, '\$.bent.bent_critical_friction_n_mm_per_mm') / json_extract(j, '\$.critical_friction_n_mm_per_mm')
  BETWEEN 0.97 AND 1" || fail "panels like rock"
json_test some.json "json_extract(j, '\$.bent.static_margin') < 0 AND
  json_extract(j, '\$.bent.static_stall_deg') BETWEEN 1 AND 36" || fail "the static margin"
# A stop, and damping.
"$program" deploy "$table1" --stop 0.5 --json > stop.json || fail "--stop"
json_test stop.json "json_extract(j, '\$.outcome') = 'flat' AND json_extract(j, '\$.stop.bounces') > 3" || fail "a stop"
# Next to where it turns round no friction holds it.
"$program" deploy "$source_dir/results/deployment/wing.json" --stop 0.5 --json > stop.json || fail "--stop and friction"
[ "$(field stop.json outcome)" = flat ] || fail "a stop and friction: $(field stop.json outcome)"
"$program" deploy "$table1" --least-damping > words && least=$(sed -n 's/^least damping .*through: \([0-9.e-]*\) .*/\1/p' words) || fail "--least-damping"
"$program" deploy "$table1" --damping "$least" | grep -q "comes to rest flat" || fail "the least damping, $least"
"$program" deploy "$table1" --damping "$(sqlite3 :memory: "SELECT 0.98 * $least")" | grep -q "passes through flat" ||
  fail "less than the least damping passes flat"
# Next to a fold limit the way is off between its stations by what would stress panels.
sed 's/"amplitude_mm": 0.4/"amplitude_mm": 0.2/' "$source_dir/search/campaigns/miura-6x6.json" > fifth.json
"$program" search fifth.json --draws 1 --catalogue fifth.db > /dev/null 2>&1
"$program" deploy fifth.db 6853 --panels bend --from 170 --json > near.json || fail "panels bend next to a fold limit"
json_test near.json "json_extract(j, '\$.bent.bent_energy_n_mm') < json_extract(j, '\$.bent.angles[#-1].energy_n_mm')" ||
  fail "bent beyond rigid"
# Pins: words and JSON, alone and by the design.
"$program" deploy "$table1" --pin-friction 0.075 --json > pins.json || fail "--pin-friction"
json_test pins.json "abs(json_extract(j, '\$.pins.at_ends.critical_mm') / 0.047 - 1) < 0.25 AND
  json_extract(j, '\$.pins.at_ends.critical_mm') < json_extract(j, '\$.pins.in_middle.critical_mm') AND
  json_extract(j, '\$.pins.at_ends.stall_deg') = 36" || fail "pins"
sed 's/"holes"/"design": { "hinges": { "pin_friction_mm": 0.075 } }, "holes"/' "$table1" > pinned.json
"$program" deploy pinned.json --json | sed 's/"pattern": "pinned"/"pattern": "table1"/' | cmp -s - pins.json || fail "the design's pins"
"$program" deploy "$table1" --pin-friction 0 > words && [ "$(grep -c '^pins ' words)" = 2 ] || fail "pins in words"
"$program" deploy "$table1" | grep -q '^pins ' && fail "pins that nobody asked for"
"$program" deploy "$table1" --panels bend --thickness 4 --preload 3 > words || fail "--preload"
grep -q '^flat is unstable under the preload: [89] of 18 rigid-folding modes' words || fail "modes at flat"
grep -q '^preload: 3 N in each spring at flat' words || fail "the preload in words"
# Springs with their own: by their diagonals, in any order of vertices; the same force in each is that force of all.
"$program" actuators "$table1" --json > relaxed.json && "$program" actuators "$table1" --preload 3 --json > all.json || fail "actuators"
named=$(sqlite3 :memory: "SELECT json_group_object(value->>'to' || '-' || (value->>'from'), 3)
  FROM json_each(readfile('relaxed.json'), '\$.forces')")
with() { sed "s/\"holes\"/\"design\": { \"springs\": { $1 } }, \"holes\"/" "$table1" > own.json; }
with "\"preloads_n\": $named" && "$program" actuators own.json --json > named.json || fail "preloads by name"
[ "$(sqlite3 :memory: "SELECT json_extract(readfile('named.json'), '\$.forces') = json_extract(readfile('all.json'), '\$.forces')
  AND json_extract(readfile('all.json'), '\$.forces') <> json_extract(readfile('relaxed.json'), '\$.forces')")" = 1 ] ||
  fail "a preload of each, named"
with '"preload_n": 1, "preloads_n": { "A17-A11": 4 }' && "$program" deploy own.json --panels bend > words &&
  grep -q '^preload: up to 4 N in each spring at flat' words || fail "preloads in words"
with '"preloads_n": { "A9-A16": 4, "B1": 2, "A1-A2": -1 }' && "$program" actuators own.json > words 2> err
[ $? = 3 ] && [ "$(grep -c 'is no force of a spring' err)" = 2 ] || fail "bad preloads: $(cat err)"
with '"preloads_n": { "A9-A16": 4 }' && "$program" actuators own.json > words 2> err
[ $? = 3 ] && grep -q 'preloads_n.A9-A16 (is no diagonal of a hole' err || fail "no such diagonal: $(cat err)"
with '"preloads_n": { "A11-A17": 4, "A17-A11": 1 }' && "$program" actuators own.json > words 2> err
[ $? = 3 ] && [ "$(grep -c 'is named twice' err)" = 1 ] || fail "a spring named twice: $(cat err)"

# Of a draw: functions in SQL give what the verb gives, and choose.
"$program" deploy a.db "$draw" --json > drawn.json || fail "deploy of a draw"
"$program" query a.db --json "SELECT deploy_time_s(draw) AS t, critical_friction_n_mm_per_mm(draw, 36) AS f
  FROM candidates WHERE draw = $draw" > row.json || fail "functions"
for pair in t:deploy_time_s f:critical_friction_n_mm_per_mm; do
  [ "$(sqlite3 :memory: "SELECT json_extract(readfile('row.json'), '\$[0].${pair%:*}') =
    json_extract(readfile('drawn.json'), '\$.${pair#*:}')")" = 1 ] || fail "${pair#*:} in SQL"
done
"$program" export a.db --where "draw = $draw AND deploy_time_s(draw) < 60" --output out > exported ||
  fail "export --where"
for key in deploy_time_s critical_friction_n_mm_per_mm from_deg; do
  [ "$(field "$(cat exported)" deployment.$key)" = "$(field drawn.json $key)" ] || fail "$key in an export"
done
"$program" deploy "$(cat exported)" --json > again.json || fail "deploy of an export"
[ "$(field again.json deploy_time_s)" = "$(field drawn.json deploy_time_s)" ] || fail "other times"
[ "$("$program" query a.db --csv "SELECT deploy_time_s(draw, 500), deploy_time_s('x') FROM candidates
  LIMIT 1" | tail -1)" = "," ] || fail "functions of nothing"

# refused CODE WORDS ARGUMENT...
refused() {
  local code=$1 words=$2
  shift 2
  "$program" "$@" > out.txt 2> err
  [ $? = "$code" ] && [ ! -s out.txt ] && [ "$(wc -l < err)" = 1 ] && grep -q -- "$words" err ||
    fail "$*: $(cat err)"
}
echo '{ "e_gpa": -1 }' > wrong.json
refused 2 "reaches its fold limit at 156.34" deploy "$table1" --from 156.4
refused 2 "--rest-deg 160: table1 reaches" deploy "$table1" --rest-deg 160
refused 2 "is not a number from" deploy "$table1" --from 0
refused 2 "is not a number from" deploy "$table1" --friction -1
refused 2 "is no panel of this sheet" deploy "$table1" --hold 1,2
refused 2 "is no panel of this sheet" deploy "$table1" --hold nowhere
refused 2 "--hold" deploy "$table1" --gravity 0,0,-1
refused 2 "--gravity" deploy "$table1" --hold 0,0 --gravity 0,0
refused 2 "write it as A11-A17=60" deploy "$table1" --rest A11-A18=60
refused 2 "write it as A11-A17=60" deploy "$table1" --rest A11-A17
refused 2 "'still' is none of motion, held" deploy "$table1" --forces still
refused 2 "'soft' is none of rigid, bend" deploy "$table1" --panels soft
refused 2 "--preload 1: is what springs are left with at flat" deploy "$table1" --preload 1 --rest-deg 20
refused 2 "--preload 1: needs springs that push" deploy "$table1" --preload 1 --pull-only
refused 2 "--margin-to 40: margins are asked from the start, 36 deg" deploy "$table1" --panels bend --margin-to 40
refused 2 "is not a number from" deploy "$table1" --preload -1
refused 3 "e_gpa" deploy "$table1" --material wrong.json
refused 2 "no DRAW is given" deploy a.db
refused 2 "can only be chosen from a catalogue" deploy "$table1" 7
refused 3 "no such file" deploy nothing.json
finish
