# A pattern file wherever a draw is taken: a candidate's own exports say what the catalogue says of
# it, and what can only be chosen from a catalogue is one sentence.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json
mesh=$source_dir/search/patterns/angle-array-6x6.fold
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 300 --catalogue a.db \
  --progress none > /dev/null 2>&1 || fail "search"
draw=$(sql a.db 'SELECT draw FROM candidates ORDER BY deploys_from_deg DESC, slope_min_mm_per_deg DESC LIMIT 1')
for format in json fold; do
  "$program" export a.db --draw "$draw" --format $format --output of_draw > /dev/null || fail "export $format"
done
exported="of_draw/miura-4x4-$draw.json of_draw/miura-4x4-$draw.fold"

# The springs of a draw are those of its exports, but for whose they are.
"$program" actuators a.db "$draw" --json | sed '/"draw":/d' > of_draw.json
for file in $exported; do
  "$program" actuators "$file" --json > of_file.json || fail "actuators $file"
  [ "$(field of_file.json pattern)" = "miura-4x4-$draw" ] || fail "actuators $file: whose they are"
  sed '/"pattern":/d' of_file.json | cmp -s - of_draw.json || fail "actuators $file: other springs"
done
"$program" actuators "$table1" --stroke-limit 0.03 > text || fail "actuators table1"
[ "$(head -1 text)" = "table1: deploys from 156 deg" ] || fail "actuators table1: $(head -1 text)"
[ "$("$program" actuators - < /dev/null 2>&1 | wc -l)" = 1 ] || fail "actuators of nothing"
"$program" actuators <(cat "$table1") --stroke-limit 0.03 | tail -n +2 | cmp -s - <(tail -n +2 text) ||
  fail "actuators of a pipe"

# Every format of a pattern has its name; what is exported of an export is the same drawing.
for format in json csv fold svg stl obj; do
  case $format in stl) step="--step 60 --thickness 0.3" ;; fold | obj) step="--step 60" ;; *) step="" ;; esac
  # shellcheck disable=SC2086
  "$program" export "$table1" --format $format $step --output out > names || fail "export as $format"
  [ -s names ] && ! grep -v "^out/table1" names || fail "names of $format: $(cat names)"
done
[ "$(cat names | tr '\n' ' ')" = \
  "out/table1-000deg.obj out/table1-060deg.obj out/table1-120deg.obj out/table1-156deg.obj " ] ||
  fail "states of table1: $(cat names)"
[ "$(field out/table1.json verdict.deploys_from_deg)" = 156.0 ] || fail "export: D of table1"
[ -z "$(field out/table1.json draw)$(field out/table1.json campaign)" ] || fail "table1 is no draw"
for file in $exported; do
  for format in svg fold; do
    "$program" export "$file" --format $format --output again > /dev/null || fail "export $file as $format"
  done
  [ "$(field "again/miura-4x4-$draw.fold" file_frames)" = \
    "$(field "of_draw/miura-4x4-$draw.fold" file_frames)" ] || fail "$file: other frames"
done
"$program" export "$mesh" --format fold --output out > /dev/null || fail "export of a mesh"
"$program" fold out/angle-array-6x6.fold > /dev/null || fail "fold of an exported mesh"
# A sheet that deploys from nothing is folded as far as it goes.
echo '{ "family": "miura", "rows": 4, "columns": 4 }' > plain.json
"$program" export plain.json --format fold --output out > /dev/null || fail "export of an unshifted sheet"
"$program" fold plain.json --json > plain-folding.json
[ "$(field out/plain.fold 'file_frames[#-1]."misalign:pilot_deg"')" = \
  "$(field plain-folding.json 'samples_deg[#-1]')" ] || fail "frames of it"
"$program" export plain.json --output out > /dev/null || fail "export of an unshifted sheet as JSON"
[ "$(field out/plain.json metrics)" = "" ] || fail "metrics of a sheet that deploys from nothing"
"$program" fold out/plain.json > /dev/null || fail "fold of that"
# A flat sheet in OBJ is the sheet that was exported; what the file leaves open is said.
"$program" export plain.json --format obj --step 60 --output out > /dev/null || fail "export of an unshifted sheet as OBJ"
"$program" fold out/plain-000deg.obj --json > obj-folding.json 2> err || fail "fold of OBJ: $(cat err)"
letters() { sqlite3 :memory: "SELECT group_concat(json_extract(value, '\$.assignment')) FROM json_each(readfile('$1'), '\$.creases')"; }
[ "$(letters obj-folding.json)" = "$(letters plain-folding.json)" ] || fail "mountains and valleys of OBJ"
grep -q "follow from the pilot A2-A7, which is a valley" err || fail "letters of OBJ: $(cat err)"
"$program" contact out/plain-000deg.obj > /dev/null 2>&1 || fail "contact of OBJ"

# Verified: by two solvers, its shapes, and what an export says of itself. What is altered is named.
"$program" verify "$table1" > text || fail "verify table1: $(cat text)"
grep -q "^pattern      table1, deploys from 156 deg; first fault: fold_limit$" text || fail "verify table1: $(cat text)"
for file in $exported; do
  "$program" verify "$file" --json > verified.json || fail "verify $file: $(cat verified.json)"
  [ "$(field verified.json good)$(field verified.json compared_with_file)" = 11 ] || fail "verify $file"
  for change in 's/"stroke_max": *[0-9.e-]*/"stroke_max":0.5/=metrics.stroke_max' \
    's/"deploys_from_deg": *[0-9.]*/"deploys_from_deg":170.0/g=verdict.deploys_from_deg' \
    's/"elongation": *[0-9.e-]*/"elongation":0.1/=metrics.elongation' \
    's/"first_fault": *"[a-z_]*"/"first_fault":"not_monotone"/=verdict.first_fault'; do
    sed "${change%=*}" "$file" > "altered.${file##*.}"
    "$program" verify "altered.${file##*.}" > text
    [ $? = 6 ] || fail "verify of $file, altered by $change"
    grep -q "the file: ${change##*=}" text || fail "verify of $file, altered by $change: $(cat text)"
  done
done
# What an export does not say of itself is not missed.
for change in "json_remove(x, '\$.verdict')" "json_remove(x, '\$.metrics')" "json_remove(x, '\$.verdict', '\$.metrics')" \
  "json_remove(x, '\$.diagonals[0].elongation')"; do
  for file in $exported; do
    [ "${file##*.}" = json ] || continue
    sqlite3 :memory: "SELECT $change FROM (SELECT readfile('$file') AS x)" > "silent.json"
    "$program" verify silent.json > text || fail "verify of $file, with $change: $(cat text)"
  done
done
grep -q "with the values in the file" text || fail "compared: $(cat text)"
sqlite3 :memory: "SELECT json_remove(readfile('${exported%% *}'), '\$.verdict', '\$.metrics')" > silent.json
"$program" verify silent.json | grep -q "with the values in the file" && fail "compared with nothing"
"$program" verify plain.json > text || fail "verify of an unshifted sheet: $(cat text)"
"$program" verify "$mesh" > text || fail "verify of a mesh: $(cat text)"

# Miscut copies. A pattern's count from its own D on; an exported candidate's are those of the draw
# in a catalogue whose threshold that is (seed 1 both), and nothing is kept of them.
own_deg=$(sql a.db "SELECT deploys_from_deg FROM candidates WHERE draw = $draw")
sed "s/\"accept\".*/\"accept\": { \"deploys_from_deg\": $own_deg },/" \
  "$source_dir/search/campaigns/miura-4x4.json" > own.json
"$program" search own.json --draws $((draw + 1)) --catalogue own.db --progress none > /dev/null 2>&1 ||
  fail "search from $own_deg deg"
copies="--amplitude 0.1 --trials 200 --vertices"
# shellcheck disable=SC2086
"$program" tolerance own.db "$draw" $copies --no-keep --json | sed '/"draw":/d' > of_draw.json
[ "$(field of_draw.json threshold_deg)" = "$own_deg" ] || fail "the threshold of own.db"
[ "$(sqlite3 :memory: "SELECT $(field of_draw.json from_threshold.copies) BETWEEN 1 AND 199")" = 1 ] ||
  fail "copies that cannot tell one yield from another"
before=$(cksum $exported)
ls > files
for file in $exported; do
  # shellcheck disable=SC2086
  "$program" tolerance "$file" $copies --json > of_file.json || fail "tolerance $file"
  [ "$(field of_file.json pattern)" = "miura-4x4-$draw" ] || fail "tolerance $file: whose it is"
  sed '/"pattern":/d' of_file.json | cmp -s - of_draw.json || fail "tolerance $file: another yield"
done
"$program" tolerance "$table1" --amplitude 0.05 --trials 40 > text || fail "tolerance table1"
grep -q "^table1, deploys from 156 deg; 40 copies" text || fail "tolerance table1: $(cat text)"
tail -1 text | grep -q "^yield from 156 " || fail "tolerance table1: $(tail -1 text)"
"$program" tolerance <(cat "$table1") --amplitude 0.05 --trials 40 | tail -n +2 | cmp -s - <(tail -n +2 text) ||
  fail "tolerance of a pipe"
"$program" tolerance "$table1" --amplitude 0 --trials 5 --json > text || fail "tolerance without errors"
[ "$(field text from_threshold.share)" = 1.0 ] || fail "no error, no loss"
rm -f of_file.json text
ls | diff - <(grep -vx -e of_file.json -e text files) || fail "tolerance of a pattern writes files"
[ "$(cksum $exported)" = "$before" ] || fail "tolerance of a pattern changes it"

# refused CODE WORDS ARGS...: one sentence, and nothing written.
refused() {
  local code=$1 words=$2
  shift 2
  "$program" "$@" > stdout 2> err
  [ $? = "$code" ] || fail "exit code of $*"
  [ -s stdout ] && fail "output of $*"
  [ "$(wc -l < err)" = 1 ] || fail "one sentence: $*: $(cat err)"
  grep -q -- "$words" err || fail "no '$words': $*: $(cat err)"
  [ -e none ] && fail "something was written: $*"
}
refused 2 "draw 7 can only be chosen from a catalogue" actuators "$table1" 7
refused 2 "no DRAW is given" actuators a.db
refused 2 "no candidates are chosen" export a.db --output none
refused 2 "--best can only be chosen" export "$table1" --best 3 --output none
refused 2 "replace the one that is read" export out/table1.json --output out
refused 2 "--all can only" verify "$table1" --all
refused 2 "--sample can only" verify "$table1" --sample 5
refused 2 "a draw can only be chosen" tolerance "$table1" 7 --amplitude 0.05
for option in "--best 3" "--diverse 3" "--by stroke_min" "--where stroke_min>0"; do
  # shellcheck disable=SC2086
  refused 2 "${option% *} can only be chosen" \
    tolerance "$table1" $option --amplitude 0.05
done
refused 2 "no candidates are chosen" tolerance a.db --amplitude 0.05
refused 2 "must be below" tolerance "$table1" --amplitude 45
refused 3 "does not deploy (D = 0).*shift its vertices" tolerance plain.json --amplitude 0.05
refused 3 "does not deploy" tolerance "$mesh" --amplitude 0.05
refused 3 "is a campaign" tolerance "$source_dir/search/campaigns/miura-4x4.json" --amplitude 0.05
refused 3 "no such file" tolerance nothing.json --amplitude 0.05
refused 3 "no such file" actuators nothing.json
refused 3 "is a campaign" export "$source_dir/search/campaigns/miura-4x4.json" --output none
echo 'neither' > neither.txt
refused 3 "is no catalogue" actuators neither.txt 7
finish
