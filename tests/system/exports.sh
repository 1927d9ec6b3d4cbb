# Exported files as others read them: FOLD by Rabbit Ear and by the program itself, SVG in a browser.
# Called with a third argument: the directory of tests/report with its packages.
. "$(dirname "$0")/lib.sh"
web=$3
field() { sqlite3 :memory: "SELECT json_extract(readfile('$1'), '\$.$2')"; }

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
for svg in out/*.svg; do
  node "$web/svg_test.mjs" "$svg" "${svg%.svg}.fold" || fail "$svg"
done
# What sees nothing wrong must be able to: a drawing at another scale, a valley drawn as a mountain.
svg=$(ls out/*.svg | head -1)
sed 's/width="\([0-9.]*\)mm"/width="\1px"/; s/height="\([0-9.]*\)mm"/height="\1px"/' "$svg" > scaled.svg
node "$web/svg_test.mjs" scaled.svg "${svg%.svg}.fold" > /dev/null 2>&1 && fail "another scale goes unseen"
sed 's/id="valley"/id="other"/; s/id="mountain"/id="valley"/; s/id="other"/id="mountain"/' "$svg" > swapped.svg
node "$web/svg_test.mjs" swapped.svg "${svg%.svg}.fold" > /dev/null 2>&1 && fail "swapped layers go unseen"

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
sed 's/"faces_vertices":\[\[0,/"faces_vertices":[[1,/' "$fold" > edited.fold
"$program" fold edited.fold > /dev/null 2> err
[ $? = 3 ] || fail "an edited FOLD file is folded"
grep -q "were changed since" err || fail "an edited FOLD file: $(cat err)"
"$program" fold "$source_dir/search/patterns/angle-array-6x6.fold" > /dev/null || fail "fold of a mesh"

# OBJ: a file for the flat sheet, one every 30 degrees and one at D.
best=$(sql "$file" 'SELECT draw FROM candidates ORDER BY deploys_from_deg DESC, slope_min_mm_per_deg DESC LIMIT 1')
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
"$program" export "$file" --draw "$best" --format csv --stiffness 100 --output out > /dev/null
[ "$(head -1 "out/miura-4x4-$best.csv" | tr , '\n' | tail -3 | tr '\n' ' ')" = \
  "energy_n_mm moment_n_mm mechanical_advantage " ] || fail "csv: springs"
[ "$(tail -n +2 "out/miura-4x4-$best.csv" | tail -1 | tr , '\n' | wc -l)" = 8 ] || fail "csv: columns"

# Near twins of the best one: --best takes them, --diverse does not.
cp "$file" twins.db
sqlite3 twins.db "CREATE TEMP TABLE twin AS SELECT * FROM candidate WHERE draw = $best;
  UPDATE twin SET draw = 1000001; INSERT INTO candidate SELECT * FROM twin;
  UPDATE twin SET draw = 1000002; INSERT INTO candidate SELECT * FROM twin;"
chosen() { "$program" export twins.db "$@" --output twins | sed 's/.*-\([0-9]*\).json/\1/' | sort -n | tr '\n' ' '; }
[ "$(chosen --best 3)" = "$best 1000001 1000002 " ] || fail "--best among twins: $(chosen --best 3)"
case " $(chosen --diverse 3)" in *" 100000"*) fail "--diverse takes twins: $(chosen --diverse 3)" ;; esac
case " $(chosen --diverse 3)" in *" $best "*) ;; *) fail "--diverse leaves the best one out" ;; esac
[ "$(chosen --draw 1000001 --draw "$best")" = "$best 1000001 " ] || fail "--draw twice"
[ "$(chosen --best 1 --where "draw > 1000001")" = "1000002 " ] || fail "--best with --where"
for wrong in "--best 1 --diverse 2" "--draw 1 --best 2" "" "--draw 999999" "--best 1 --by nothing" \
  "--where nonsense"; do
  # shellcheck disable=SC2086
  "$program" export "$file" $wrong --output none > /dev/null 2> err
  [ $? = 2 ] || fail "export $wrong: exit code, $(cat err)"
done
[ -e none ] && fail "a refused export leaves a directory"

# A row of a catalogue that is no candidate is a sentence, not a crash.
sqlite3 twins.db "UPDATE candidate SET elongation = '{}' WHERE draw = 1000001"
"$program" export twins.db --diverse 2 --output twins > /dev/null 2> err
[ $? = 3 ] || fail "a damaged candidate: $(cat err)"
finish
