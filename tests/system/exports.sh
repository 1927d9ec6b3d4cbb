# Exported files as others read them: FOLD by Rabbit Ear and by the program itself, SVG in a browser.
# Called with a third argument: the directory of tests/report with its packages.
. "$(dirname "$0")/lib.sh"
web=$3

campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 1500 --progress none > /dev/null || fail "search"
sed "s|\.\./patterns|$source_dir/search/patterns|; s/\"deploys_from_deg\": [0-9]*/\"deploys_from_deg\": 60/" \
  "$source_dir/search/campaigns/angle-array-6x6.json" > mesh.json
"$program" search mesh.json --draws 500 --progress none > /dev/null || fail "search of a FOLD mesh"
file=$(ls results/miura-4x4-*.db) mesh=$(ls results/angle-array-6x6-*.db)

for catalogue in "$file" "$mesh"; do
  for format in fold svg; do
    "$program" export "$catalogue" --diverse 3 --format $format --output out > names || fail "export"
    [ "$(wc -l < names)" = 3 ] || fail "export --diverse 3 wrote: $(cat names)"
  done
done
node "$web/fold_test.mjs" out/*.fold || fail "FOLD files"
# One of each sheet; and what sees nothing wrong must be able to: a drawing at another scale, a valley
# drawn as a mountain.
svg=$(ls out/*.svg | head -1) other=$(ls out/*.svg | tail -1)
sed 's/width="\([0-9.]*\)mm"/width="\1px"/; s/height="\([0-9.]*\)mm"/height="\1px"/' "$svg" > scaled.svg
sed 's/id="valley"/id="other"/; s/id="mountain"/id="valley"/; s/id="other"/id="mountain"/' "$svg" > swapped.svg
node "$web/svg_test.mjs" "$svg" "${svg%.svg}.fold" "$other" "${other%.svg}.fold" \
  --wrong scaled.svg "${svg%.svg}.fold" --wrong swapped.svg "${svg%.svg}.fold" || fail "SVG files"

# Read again, a FOLD file folds as its candidate did.
for fold in out/*.fold; do
  draw=$(field "$fold" '"misalign:data".draw')
  case $fold in *angle*) catalogue=$mesh ;; *) catalogue=$file ;; esac
  "$program" fold "$fold" --json > again.json || fail "fold $fold"
  "$program" replay "$catalogue" "$draw" --json > replay.json || fail "replay $draw"
  for key in deploys_from_deg first_fault fault_deg where; do
    [ "$(field again.json verdict.$key)" = "$(field replay.json verdict.$key)" ] ||
      fail "$fold: $key is $(field again.json verdict.$key), was $(field replay.json verdict.$key)"
  done
done
# With fillers a reader that folds along a tree of faces places all panels; without it cannot, and what
# sees nothing wrong must be able to. They are no part of the sheet, which folds as before.
table1=$source_dir/search/patterns/table1.json
"$program" export "$table1" --format fold --step 30 --output apart > /dev/null || fail "export table1"
"$program" export "$table1" --format fold --step 30 --joined --output joined > /dev/null || fail "export --joined"
"$program" export "$mesh" --diverse 3 --format fold --joined --output joined > /dev/null || fail "export --joined of a mesh"
node "$web/fold_test.mjs" joined/*.fold || fail "FOLD files with fillers"
node "$web/refold_test.mjs" joined/*.fold || fail "FOLD files with fillers, refolded"
node "$web/refold_test.mjs" --apart apart/table1.fold || fail "FOLD files without fillers, refolded"
[ "$(field joined/table1.fold '"misalign:fillers"[1].hole')" ] || fail "joined: fewer than two fillers"
"$program" fold joined/table1.fold --json > again.json || fail "fold joined"
"$program" fold "$table1" --json > plain.json
for key in verdict diagonals creases; do
  [ "$(field again.json $key)" = "$(field plain.json $key)" ] || fail "joined: other $key"
done
sed 's/"hinges":"[MV]*"/"hinges":"QQQ"/' joined/table1.fold > edited.fold
"$program" fold edited.fold > /dev/null 2> err
[ $? = 3 ] && grep -q "were changed since" err || fail "joined, edited: $(cat err)"
"$program" export "$file" --best 1 --joined --output none > /dev/null 2> err
[ $? = 2 ] || fail "--joined without fold: $(cat err)"

# Of other samples, too, and from the JSON.
sed 's/"end_deg": 180/"end_deg": 112/; s/"sample_deg": 1/"sample_deg": 0.7/; s/"deploys_from_deg": 150/"deploys_from_deg": 70/' \
  "$campaign" > fine.json
"$program" search fine.json --catalogue fine.db --draws 100 --progress none > /dev/null || fail "search fine.json"
draw=$(sql fine.db 'SELECT draw FROM candidates WHERE deploys_from_deg < 112 ORDER BY deploys_from_deg DESC LIMIT 1')
deploys=$(sql fine.db "SELECT round(deploys_from_deg, 6) FROM candidate WHERE draw = $draw")
for format in json fold; do
  "$program" export fine.db --draw "$draw" --format $format --output fine > name || fail "export fine"
  "$program" fold "$(cat name)" --json > again.json || fail "fold of $format"
  [ "$(sqlite3 :memory: "SELECT round(json_extract(readfile('again.json'), '\$.verdict.deploys_from_deg'), 6)")" = \
    "$deploys" ] || fail "fold of $format, other samples: $(field again.json verdict.deploys_from_deg), was $deploys"
done
# What lies between samples is that of the path, for all alike. The cubics through samples ten degrees apart have
# the bump of draw 42 elsewhere, and those through every degree see one of draw 8351 that is none.
sed 's/"sample_deg": 1/"sample_deg": 10/' "$campaign" > wide.json
for case in wide.json:42 "$campaign":8351; do
  draw=${case##*:}
  "$program" search "${case%:*}" --catalogue between.db --range "$draw:$((draw + 1))" --progress none > /dev/null ||
    fail "search of draw $draw"
  "$program" export between.db --draw "$draw" --format fold --output between > name || fail "export of draw $draw"
  for form in json txt; do
    option=$([ $form = txt ] || echo --json)
    "$program" replay between.db "$draw" $option > replay.$form && "$program" fold "$(cat name)" $option > again.$form ||
      fail "replay and fold of draw $draw"
  done
  [ "$(field replay.json bump_between_samples)" = "$(field again.json bump_between_samples)" ] ||
    fail "draw $draw: replay sees $(field replay.json bump_between_samples), fold $(field again.json bump_between_samples)"
  [ "$(grep ^bump replay.txt)" = "$(grep ^bump again.txt)" ] || fail "draw $draw: replay prints another bump than fold"
  bump=$(sql between.db "SELECT bump_deg FROM candidate WHERE draw = $draw")
  [ "$(field replay.json bump_between_samples.from_deg)" = "$bump" ] &&
    [ "$(field "$(cat name)" '"misalign:data".metrics.bump_deg')" = "$bump" ] ||
    fail "draw $draw: its candidate's bump is at $bump, replay's $(field replay.json bump_between_samples)"
  rm between.db
done
sed 's/"faces_vertices":\[\[0,/"faces_vertices":[[1,/' "$fold" > edited.fold
"$program" fold edited.fold > /dev/null 2> err
[ $? = 3 ] || fail "an edited FOLD file is folded"
grep -q "were changed since" err || fail "an edited FOLD file: $(cat err)"
sed 's/"M"/"x"/g; s/"V"/"M"/g; s/"x"/"V"/g' "$fold" > edited.fold
"$program" fold edited.fold > /dev/null 2>&1
[ $? = 3 ] || fail "a FOLD file with mountains for valleys is folded"
"$program" fold "$source_dir/search/patterns/angle-array-6x6.fold" > /dev/null || fail "fold of a mesh"

# OBJ: a file for the flat sheet, one every 30 degrees and one at D.
best=$(sql "$file" 'SELECT draw FROM candidates ORDER BY goes_back, deploys_from_deg DESC, miscut_margin_mm DESC, slope_min_mm_per_deg DESC LIMIT 1')
deploys=$(sql "$file" "SELECT CAST(deploys_from_deg AS INTEGER) FROM candidate WHERE draw = $best")
"$program" export "$file" --best 1 --format obj --step 30 --output obj > names || fail "export obj"
for pilot in 000 030 060 090 120 150 "$(printf %03d "$deploys")"; do
  grep -q "^obj/miura-4x4-$best-${pilot}deg.obj$" names || fail "obj: no state at $pilot deg"
done

# Springs twice as stiff pull twice as hard; what they may not reach is said.
"$program" actuators "$file" "$best" --json > soft.json || fail "actuators"
"$program" actuators "$file" "$best" --stiffness 100 --stroke-limit 0.001 --json > stiff.json
for key in energy_n_mm weakest.moment_n_mm 'forces[2].force_n'; do
  [ "$(sqlite3 :memory: "SELECT abs(json_extract(readfile('stiff.json'), '\$.$key') /
    json_extract(readfile('soft.json'), '\$.$key') - 2) < 1e-12")" = 1 ] || fail "actuators: $key"
done
[ "$(field stiff.json 'over_stroke.diagonals[0]')" ] || fail "actuators: over_stroke"
[ "$(field soft.json over_stroke)" = "" ] || fail "actuators: over_stroke without a limit"

# One long table of many draws, as SQLite itself reads CSV: the diagonals' numbers and elongations at
# D are those of the view, springs twice as stiff store twice as much.
"$program" export "$file" --where "stroke_max > 0.01" --format csv --creases --output table > names || fail "export csv"
[ "$(tr '\n' ' ' < names)" = "table/miura-4x4.csv table/miura-4x4-creases.csv " ] || fail "csv: $(cat names)"
"$program" export "$file" --draw "$best" --format csv --stiffness 100 --output table > names || fail "export csv"
[ "$(cat names)" = "table/miura-4x4-$best.csv" ] || fail "csv of one draw: $(cat names)"
cp "$file" joined.db
sqlite3 joined.db '.mode csv' '.import table/miura-4x4.csv long' '.import table/miura-4x4-creases.csv creases' \
  ".import table/miura-4x4-$best.csv stiff" || fail "csv: sqlite3 cannot read it"
holds() { [ "$(sqlite3 joined.db "SELECT $2")" = 1 ] || fail "csv: $1"; }
holds "whose rows" "(SELECT group_concat(draw) FROM (SELECT DISTINCT CAST(draw AS INTEGER) AS draw FROM long ORDER BY 1)) =
  (SELECT group_concat(draw) FROM (SELECT draw FROM candidate WHERE stroke_max > 0.01 ORDER BY 1))"
holds "elongations at D" "(SELECT count(*) FROM diagonals JOIN candidate USING (draw) WHERE stroke_max > 0.01) =
  (SELECT count(*) FROM long JOIN diagonals AS d ON d.draw = long.draw AND d.diagonal = CAST(long.diagonal AS INTEGER)
   JOIN candidate AS c ON c.draw = d.draw AND long.pilot_deg = c.deploys_from_deg
   WHERE abs(long.elongation - d.elongation) < 2e-9 AND long.from_vertex = d.from_vertex AND
     long.to_vertex = d.to_vertex AND CAST(long.hole_row AS INTEGER) = d.hole_row AND
     CAST(long.hole_column AS INTEGER) = d.hole_column)"
holds "stiffer springs" "(SELECT count(*) > 100 AND max(abs(stiff.energy_n_mm - 2 * long.energy_n_mm)) <= 1e-6 * max(stiff.energy_n_mm)
  FROM stiff JOIN long USING (draw, pilot_deg, diagonal))"
holds "creases" "(SELECT count(DISTINCT crease) = 16 AND min(CAST(crease AS INTEGER)) = 0 AND
  count(*) = 4 * (SELECT count(*) FROM long) FROM creases)"
"$program" replay "$file" "$best" --json > replay.json
holds "fold angles" "(SELECT count(*) = 16 FROM json_each(readfile('replay.json'), '\$.creases') AS c JOIN creases AS t
  ON t.crease = c.value ->> 'crease' WHERE t.draw = $best AND t.pilot_deg = '90' AND
  abs(t.fold_angle_deg - (c.value ->> '\$.fold_angle_deg[89]')) < 1e-8)"
# Thinned: flat, multiples and D of the same rows.
"$program" export "$file" --where "stroke_max > 0.01" --format csv --creases --every 30 --output thin > /dev/null || fail "export csv --every"
sqlite3 joined.db '.mode csv' '.import thin/miura-4x4.csv thin' '.import thin/miura-4x4-creases.csv thin_creases'
for table in "thin long" "thin_creases creases"; do
  read -r thin whole <<< "$table"
  holds "--every 30 in $thin" "(SELECT count(*) > 100 FROM $thin) AND NOT EXISTS (SELECT * FROM $thin EXCEPT SELECT * FROM $whole)
    AND (SELECT count(*) FROM $thin) = (SELECT count(*) FROM $whole JOIN candidate AS c USING (draw)
    WHERE CAST(pilot_deg AS REAL) IN (0, 30, 60, 90, 120, 150, 180, c.deploys_from_deg))"
done
"$program" export "$file" --draw "$best" --every 30 --output none > /dev/null 2> err
[ $? = 2 ] && grep -q -e "--every has no meaning without --format csv" err || fail "--every without csv: $(cat err)"
# All ways of writing a candidate number its diagonals as the view does.
for text in "out/miura-4x4-$best.json" soft.json; do
  [ -e "$text" ] || "$program" export "$file" --draw "$best" --output out > /dev/null
  case $text in soft.json) list='$.forces' ;; *) list='$.diagonals' ;; esac
  holds "numbers in $text" "(SELECT count(*) = 4 FROM json_each(readfile('$text'), '$list') AS j JOIN diagonals AS d
    ON d.diagonal = CAST(j.value ->> 'diagonal' AS INTEGER) WHERE d.draw = $best AND d.from_vertex = j.value ->> 'from' AND d.to_vertex = j.value ->> 'to')"
done
"$program" export "$file" --draw "$best" --format csv --output /dev/full > /dev/null 2>&1 && fail "csv into no directory"
"$program" export "$file" --draw "$best" --creases --output none > /dev/null 2> err
[ $? = 2 ] || fail "--creases without csv: $(cat err)"

# Near twins of the best one, in the rows of two other candidates: --best takes them, --diverse not.
cp "$file" twins.db
twins=$(sqlite3 -separator ' ' twins.db "SELECT min(draw), max(draw) FROM candidate WHERE draw != $best")
read -r one other <<< "$twins"
for twin in $one $other; do
  sqlite3 twins.db "UPDATE candidate SET (deploys_from_sample, deploys_from_deg, miscut_margin_mm,
    slope_between_min_mm_per_deg, bump_deg, displacements_mm, elongation) = (SELECT deploys_from_sample,
    deploys_from_deg, miscut_margin_mm * 0.999, slope_between_min_mm_per_deg, bump_deg,
    displacements_mm, elongation FROM candidate WHERE draw = $best)
    WHERE draw = $twin"
done
sorted=$(printf '%s\n' "$best" "$one" "$other" | sort -n | tr '\n' ' ')
chosen() { "$program" export twins.db "$@" --output twins | sed 's/.*-\([0-9]*\).json/\1/' | sort -n | tr '\n' ' '; }
[ "$(chosen --best 3)" = "$sorted" ] || fail "--best among twins: $(chosen --best 3)"
for twin in $one $other; do
  case " $(chosen --diverse 3)" in *" $twin "*) fail "--diverse takes a twin" ;; esac
done
case " $(chosen --diverse 3)" in *" $best "*) ;; *) fail "--diverse leaves the best one out" ;; esac
[ "$(chosen --draw "$one" --draw "$best" | wc -w)" = 2 ] || fail "--draw twice"
[ "$(chosen --best 1 --where "draw = $other -- a comment")" = "$other " ] || fail "--best with --where"
# The deepest, said to go back on its last degree: the best by that column, if that is asked for, and no other.
sqlite3 twins.db "UPDATE candidate SET slope_between_min_mm_per_deg = -1, deploys_from_deg = 181 WHERE draw = $one"
[ "$(chosen --best 1)" != "$one " ] || fail "the best goes back"
[ "$(chosen --best 1 --by deploys_from_deg)" = "$one " ] || fail "--by deploys_from_deg is another column"
for wrong in "--best 1 --diverse 2" "--draw 1 --best 2" "" "--draw 999999" "--best 1 --by nothing" \
  "--where nonsense" "--where 1)--" "--draw $best --by draw" "--best 1 --step 5" "--best 0" "--diverse 0"; do
  # shellcheck disable=SC2086
  "$program" export "$file" $wrong --output none > /dev/null 2> err
  [ $? = 2 ] || fail "export $wrong: exit code, $(cat err)"
done
[ -e none ] && fail "a refused export leaves a directory"

# Rows of a catalogue that are no candidates are a sentence, not a crash.
sqlite3 twins.db "UPDATE candidate SET elongation = '{}' WHERE draw = $one"
"$program" export twins.db --diverse 2 --output twins > /dev/null 2> err
[ $? = 3 ] || fail "a damaged candidate: $(cat err)"
rejected=$(sql "$file" 'WITH RECURSIVE n(d) AS (SELECT 0 UNION ALL SELECT d + 1 FROM n WHERE d < 1499)
  SELECT d FROM n WHERE d NOT IN (SELECT draw FROM candidate) LIMIT 1')
sqlite3 twins.db "UPDATE candidate SET draw = $rejected WHERE draw = $other"
for format in json csv mat fold svg obj mjcf inp; do
  "$program" export twins.db --draw "$rejected" --format $format --output twins > /dev/null 2> err
  [ $? = 3 ] || fail "a row that is no candidate, as $format: $(cat err)"
done
# What is there and is no file stays; a link is written through.
mkdir -p taken/"miura-4x4-$best.json" && ln -s elsewhere.svg taken/"miura-4x4-$best.svg"
"$program" export "$file" --draw "$best" --output taken > /dev/null 2> err
[ $? = 1 ] || fail "export onto a directory"
grep -q "no file" err || fail "export onto a directory: $(cat err)"
"$program" export "$file" --draw "$best" --format svg --output taken > /dev/null || fail "export onto a link"
[ -L "taken/miura-4x4-$best.svg" ] && [ -s taken/elsewhere.svg ] || fail "a link is not written through"
finish
