# What a report says of stresses and contacts. Called as report.sh is.
. "$(dirname "$0")/lib.sh"
web=$3
table1=$source_dir/search/patterns/table1.json
result=$source_dir/tests/fixtures/table1-stress.json
node "$web/scale_test.mjs" "$source_dir/schema/report" || fail "the scales of colours"
node "$web/bins_test.mjs" "$source_dir/schema/report" || fail "hexagons and densities"

# altered NAME SQL: the result with something else in it, j being what it is.
altered() { sqlite3 :memory: "SELECT $2 FROM (SELECT json(readfile('$result')) AS j)" > "$1"; }
refuse() {  # CODE SENTENCE WHAT OPTION...: one line, no page
  code=$1 sentence=$2
  shift 2
  "$program" report "$@" --output refused.html > out 2> err
  [ $? = "$code" ] || fail "report $*: exit code, $(cat err)"
  grep -q -- "$sentence" err && [ "$(wc -l < err)" = 1 ] && [ ! -s out ] || fail "report $*: $(cat err)"
  [ -e refused.html ] && fail "report $* leaves a page"
}

# What is no such file.
echo 'no JSON' > text.json
echo '[1, 2]' > list.json
altered bare.json "json_remove(j, '\$.panels')"
altered words.json "json_set(j, '\$.motion.time_s[1]', 'soon')"
altered short.json "json_remove(j, '\$.stress.time_s[0]')"
altered backward.json "json_set(j, '\$.motion.time_s[0]', 9)"
altered nobody.json "json_remove(j, '\$.pattern')"
altered unproved.json "json_remove(j, '\$.sheet')"
altered negative.json "json_set(j, '\$.panels[3].outside_discs_mpa', -1)"
altered nowhere.json "json_set(j, '\$.largest_outside_discs.panel', json('[1]'))"
refuse 3 "none.json" "$table1" --stress none.json
refuse 3 "is not JSON" "$table1" --stress text.json
while IFS='|' read -r name sentence; do
  refuse 3 "$name.json: is no result of .misalign stress.: $sentence" "$table1" --stress $name.json
done << 'END'
list|the document
bare|panels (is missing)
words|motion.time_s (must be a list of numbers)
short|stress (time_s must ascend, with a value
backward|motion (time_s must ascend
nobody|draw (is missing)
unproved|sheet (is missing)
negative|panels\[3\].outside_discs_mpa = -1
nowhere|largest_outside_discs.panel (must be
END
refuse 3 "is no result of .misalign stress.: draw (is missing)" "$table1" --stress "$table1"

# What is of another sheet.
sed "s|\.\./patterns|$source_dir/search/patterns|; s/\"deploys_from_deg\": [0-9]*/\"deploys_from_deg\": 60/" \
  "$source_dir/search/campaigns/turned-quads-6x6.json" > few.json
"$program" search few.json --draws 60 --catalogue few.db --progress none > /dev/null || fail "search few"
identity=$("$program" status few.db --json | sed -n 's/.*"identity": "\([0-9a-f]*\)".*/\1/p')
[ -n "$identity" ] || fail "the campaign's identity"
best=$("$program" query few.db best --json | sed -n 's/.*"draw": \([0-9]*\).*/\1/p' | head -2)
first=$(echo "$best" | head -1) second=$(echo "$best" | tail -1)
of_draw() { altered "$1" "json_set(json_remove(j, '\$.pattern', '\$.sheet'), '\$.draw', $2, '\$.campaign', '$3')"; }
of_draw first.json "$first" "$identity"
of_draw second.json "$second" "$identity"
of_draw stranger.json "$first" 0123456789abcdef
altered fewer.json "json_remove(j, '\$.panels[27]')"
altered twice.json "json_set(j, '\$.panels[27].panel', json('[0, 0]'))"
sqlite3 :memory: "SELECT json_set(json(readfile('$table1')), '\$.displacements_mm.A10[0]', 0.123)" > table1.json
refuse 3 "is a result for the pattern table1, but the report is on the sheet in table1.json" table1.json --stress "$result"
refuse 3 "is a result for draw $first of the campaign $identity, but the report is on the sheet in" "$table1" --stress first.json
refuse 3 "is a result for the pattern table1, but the report is on the campaign $identity" few.db --stress "$result"
refuse 3 "is a result for draw $first of the campaign 0123456789abcdef, but the report is" few.db --stress stranger.json
refuse 3 "is a result for draw $second, which has no details .*; add --draw $second" few.db --details 1 --stress second.json
refuse 3 "its panels are not those of its sheet" "$table1" --stress fewer.json
refuse 3 "its panels are not those of its sheet" "$table1" --stress twice.json
refuse 2 "like another --stress" few.db --stress first.json --stress first.json
refuse 2 "holds one sheet; give it once" "$table1" --stress "$result" --stress "$result"
cp first.json kept.json
"$program" report few.db --stress first.json --output first.json > /dev/null 2> err
[ $? = 2 ] && cmp -s first.json kept.json || fail "a result that is read would be replaced: $(cat err)"

# The sheet in a copy of the file under another name is the same sheet.
cp "$table1" copy.json
"$program" report copy.json --stress "$result" --contact --output table1.html > names || fail "report table1"
"$program" report few.db --stress second.json --stress first.json --details 2 --contact --output few.html > names ||
  fail "report few"
# Where panels meet next to D, whose words are on the slider.
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --range 213:214 --catalogue near.db --progress none \
  > /dev/null || fail "search near"
"$program" report near.db --draw 213 --contact --output near.html > names || fail "report near"
details() {  # FILE.html SQL of j, the first sheet's detail
  grep -o '^<script type="application/json" id="report-data">.*</script>' "$1" | sed 's/^[^>]*>//; s|</script>$||' > data.json
  sqlite3 :memory: "SELECT $2 FROM (SELECT json_extract(readfile('data.json'), '\$.details[0]') AS j)"
}
"$program" contact "$table1" --json > contact.json || fail "contact"
[ "$(details table1.html "j ->> '\$.contact.first_contact.pilot_deg'")" = "$(field contact.json first_contact.pilot_deg)" ] &&
  [ "$(details table1.html "j -> '\$.contact.first_contact.panels'")" = "$(field contact.json first_contact.panels)" ] ||
  fail "where panels meet is not what contact says"
[ "$(details table1.html "max(json_array_length(j, '\$.stress.panels_mpa'))")" = 28 ] || fail "stresses of the panels"
"$program" report few.db --details 2 --output plain.html > /dev/null || fail "report without"
[ "$(details plain.html "j -> 'contact' IS NULL AND j -> 'stress' IS NULL")" = 1 ] || fail "what nobody asked for"
# As a reader would do it: what stress writes of a draw is what report takes.
if command -v ccx > /dev/null; then
  "$program" stress near.db 213 --from 6 --time-step 4e-3 --time-limit 0.008 --output run > out || fail "stress"
  "$program" report near.db --draw 213 --details 0 --stress run/miura-4x4-213-stress.json --output run.html > names ||
    fail "report of what stress wrote"
  [ "$(details run.html "json_array_length(j, '\$.stress.panels_mpa')")" = 14 ] || fail "stresses of the panels of draw 213"
else
  echo "SKIPPED: ccx (calculix-ccx) is not installed"
fi
node "$web/stress_test.mjs" table1.html few.html near.html || fail "the pages in a browser"
finish
