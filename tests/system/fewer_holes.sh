# Sheets with fewer holes than count to one degree of freedom: made, folded, proven and written as all others are; off
# their family they are turned away.
. "$(dirname "$0")/lib.sh"
base() { echo "{ \"family\": \"$1\", \"rows\": 6, \"columns\": 6, \"holes\": $2 }"; }
for holes in '[[2, 3]]' '[[1, 1], [4, 4]]' '[[1, 2], [2, 1], [3, 4], [4, 3]]'; do
  base miura "$holes" > base.json
  "$program" construct base.json --rim --amplitude 4 --output made.json > out 2>&1 || fail "construct $holes: $(cat out)"
  "$program" fold made.json --json > folding.json 2> err || fail "fold $holes: $(cat err)"
  [ "$(field folding.json verdict.deploys_from_deg)" = 180.0 ] || fail "$holes deploy from $(field folding.json verdict)"
  [ "$(field folding.json degrees_of_freedom)" = 1 ] || fail "$holes: degrees of freedom"
  "$program" certify made.json --to 180 --json > proven.json 2> err || fail "certify $holes: $(cat err)"
  [ "$(field proven.json member_proof.certified_deg)" = 180.0 ] || fail "$holes: proven to $(field proven.json member_proof)"
  "$program" fold proven.json > out 2>&1 || fail "a proven sheet: $(cat out)"
  "$program" verify made.json > out 2>&1 || fail "verify $holes: $(cat out)"
  "$program" deploy made.json --from 60 > out 2>&1 || fail "deploy $holes: $(cat out)"
  "$program" contact made.json > out 2>&1 || fail "contact $holes: $(cat out)"
  "$program" actuators made.json > out 2>&1 || fail "actuators $holes: $(cat out)"
  for format in json fold csv mat svg dxf obj mjcf; do
    "$program" export made.json --format $format --output $format > out 2>&1 || fail "$format of $holes: $(cat out)"
  done
  for again in json/made.json fold/made.fold; do
    "$program" fold $again --json > again.json 2> err || fail "$again: $(cat err)"
    [ "$(field again.json verdict)" = "$(field folding.json verdict)" ] || fail "$again: another verdict"
  done
done
"$program" report made.json --output page.html > out 2>&1 || fail "report: $(cat out)"

# A vertex of a hole a hundredth of a millimetre off; a base without the family; too few holes for other verbs.
sqlite3 :memory: "SELECT json_set(readfile('made.json'), '\$.displacements_mm.A17', json('[0.5, 0.01]'))" > off.json
"$program" fold off.json > out 2> err
[ $? = 3 ] && grep -q "the shifts take A.* off by" err || fail "off the family: $(cat err)"
sed "s|\"family\": \"miura\", \"rows\": 6, \"columns\": 6|\"family\": \"fold\", \"file\": \
\"$source_dir/search/patterns/turned-quads-6x6.fold\"|" base.json > none.json
"$program" fold none.json > out 2> err
[ $? = 3 ] && grep -q "nor has the base a parallel family: the hole" err || fail "no family: $(cat err)"
"$program" certify made.json --contact > out 2> err
[ $? = 2 ] && grep -q "has no --contact" err || fail "certify --contact: $(cat err)"

# With all holes, to 180 degrees; off the family there is no closed form.
"$program" construct "$source_dir/search/patterns/table1.json" --amplitude 4 --output whole.json > out || fail "construct"
"$program" certify whole.json --closed-form --to 180 > out 2>&1 && grep -q "proven from flat to 180 deg" out ||
  fail "--closed-form: $(cat out)"
# Without one it is followed up to the sample before 180 degrees, where all its creases close at once.
for made in "table1 0.4 --rim" "table1 2" "miura-wide-6x6 2 --rim" "miura-graded-6x6 2" "double-corrugation-6x6 5"; do
  read -r pattern amplitude rim <<< "$made"
  # shellcheck disable=SC2086
  "$program" construct "$source_dir/search/patterns/$pattern.json" --amplitude "$amplitude" $rim --output all.json > out || fail "construct $made"
  "$program" verify all.json --json > verified.json 2> err || fail "verify $made: $(cat verified.json err)"
  [ "$(field verified.json verdict.deploys_from_deg) $(field verified.json verdict.first_fault)" = "179.0 none" ] ||
    fail "$made: $(field verified.json verdict)"
  "$program" fold all.json --to 180 > out && [ "$(head -1 out)" = "deploys from 179 deg; first fault: none" ] &&
    grep -q "^judged up to the sample before 180 deg" out || fail "fold $made: $(head -3 out)"
done
"$program" certify "$source_dir/search/patterns/table1.json" --closed-form > out 2> err
[ $? = 3 ] && grep -q "so that there is no closed form" err || fail "--closed-form of a drawn sheet: $(cat err)"

# What a miscut leaves open.
"$program" tolerance made.json --amplitude 0.05 --trials 50 --json > gaps.json || fail "tolerance"
[ "$(sqlite3 :memory: "SELECT count(*) FROM json_each(readfile('gaps.json'), '\$.open')
  WHERE value ->> 'median_mm' BETWEEN 1e-5 AND 0.2")" = 18 ] || fail "gaps: $(cat gaps.json)"
"$program" tolerance made.json --backlash 0.01 > out 2> err
[ $? = 2 ] && grep -q "has no meaning" err || fail "--backlash: $(cat err)"

# Campaigns: one digest however they are run, shifts on a grid, verdicts that fold and verify find too.
echo '{ "name": "few", "pattern": { "family": "miura", "rows": 6, "columns": 6, "holes": [[1, 2], [3, 4], [4, 1]] },
  "misalignment": { "kind": "parallel", "vertices": "all", "amplitude_mm": 4, "signs": "free", "grid_mm": 0.25 },
  "accept": { "deploys_from_deg": 180 } }' > few.json
"$program" search few.json --catalogue few.db --draws 400 > out 2>&1 || fail "search: $(cat out)"
found=$(sql few.db 'SELECT count(*) FROM candidate')
[ "$found" -gt 20 ] && [ "$found" -lt 380 ] || fail "$found of 400 sheets of free signs deploy"
"${ranks[@]}" 2 "$program" search few.json --catalogue two.db --draws 400 --unit-draws 37 > out 2>&1 || fail "2 ranks"
[ "$(digest_of two.db)" = "$(digest_of few.db)" ] || fail "2 ranks: another digest"
"$program" verify few.db --all > out 2>&1 || fail "verify: $(cat out)"
[ "$(sql few.db "SELECT count(*) FROM candidate, json_each(displacements_mm) AS v, json_each(v.value) AS x
  WHERE x.value * 4 <> round(x.value * 4)")" = 0 ] || fail "shifts off the grid"
draw=$(sql few.db 'SELECT min(draw) FROM candidate')
"$program" certify few.db "$draw" > out 2>&1 && grep -q "^draw $draw: proven from flat to 180" out || fail "certify: $(cat out)"
"$program" certify few.db --best 3 --json > list.json && [ "$(sqlite3 :memory: "SELECT json_array_length(readfile('list.json'))")" = 3 ] ||
  fail "certify --best"
"$program" certify few.db --check > out 2> err
[ $? = 2 ] && grep -q "has no --check" err || fail "certify --check: $(cat err)"
"$program" tolerance few.db "$draw" --amplitude 0.05 --trials 20 > out 2>&1 || fail "tolerance: $(cat out)"
"$program" tolerance few.db --best 2 --amplitude 0.05 > out 2> err
[ $? = 2 ] && grep -q "name one draw" err || fail "tolerance of two: $(cat err)"
"$program" replay few.db "$draw" > out 2>&1 && grep -q "^draw $draw of few: accepted" out || fail "replay: $(cat out)"
"$program" export few.db --best 1 --output few > names || fail "export"
"$program" fold "$(cat names)" --json > folding.json || fail "fold"
[ "$(field folding.json verdict.deploys_from_deg)" = 180.0 ] || fail "another verdict"
"$program" query few.db "SELECT deploy_time_s(draw) FROM candidates LIMIT 1" > out 2>&1 || fail "deploy_time_s: $(cat out)"
for wrong in 's/"kind": "parallel", /"levels": "uniform", /; s/"signs": "free", "grid_mm": 0.25/"kind": "free"/' \
  's/"grid_mm": 0.25/"grid_mm": 5/' 's/"rows": 6,/"rows": 6, "zigzag_offset_mm": 37,/' 's/ } }$/ }, "certify": true }/'; do
  sed "$wrong" few.json > wrong.json
  "$program" config --check wrong.json > out 2> err
  [ $? = 3 ] || fail "$wrong: $(cat out err)"
done

# Which sets there are: of 16 inner panels all single ones, and 96 pairs that share no edge.
"$program" perforations base.json --holes 1 > out || fail "perforations"
grep -q "^16 of 16 sets of 1 leave one degree of freedom" out || fail "single holes: $(tail -1 out)"
"$program" perforations base.json --holes 2 --json > sets.json || fail "pairs"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('sets.json'), '\$.perforations')")" = 96 ] || fail "pairs"
finish
