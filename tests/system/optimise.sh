# A better sheet: worth what other verbs say of the file, within what was asked, proven; and what is refused.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json
"$program" search "$source_dir/search/campaigns/miura-6x6.json" --draws 10000 --catalogue six.db > /dev/null 2>&1 || fail "search"
draw=$(sql six.db 'SELECT min(draw) FROM candidates')
for kind in --ternary ''; do
  # shellcheck disable=SC2086
  "$program" optimise six.db "$draw" $kind --json --output better.json > said.json 2> err || fail "optimise $kind: $(cat err)"
  "$program" deploy better.json --json > let_go.json || fail "deploy"
  "$program" fold better.json --json > folded.json || fail "fold"
  json_test said.json "abs(json_extract(j, '\$.after_n_mm_per_mm') / $(field let_go.json critical_friction_n_mm_per_mm) - 1) < 1e-9
    AND json_extract(j, '\$.after_n_mm_per_mm') > 4 * json_extract(j, '\$.before_n_mm_per_mm')
    AND json_extract(j, '\$.certified_deg') >= 170" || fail "worth $kind"
  [ "$(field folded.json verdict.deploys_from_deg | cut -d. -f1)" -ge 170 ] || fail "D $kind"
  [ "$(sqlite3 :memory: "SELECT max(abs(xy.value)) <= 0.4 FROM json_each(readfile('better.json'), '\$.pattern.displacements_mm') v, json_each(v.value) xy")" = 1 ] ||
    fail "amplitude $kind"
done
"$program" optimise six.db "$draw" --json > again.json && cmp -s said.json again.json || fail "not the same sheet again"
cp said.json free.json
# From an exported pattern as from its draw.
"$program" export six.db --draw "$draw" --output out > exported && "$program" optimise "$(cat exported)" --ternary --amplitude 0.4 --deploys-from 170 --json > of_file.json &&
  "$program" optimise six.db "$draw" --ternary --json > of_draw.json || fail "of an export"
[ "$(field of_file.json after_n_mm_per_mm)" = "$(field of_draw.json after_n_mm_per_mm)" ] || fail "an export ends elsewhere"
"$program" optimise "$table1" --deploys-from 150 --stroke-limit 0.1 > words || fail "words"
grep -q '^table1: critical friction, panels rigid from 36 deg' words && grep -q 'proven up to 150' words || fail "words: $(cat words)"
"$program" optimise "$table1" --deploys-from 150 --least-slope 0.01 --steps 1 > words || fail "a start below the least slope"
grep -q '^least slope 0.000[0-9]* mm/deg, below the requested 0.01$' words || fail "a start below the least slope: $(cat words)"
"$program" optimise "$table1" --deploys-from 150 --goal static_friction_n_mm_per_mm --thickness 2 --preload 0.1 --ternary --json > bent.json ||
  fail "panels that bend"
json_test bent.json "json_extract(j, '\$.after_n_mm_per_mm') > 2 * json_extract(j, '\$.before_n_mm_per_mm')" || fail "static friction"

# The margin against miscuts, as catalogues have it: against a million draws' best, 0.119 mm.
"$program" optimise six.db "$draw" --goal miscut_margin_mm --json > margin.json || fail "margin"
json_test margin.json "json_extract(j, '\$.after_mm') > 5 * json_extract(j, '\$.before_mm') AND json_extract(j, '\$.certified_deg') >= 170" ||
  fail "margin against miscuts"
[ "$(sql six.db "SELECT abs(miscut_margin_mm / $(field margin.json before_mm) - 1) < 1e-6 FROM candidates WHERE draw = $draw")" = 1 ] || fail "another margin than the catalogue's"
# On a cutter's grid.
"$program" optimise six.db "$draw" --grid 0.05 --json --output gridded.json > said.json || fail "on a grid"
[ "$(sqlite3 :memory: "SELECT max(abs(xy.value / 0.05 - round(xy.value / 0.05))) < 1e-9 FROM json_each(readfile('gridded.json'), '\$.pattern.displacements_mm') v, json_each(v.value) xy")" = 1 ] ||
  fail "off the grid"
# Within the parallel family up to 179 degrees, against the constructed sheet that it starts from.
echo '{ "family": "miura", "rows": 8, "columns": 8 }' > base.json
"$program" construct base.json --rim --amplitude 0.4 --output made.json > words && "$program" optimise made.json --within-family --deploys-from 179 --from 36 --json --output driven.json > said.json || fail "within the family"
json_test said.json "json_extract(j, '\$.after_n_mm_per_mm') > 1.1 * json_extract(j, '\$.before_n_mm_per_mm') AND json_extract(j, '\$.certified_deg') >= 179" ||
  fail "a constructed sheet gains nothing"
"$program" certify driven.json --to 179.5 > words && grep -q '179.5' words || fail "proven within the family: $(cat words)"
# The C library's functions for other processors give other last bits, and the same sheets.
export GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4
"$program" optimise six.db "$draw" --goal miscut_margin_mm --json > again.json && cmp -s margin.json again.json || fail "another sheet with other functions of the C library"
"$program" optimise six.db "$draw" --json > again.json && cmp -s free.json again.json || fail "another sheet by friction with other functions of the C library"
unset GLIBC_TUNABLES

# What the design asks, of both sheets as their own cards have it.
"$program" optimise "$table1" --deploys-from 150 --ternary --thickness 1 --card --json --output carded.json > cards.json || fail "--card"
"$program" card "$table1" --thickness 1 --json > one.json
[ $? = 6 ] || fail "card of the start"
"$program" card carded.json --json > other.json
[ $? = 6 ] || fail "card of the optimum"
json_test cards.json "json_extract(j, '\$.card_before.lines') = (SELECT json_extract(readfile('one.json'), '\$.lines'))
  AND json_extract(j, '\$.card_after.lines') = (SELECT json_extract(readfile('other.json'), '\$.lines'))" || fail "cards differ"
"$program" optimise "$table1" --deploys-from 150 --ternary --thickness 1 --card > words && grep -q 'required  *before  *after' words &&
  grep -q '^after: fails 2 of 7 requirements' words || fail "cards in words: $(cat words)"
# Another goal that is not to fall, and what it costs.
"$program" optimise six.db "$draw" --subject-to "miscut_margin_mm >= 0.02" --subject-to "stroke_max <= 0.12" --json > floored.json || fail "--subject-to"
json_test floored.json "json_extract(j, '\$.after_n_mm_per_mm') > 2 * json_extract(j, '\$.before_n_mm_per_mm') AND json_extract(j, '\$.stroke') <= 0.12
  AND json_extract(j, '\$.subject_to[1]') = 'miscut_margin_mm >= 0.02'" || fail "--subject-to: $(head -c 400 floored.json)"

# Other goals, before and after, as the verbs whose they are say of the files.
better() {  # GOAL KEY OPTION...
  local goal=$1 key=$2
  shift 2
  "$program" optimise "$table1" --deploys-from 150 --goal "$goal" "$@" --json --output more.json > said.json || fail "--goal $goal"
  before=$(field said.json "before_$key") after=$(field said.json "after_$key")
  sqlite3 :memory: "SELECT $after > $before AND json_extract(readfile('said.json'), '\$.certified_deg') >= 150" | grep -q 1 || fail "--goal $goal: $before, $after"
}
is_near() { sqlite3 :memory: "SELECT abs($1 - ($2)) <= ${3:-1e-9} * abs($1)" | grep -q 1 || fail "$4: $1, $2"; }
better energy_n_mm n_mm
"$program" actuators more.json --from 36 --json > other.json && is_near "$after" "$(field other.json energy_n_mm)" 1e-9 energy
better thickness_mm mm --from 36 --steps 2
"$program" contact more.json --from 36 --json > other.json && is_near "$after" "$(field other.json thickness.largest_mm)" 1e-9 thickness
better yield share --steps 1 --miscut 0.05 --trials 100
"$program" tolerance "$table1" --amplitude 0.05 --trials 100 --from 150 --json > other.json && is_near "$before" "$(field other.json from_threshold.share)" 1e-9 yield
better spare_diagonals diagonals --from 36
"$program" actuators more.json --from 36 --json > other.json
is_near "16 - json_array_length(readfile('other.json'), '\$.few.diagonals')" "CAST($after AS INTEGER)" 1e-9 "spare diagonals"
better rest_stiffness_n_mm_per_rad n_mm_per_rad --preload 0.05 --preload-within 0,0.2
is_near "$(field more.json design.springs.preload_n)" "$(field said.json preload_n.chosen)" 1e-12 preload
better deploys_from_deg deg --steps 50
"$program" fold more.json --json > folded.json && [ "$(field folded.json verdict.deploys_from_deg | cut -d. -f1)" -ge 160 ] &&
  [ "$(field said.json certified_deg | cut -d. -f1)" -ge 160 ] || fail "deploys from $(field folded.json verdict.deploys_from_deg) only"
better critical_friction_n_mm_per_mm n_mm_per_mm --subject-to "largest_force_n <= 20" --stiffness-within 10,200
"$program" deploy more.json --json > let_go.json && is_near "$after" "$(field let_go.json critical_friction_n_mm_per_mm)" 1e-9 "springs that are chosen"

refused() {  # CODE WORDS OPTION...
  local code=$1 words=$2 got=0
  shift 2
  "$program" optimise "$@" > out.txt 2> err || got=$?
  [ "$got" = "$code" ] && [ ! -s out.txt ] && grep -q -- "$words" err || fail "$*: $got, $(cat err)"
  [ ! -e none.json ] || fail "$*: something was written"
}
refused 2 "--amplitude 0.3: the sheet that it starts from has a shift of" "$table1" --amplitude 0.3 --output none.json
refused 2 "take these out" "$table1" --goal chosen_friction_n_mm_per_mm --rest-deg 30 --output none.json
refused 2 "take these out" "$table1" --goal chosen_friction_n_mm_per_mm --preload 1 --output none.json
"$program" optimise "$table1" --goal chosen_friction_n_mm_per_mm --steps 2 --output chosen.json > out.txt 2> err || fail "chosen springs: $(cat err)"
"$program" actuators chosen.json --json > chosen_springs.json || fail "actuators of chosen springs"
grep -q '"free_mm"' chosen_springs.json || fail "the optimum's springs have no lengths of their own"
refused 2 "--stiffness-within 60,100: the springs that it starts from have 50" "$table1" --stiffness-within 60,100 --output none.json
refused 2 "--preload-within 3,1: the least is not below the most" "$table1" --preload-within 3,1 --output none.json
refused 2 "--stiffness-within 0,100: springs may have 1e-06 to" "$table1" --stiffness-within 0,100 --output none.json
refused 2 "--goal: the sheet that it starts from is not stiff where its springs rest" "$table1" --goal rest_stiffness_n_mm_per_rad --output none.json
refused 2 "and ternary shifts are 0 or the amplitude" "$table1" --amplitude 0.5 --ternary
refused 2 "--deploys-from 179: the sheet that it starts from deploys from 156 deg" "$table1" --deploys-from 179
refused 2 "--stroke-limit 0.001: a diagonal of the sheet that it starts from elongates by more" "$table1" --stroke-limit 0.001
refused 2 "--subject-to stroke_max <= 0.001: a diagonal of the sheet that it starts from elongates by more" "$table1" --subject-to "stroke_max <= 0.001"
sed 's|"holes"|"design": { "springs": { "stroke_limit": 0.001, "largest_force_n": 1000 } }, "holes"|' "$table1" > limited.json
refused 2 "^misalign: design.springs.stroke_limit = 0.001: a diagonal of the sheet" limited.json
refused 2 "^misalign: design.springs.largest_force_n = 0.01: a spring of the sheet" <(sed 's/: 1000 }/: 0.01 }/' limited.json)
refused 2 "static_friction_n_mm_per_mm" "$table1" --goal static_friction
refused 2 "nothing drives the sheet that it starts from to flat" "$table1" --goal static_friction_n_mm_per_mm --preload 5
refused 2 "--within-family: the sheet that it starts from is no member" "$table1" --within-family
refused 2 "--subject-to stroke >= 1: stroke is no number that can be limited (did you mean" "$table1" --subject-to "stroke >= 1"
refused 2 "--subject-to miscut_margin_mm >= 1: the sheet that it starts from has" "$table1" --deploys-from 150 --goal critical_friction_n_mm_per_mm --subject-to "miscut_margin_mm >= 1"
refused 3 "nowhere.json" nowhere.json
refused 3 "table1: has no \"target\"" "$table1" --goal shape_rms_mm
refused 3 "table1: has no \"target\"" "$table1" --subject-to "shape_max_mm <= 0.5"
refused 2 "shape_max_mm needs an upper bound" "$table1" --subject-to "shape_max_mm >= 0.5"
refused 2 "has no target, of which goals of a shape need one" six.db "$draw" --goal shape_max_mm
# A shaped sheet keeps its target, in its best pose, and its file.
sed 's/"columns": 6/"columns": 4/; s/"rows": 6/"rows": 4/; s/1440/960/' "$source_dir/search/patterns/dome-6x6.json" > plain_dome.json
"$program" shape plain_dome.json --output dome.json > words || fail "a dome: $(cat words)"
"$program" optimise dome.json --rim --from 100 --deploys-from 100 --goal rest_stiffness_n_mm_per_rad --subject-to "shape_max_mm <= 0.5" --steps 3 --json --output stiffer.json > said.json ||
  fail "a stiffer dome"
json_test said.json "json_extract(j, '\$.after_n_mm_per_rad') > 1.1 * json_extract(j, '\$.before_n_mm_per_rad')
  AND json_extract(j, '\$.subject_to[0]') = 'shape_max_mm <= 0.5'" || fail "a stiffer dome: $(head -c 300 said.json)"
"$program" optimise stiffer.json --goal shape_max_mm --rim --steps 2 --json > said.json || fail "a dome that is better"
json_test said.json "json_extract(j, '\$.before_mm') <= 0.5 AND json_extract(j, '\$.after_mm') < json_extract(j, '\$.before_mm')" ||
  fail "a dome that is better: $(head -c 300 said.json)"
refused 2 "--subject-to shape_max_mm <= 1e-05: the sheet that it starts from has" stiffer.json --subject-to "shape_max_mm <= 0.00001"
sed -E 's/"at_deg": 90(\.0)?/"at_deg": 120/' dome.json > beyond.json
refused 2 "does not fold to the target's angle" beyond.json --goal shape_max_mm
tr '\n' ' ' < "$table1" | sed 's/"displacements_mm": {[^}]*}/"displacements_mm": {}/' > plain.json
refused 2 "--amplitude 0: leaves no room" plain.json --from 10
refused 2 "the sheet that it starts from deploys from 0 deg" plain.json --amplitude 0.4 --from 10
# The free shifts of a sheet that is hardly shifted, whose programs are large: none passes the amplitude.
echo '{ "family": "miura", "rows": 6, "columns": 6, "displacements_mm": { "A17": [0.4, 0], "A18": [0.4, 0] }, "holes": "checkerboard-even" }' > one.json
"$program" optimise one.json --from 10 --output near.json > words || fail "a sheet that is hardly shifted"
[ "$(sqlite3 :memory: "SELECT max(abs(xy.value)) <= 0.4 FROM json_each(readfile('near.json'), '\$.pattern.displacements_mm') v, json_each(v.value) xy")" = 1 ] ||
  fail "shifts beyond the amplitude: $(cat words)"
grep -q '"between_samples"' near.json || fail "the sampling is not with it"
# What the card of the start meets, that of the optimum meets, too: with springs on one diagonal of each hole.
sed 's|"holes"|"design": { "from_deg": 120, "thickness_mm": 1, "hold_flat": true, "material": { "name": "soft", "e_gpa": 3, "strength_mpa": 9 }, "springs": { "on": "one_a_hole", "stiffness_n_per_mm": 10, "preload_n": 0.1 } }, "holes"|' "$table1" > soft.json
met() { "$program" card "$1" --trials 50 --no-remedies --json | python3 -c '
import json, sys
print(" ".join(sorted(line["key"] for line in json.load(sys.stdin)["lines"] if line["passes"])))'; }
"$program" optimise soft.json --goal energy_n_mm --amplitude 2 --steps 6 --output free.json > words || fail "free: $(cat words)"
"$program" optimise soft.json --goal energy_n_mm --amplitude 2 --steps 6 --keep-card --trials 50 --output kept.json > words || fail "kept: $(cat words)"
met soft.json > before
grep -q largest_stress_mpa before || fail "the start breaks: $(cat before)"
for key in $(cat before); do met kept.json | grep -qw "$key" || fail "the optimum breaks $key"; done
"$program" optimise free.json --goal largest_stress_mpa --amplitude 2 --steps 3 --json > said.json || fail "less stress"
json_test said.json "json_extract(j, '\$.after_mpa') < 0.9 * json_extract(j, '\$.before_mpa')" || fail "less stress: $(head -c 300 said.json)"
finish
