# Reports that the program writes, in a browser. Called with a third argument: the directory of
# tests/report with its packages.
. "$(dirname "$0")/lib.sh"
web=$3
make() {  # NAME THRESHOLD DRAWS: a catalogue of the 4 x 4 sheet
  sed "s/\"deploys_from_deg\": 150/\"deploys_from_deg\": $2/; s/\"end_deg\": 180/\"end_deg\": $4/" \
    "$source_dir/search/campaigns/miura-4x4.json" > "$1.json"
  "$program" search "$1.json" --ranks 2 --draws "$3" --catalogue "$1.db" --progress none > /dev/null ||
    fail "search $1"
}
make none 180 40 180        # no candidate at all
make many 60 16000 90       # more than ten thousand
[ "$(sql none.db 'SELECT count(*) FROM candidate')" = 0 ] || fail "there are candidates in none.db"
[ "$(sql many.db 'SELECT count(*) FROM candidate')" -gt 10000 ] || fail "too few candidates in many.db"
# Its later rows stand for more draws than the first, as those of large numbers do.
sqlite3 many.db "UPDATE fault_sample SET stands_for = 4096 WHERE draw % 4096 = 0 AND draw > 0"
# Few of another family, seen from the side where its pilot is a mountain, with a stop, and a rejected draw.
stop='"stops_at_deg": 30, "stop_stiffness_mm2_per_rad2": 0.01'
sed "s|\.\./patterns|$source_dir/search/patterns|; s/\"deploys_from_deg\": [0-9]*/\"deploys_from_deg\": 60, $stop/" \
  "$source_dir/search/campaigns/turned-quads-6x6.json" > few.json
"$program" search few.json --draws 200 --catalogue few.db --progress none > /dev/null || fail "search few"
rejected=$(sql few.db 'WITH RECURSIVE n(d) AS (SELECT 0 UNION ALL SELECT d + 1 FROM n WHERE d < 199)
  SELECT d FROM n WHERE d NOT IN (SELECT draw FROM candidate) LIMIT 1')

# What the query `best` calls best.
best="$(sed -n 's/^ORDER BY //p' "$source_dir/schema/queries/best.sql"), draw"
order="ORDER BY $best"
# Of one candidate it is known how many miscut copies deploy.
"$program" tolerance few.db "$(sql few.db 'SELECT min(draw) FROM candidate')" --amplitude 0.05 --trials 20 \
  > /dev/null 2>&1 || fail "tolerance"
# Of another it is said what was certified: an angle that a page must not round up.
certified=$(sql few.db 'SELECT max(draw) FROM candidate')
sqlite3 few.db "INSERT INTO certificate VALUES ($certified, 59.998, 60, 'reversal', 'A9-A16', 1, 4, 0.1,
  '$(printf %032d 1)', x'00')"
# A fault that only campaigns with "between_samples" have: words and a colour for it too.
sqlite3 many.db "UPDATE fault_sample SET first_fault = 'bump_between_samples' WHERE draw =
  (SELECT min(draw) FROM fault_sample WHERE fault_deg IS NOT NULL)"

"$program" report few.db --draw "$rejected" --diverse 5 --where "stroke_max > 0.001" --stroke-limit 0.01 \
  --output few.html > names || fail "report"
[ "$(cat names)" = few.html ] || fail "report prints its file's name"
"$program" report none.db --output none.html > /dev/null || fail "report none"
"$program" report many.db --best 10 --output many.html > /dev/null || fail "report many"
data() {  # FILE.html JSON-PATH
  grep -o '^<script type="application/json" id="report-data">.*</script>' "$1" |
    sed 's/^[^>]*>//; s|</script>$||' > data.json
  field data.json "$2"
}
[ "$(data few.html 'details[0].draw')" = "$rejected" ] || fail "the draw asked for is not the first"
[ "$(data few.html candidates.columns.draw[0])" = "$(sql few.db "SELECT draw FROM candidates $order LIMIT 1")" ] ||
  fail "another first row than the program's best"
[ "$(data few.html certificates[0].draw) $(data few.html certificates[0].where)" = "$certified A9-A16" ] ||
  fail "what was certified is not on the page"
[ "$(data none.html certificates)" = "[]" ] || fail "certificates where there are no candidates"
[ "$(data few.html commands.springs)" = " --stroke-limit 0.01" ] || fail "springs of the page's commands"
[ "$(data none.html commands.springs)" = "" ] || fail "springs that nobody asked for"
[ "$(data few.html 'details[0].accepted')" = 0 ] || fail "a rejected draw is accepted"
[ "$(data many.html candidates.shown)" = 10000 ] || fail "candidates of many.db"
[ "$(data many.html candidates.total)" = "$(sql many.db 'SELECT count(*) FROM candidate')" ] ||
  fail "total of many.db"
grep -q "http" few.html && grep -oE "(src|href)=[\"']https?:[^\"']*" few.html && fail "the page asks for something elsewhere"

# Whose folding the page carries: those chosen as export chooses them, and not the table's first ones.
drawn() {  # FILE.html: the draws with details, in their order
  data "$1" details > details.json
  sqlite3 :memory: "SELECT json_extract(value, '\$.draw') FROM json_each(readfile('details.json'))"
}
chosen() {  # SQL of those expected, then options of report; few rows, which are not what this is about
  wanted=$(sql many.db "$1")
  shift
  "$program" report many.db "$@" --rows 700 --output chosen.html > /dev/null || fail "report $*"
  [ -n "$wanted" ] && [ "$(drawn chosen.html)" = "$wanted" ] || fail "report $*: $(drawn chosen.html | head -3)"
}
where="stroke_max < 0.02 AND 'it''s' > 'a'"
chosen "SELECT draw FROM candidates ORDER BY stroke_min DESC, $best LIMIT 3" \
  --best 3 --by stroke_min
[ "$(data chosen.html commands.choice)" = " --best 3 --by stroke_min --rows 700" ] || fail "the page's commands forget --best"
"$program" export many.db --diverse 4 --where "stroke_max < 0.02" --output spread > names || fail "export --diverse"
"$program" report many.db --diverse 4 --where "stroke_max < 0.02" --rows 700 --output chosen.html > /dev/null || fail "report --diverse"
[ "$(drawn chosen.html)" = "$(sed 's/.*-\([0-9]*\)\.json$/\1/' names)" ] || fail "report --diverse is another spread than export's"
# What a filter leaves, far down in the order, can have its folding too.
late=$(sql many.db "SELECT draw FROM candidates $order LIMIT 1 OFFSET 5000")
chosen "SELECT $late" --where "draw = $late"
chosen "SELECT draw FROM candidates WHERE $where $order LIMIT 5" --where "$where" --details 5
[ "$(data chosen.html candidates.shown)" = 700 ] || fail "report --rows 700"
# No folding at all, and no complaint that there is none of the kind.
"$program" report many.db --where "stroke_max < 0.02" --details 0 --rows 700 --deploy --contact --output chosen.html \
  > /dev/null || fail "--details 0"
[[ "$(data chosen.html commands.choice)" = *" --rows 700 --contact --deploy" ]] || fail "the page's commands forget studies"
[ -z "$(drawn chosen.html)" ] || fail "--details 0 carries foldings"
"$program" report many.db --details 5 --rows 700 --where "$where" --output chosen.html > /dev/null || fail "report again"
eval "set -- $(data chosen.html commands.choice)"  # as a shell takes them
[ "$1=$2" = "--where=$where" ] || fail "the page's condition is another one: $*"

refuse() {  # CODE SENTENCE OPTION...
  code=$1 sentence=$2
  shift 2
  "$program" report few.db "$@" --output refused.html > /dev/null 2> err
  [ $? = "$code" ] || fail "report $*: exit code"
  grep -q -- "$sentence" err || fail "report $*: $(cat err)"
  [ -e refused.html ] && fail "report $* leaves a file"
}
refuse 2 "is no condition" --where "strok < 1"
refuse 2 "did you mean deploys_from_deg?" --where "deploys_from > 145"
refuse 2 "no such candidate" --where "stroke_max < 0"
refuse 2 "no meaning without" --by stroke_min
refuse 2 "250001 rows would be a page that browsers hardly show (at most 250000" --rows 250001
refuse 2 "-1 is not a whole number" --rows=-1
refuse 2 "--by strok: is no column" --best 2 --by strok
refuse 2 "excludes" --best 2 --diverse 2
"$program" report none.db --best 3 --output none-best.html > /dev/null || fail "--best where there is none"

"$program" query many.db "SELECT first_fault, fault_deg, stands_for FROM fault_sample" --json > rows.json
node "$web/shares_test.mjs" "$source_dir/schema/report/shares.js" many.html rows.json || fail "shares by weight"

node "$web/arrivals_test.mjs" "$source_dir/schema/report/arrivals.js" || fail "what came in between two states of a sample"
node "$web/passage_test.mjs" many.html || fail "marks on the chart of first faults"

# A pattern file is one sheet: no campaign, nothing to choose.
"$program" report "$source_dir/search/patterns/table1.json" --stroke-limit 0.03 --output table1.html > names || fail "report table1"
[ "$(cat names)" = table1.html ] || fail "report of a pattern prints its file's name"
[ "$(data table1.html pattern.name)$(data table1.html campaign)" = table1 ] || fail "report of a pattern: whose it is"
[ "$(data table1.html 'details[0].verdict.deploys_from_deg')" = 156.0 ] || fail "report of a pattern: D"
[ "$(data few.html 'diagonals[3].diagonal')$(data table1.html 'diagonals[3].diagonal')" = 33 ] || fail "numbers of diagonals"
echo '{ "family": "miura", "rows": 4, "columns": 4 }' > plain.json
"$program" report plain.json --output plain.html > /dev/null || fail "report of an unshifted sheet"
for option in "--draw 5" "--best 3" "--rows 5" "--details 2" "--beside few.db"; do
  # shellcheck disable=SC2086
  "$program" report plain.json $option --output refused.html > /dev/null 2> err
  [ $? = 2 ] && grep -q -- "${option% *} can only be chosen from a catalogue" err || fail "report of a pattern with $option: $(cat err)"
  [ -e refused.html ] && fail "report of a pattern with $option leaves a file"
done
"$program" report plain.json --output plain.json > /dev/null 2> err
[ $? = 2 ] || fail "report over the pattern itself: $(cat err)"
"$program" report "$source_dir/search/patterns/table1.json" --from 120 --output used.html > /dev/null || fail "report from 120 deg"
node "$web/pattern_test.mjs" table1.html plain.html used.html || fail "the pages of patterns in a browser"

# One campaign beside another; which file is read, and which are refused.
"$program" report many.db --beside none.db --rows 700 --details 1 --output two.html > /dev/null || fail "report --beside"
[ "$(data two.html beside.catalogue) $(data two.html beside.campaign.identity)" = \
  "none.db $(data none.html campaign.identity)" ] || fail "another campaign beside"
[ "$(data two.html beside.state.draws) $(data two.html beside.faults)" = \
  "$(data none.html state.draws) $(data none.html faults)" ] || fail "other results beside"
[ "$(data two.html 'angles[0][1]')" = "$(sql many.db 'SELECT count(*) FROM candidates WHERE deploys_from_deg =
  (SELECT min(deploys_from_deg) FROM candidates)')" ] || fail "candidates by D: $(data two.html angles)"
[ "$(data two.html beside.angles)" = "[]" ] || fail "candidates beside where there are none"
[ "$(data two.html commands.choice)" = " --details 1 --rows 700 --beside none.db" ] || fail "the page's commands forget --beside"
[ -z "$(data many.html beside)$(data many.html angles)" ] || fail "a second campaign that nobody asked for"
sed 's/"seed": 1/"seed": 2/' many.json > again.json
"$program" search again.json --draws 16000 --catalogue again.db --progress none > /dev/null || fail "search again"
"$program" report many.db --beside again.db --rows 700 --details 1 --output again.html > /dev/null || fail "report beside again"
for page in two again; do
  node "$web/two_campaigns_test.mjs" $page.html || fail "two campaigns in a browser: $page"
done
refuse 3 "few.json: is no catalogue" --beside few.json
refuse 3 "there is no such file" --beside nowhere.db
"$program" report many.db --beside few.db --output few.db > /dev/null 2> err
[ $? = 2 ] && grep -q "is the input file" err || fail "report over the catalogue beside: $(cat err)"

"$program" report few.db --output nowhere/few.html > /dev/null 2> err
[ $? = 1 ] || fail "report into a directory that is not there"
grep -q "cannot be written" err || fail "the sentence: $(cat err)"
"$program" report few.json --output x.html > /dev/null 2> err
[ $? = 3 ] || fail "report of what is no catalogue"
[ -e x.html ] && fail "a refused report leaves a file"
# What was found of miscut copies of a draw that the table has no room for, but whose folding is there.
worst=$(sql few.db "SELECT draw FROM candidates $order" | tail -1)
"$program" tolerance few.db "$worst" --amplitude 0.05 --trials 20 > /dev/null 2>&1 || fail "tolerance of the worst"
"$program" report few.db --rows 3 --draw "$worst" --output worst.html > /dev/null || fail "report of the worst"
[ "$(data worst.html 'yields[0].draw')" = "$worst" ] || fail "the yield of a detailed draw is missing"
# Texts of a catalogue cannot end the page's data early.
cp few.db odd.db
sqlite3 odd.db "UPDATE fault_sample SET \"where\" = '</script><script>alert(1)</script>'"
"$program" report odd.db --output odd.html > /dev/null || fail "report odd"
grep -q 'alert(1)' odd.html || fail "the text of the catalogue is missing"
grep -q '</script><script>alert' odd.html && fail "a text of the catalogue becomes a program"

# Splitting searches: enough populations for an interval; so few that there is none; with none that came to the last
# level, without and with a candidate among the first draws, or to any level; one without populations, and one whose
# level finder has not finished.
split() {  # NAME THRESHOLD SEARCH OPTION...
  printf '{"name": "%s", "pattern": {"family": "miura", "rows": 4, "columns": 4},
    "accept": {"deploys_from_deg": %s}, "search": {"method": "splitting", %s}}\n' "$1" "$2" "$3" > "$1.json"
  name=$1
  shift 3
  "$program" search "$name.json" --catalogue "$name.db" --progress none "$@" > /dev/null 2>&1 || fail "search $name"
}
split ladder 175 '"particles": 70, "sweeps": 3, "first_draws": 700' --populations 24
split three 170 '"levels_deg": [150, 165.5], "particles": 20, "sweeps": 2, "first_draws": 300' --populations 3
split never 180 '"levels_deg": [150, 180], "particles": 4, "sweeps": 1, "first_draws": 5' --populations 21 --seed 2
split lucky 180 '"levels_deg": [150, 180], "particles": 4, "sweeps": 1, "first_draws": 40' --populations 21
[ "$(sql never.db 'SELECT count(*) FROM candidate')" = 0 ] || fail "there are candidates in never.db"
[ "$(sql lucky.db 'SELECT count(*) FROM candidate')" = 1 ] || fail "not one candidate in lucky.db"
split steep 180 '"levels_deg": [178], "particles": 2, "sweeps": 1, "first_draws": 2' --populations 21 --seed 2
split begun 175 '"levels_deg": [165], "particles": 1000, "sweeps": 20, "first_draws": 10000000' --populations 2 --max-time 0.1
[ "$(sql begun.db 'SELECT count(*) FROM unit')" = 0 ] || fail "begun.db has a population"
split waits 175 '"particles": 1000, "sweeps": 20, "first_draws": 10000000' --populations 2 --max-time 0.2
[ "$(sql waits.db 'SELECT count(*) FROM level')" = 0 ] || fail "waits.db knows its levels"
# One more population than is wanted now, and a search without end.
cp three.db less.db
"$program" search three.json --catalogue less.db --populations 2 --progress none > /dev/null 2>&1 || fail "search less"
sed 's/"sweeps": 2, "first_draws": 300}/&, "stop": {"populations": null}/' three.json > endless.json
"$program" search endless.json --catalogue endless.db --max-time 0.3 --progress none > /dev/null 2>&1 || fail "search endless"
for name in ladder three never lucky steep begun waits less endless; do
  "$program" report $name.db --output $name.html > /dev/null || fail "report $name"
  "$program" status $name.db > $name-status.txt 2> /dev/null || fail "status $name"
  "$program" query $name.db acceptance --json > $name-levels.json || fail "query $name acceptance"
done
refuse 2 "ladder.db: a splitting search has no fault sample to compare; leave out --beside" --beside ladder.db
"$program" report ladder.db --beside few.db --output refused.html > /dev/null 2> err
[ $? = 2 ] && grep -q "ladder.db: a splitting search" err || fail "report of a splitting search beside another: $(cat err)"
node "$web/ladder_test.mjs" ladder three never lucky steep begun waits less endless || fail "the pages of splitting searches in a browser"

# Draws that were made better.
sed 's/"seed": 1/"seed": 1, "search": { "method": "optimise", "from_deg": 36 }/' "$source_dir/search/campaigns/miura-4x4.json" > driven.json
"$program" search driven.json --draws 30 --catalogue driven.db --progress none > /dev/null || fail "search driven"
"$program" report driven.db --details 3 --output driven.html > /dev/null || fail "report driven"
[ "$(data driven.html 'details[0].ascent.end_value')" = \
  "$(sql driven.db "SELECT end_value FROM ascent WHERE draw = $(data driven.html 'details[0].draw')")" ] || fail "another worth"

# Draws that their energy alone drives.
sed 's/"deploys_from_deg": [0-9]*/"by": "energy", &/' "$source_dir/search/campaigns/miura-4x4.json" > energy.json
"$program" search energy.json --draws 200 --catalogue energy.db --progress none > /dev/null || fail "search energy"
"$program" report energy.db --details 1 --output energy.html > /dev/null || fail "report energy"
node "$web/energy_test.mjs" energy.html || fail "the page of a campaign by energy in a browser"
# Questions of a reader, answered in two clicks.
"$program" report many.db --best 6 --by miscut_margin_mm --output questions.html > /dev/null || fail "report questions"
"$program" report few.db --column critical_friction_n_mm_per_mm --details 1 --output friction.html > /dev/null || fail "report friction"
"$program" report "$source_dir/search/patterns/table1.json" --stress "$source_dir/tests/fixtures/table1-stress.json" \
  --output stressed.html > /dev/null || fail "report stressed"
node "$web/questions_test.mjs" questions.html friction.html stressed.html || fail "a reader's questions in a browser"
node "$web/page_test.mjs" few.html none.html many.html ladder.html driven.html --odd odd.html ||
  fail "the pages in a browser"
finish
