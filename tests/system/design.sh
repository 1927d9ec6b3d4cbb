# The design block: every study takes its defaults from it, options go before it, and beyond D it says D.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json
block='"design": { "from_deg": 140, "springs": { "stiffness_n_per_mm": 2, "stroke_limit": 0.08 }, "hinges": {
  "friction_n_mm_per_mm": 0.0005, "kind": "dash" }, "thickness_mm": 0.5,
  "material": { "name": "birch", "density_g_per_cm3": 0.68 }, "miscut_mm": 0.05, "play_mm": 0.01 }'
sed "s|\"accept\"|${block//$'\n'/ }, \"accept\"|" "$source_dir/search/campaigns/miura-4x4.json" > mine.json
"$program" config --check mine.json > /dev/null || fail "config"
"$program" search mine.json --draws 100 --catalogue mine.db > /dev/null 2>&1 || fail "search"
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 100 --catalogue plain.db > /dev/null 2>&1
[ "$(digest_of mine.db)" = "$(digest_of plain.db)" ] || fail "the design changed the digest"
draw=$(sql mine.db 'SELECT draw FROM candidates ORDER BY slope_min_mm_per_deg DESC LIMIT 1')

# with_block VERB OPTIONS...: the same answer from the block and from options.
with_block() {
  local verb=$1
  shift
  "$program" "$verb" mine.db "$draw" --json > block.json 2> err || fail "$verb: $(cat err)"
  "$program" "$verb" plain.db "$draw" "$@" --json > options.json 2> err || fail "$verb $*: $(cat err)"
  cmp -s block.json options.json || fail "$verb: the block says other than $*"
}
with_block contact --from 140
[ "$(field block.json thickness.reaches_deg)" = 140.0 ] || fail "plates reach the angle of use"
with_block actuators --from 140 --stiffness 2 --stroke-limit 0.08
[ "$(field block.json from_deg)" = 140.0 ] || fail "springs at the angle of use"
echo '{ "name": "birch", "density_g_per_cm3": 0.68 }' > birch.json
with_block deploy --from 140 --stiffness 2 --friction 0.0005 --thickness 0.5 --material birch.json
[ "$(field block.json bent.material.name)" = birch ] || fail "panels bend where the design names a material"
with_block tolerance --from 140 --amplitude 0.05 --trials 1000
[ "$(field block.json threshold_deg)" = 140.0 ] || fail "copies deploy from the angle of use"
"$program" certify mine.db "$draw" --json > block.json || fail "certify"
"$program" certify plain.db "$draw" --from 140 --json > options.json || fail "certify --from"
for key in certified_deg asked_deg; do
  [ "$(field block.json $key)" = "$(field options.json $key)" ] || fail "certify: $key"
done
[ "$(field block.json asked_deg)" = 140.0 ] || fail "a proof up to the angle of use"

# Rows of their own; the column stays the threshold's.
[ "$(sql mine.db 'SELECT from_deg, trials FROM yield')" = "140.0|1000" ] || fail "kept: $(sql mine.db 'SELECT * FROM yield')"
[ "$(sql mine.db 'SELECT count(yield) FROM candidates')" = 0 ] || fail "yield is not the threshold's"
"$program" tolerance mine.db "$draw" --from 150 --trials 50 > /dev/null || fail "from the threshold"
[ "$(sql mine.db 'SELECT count(*) FROM yield')" = 2 ] || fail "two rows"
[ "$(sql mine.db 'SELECT count(yield) FROM candidates')" = 1 ] || fail "the threshold's in the column"
"$program" verify mine.db --sample 1 > /dev/null || fail "verify"

# An option goes before the block, and an export carries it.
"$program" contact mine.db "$draw" --from 90 --json > less.json
[ "$(field less.json thickness.reaches_deg)" = 90.0 ] || fail "--from before the block"
"$program" export mine.db --draw "$draw" --output out > names || fail "export"
exported=$(cat names)
[ "$(field "$exported" design.springs.stiffness_n_per_mm)" = 2.0 ] || fail "the export's design"
[ "$(field "$exported" deployment.from_deg)" = 140.0 ] && [ "$(field "$exported" actuation.from_deg)" = 140.0 ] ||
  fail "an export at the angle of use"
for verb in contact deploy actuators; do
  "$program" $verb mine.db "$draw" --json | grep -v '"draw"' > of_draw.json
  "$program" $verb "$exported" --json | grep -v '"pattern"' > of_file.json
  cmp -s of_draw.json of_file.json || fail "$verb of the export"
done
"$program" actuators mine.db "$draw" --from 139.5 --json > between.json || fail "springs between samples"
[ "$(field between.json from_deg)" = 139.5 ] || fail "an angle between samples"
"$program" export mine.db --draw "$draw" --from 139.5 --output out > names || fail "an export between samples"
"$program" export mine.db --draw "$draw" --format svg --kit --output kit > names && grep -q dash "$(head -1 names)" ||
  fail "the kit's hinges"
"$program" export plain.db --draw "$draw" --output plain > names && ! grep -q '"design"' "$(cat names)" ||
  fail "a design that nobody said"

# refused CODE WORDS ARGUMENT...
refused() {
  local code=$1 words=$2
  shift 2
  "$program" "$@" > out.txt 2> err
  [ $? = "$code" ] && [ ! -s out.txt ] && [ "$(wc -l < err)" = 1 ] && grep -q -- "$words" err || fail "$*: $(cat err)"
}
refused 2 "--from 157: lies beyond D = 156 deg, from which table1 deploys" contact "$table1" --from 157
refused 2 "--from 157: lies beyond D = 156 deg" actuators "$table1" --from 157
refused 2 "--from 157: lies beyond D = 156 deg" tolerance "$table1" --amplitude 0.05 --from 157
refused 2 "must be a whole multiple of sample_deg = 1" tolerance mine.db "$draw" --from 139.5
refused 2 "is not a number from 0.01 to 180" contact "$table1" --from 0
refused 2 "has no meaning without --format json" export "$table1" --format csv --from 30 --output o
plate='{"kind": "plate", "prestretch": 1.1}'
refused 2 "fill.prestretch = 0 (must be from 0.1 to 10)" actuators "$table1" --fill '{"kind": "plate", "prestretch": 0}'
refused 2 "is no filling of a hole" deploy "$table1" --fill '{"kind": "foam"}'
refused 2 "excludes --fill" card "$table1" --fill "$plate" --stiffness 20
refused 3 "is no hole of this sheet" actuators "$table1" --fill '{"kind": "plate", "cut_outs": [{"hole": [0, 0], "of_flat": [1, 1]}]}'
refused 2 "is no filling for" export "$table1" --fill "$plate" --format mjcf --output o
refused 2 "--most-rate: is a limit of chosen springs" actuators "$table1" --fill "$plate" --choose --most-rate 1
refused 2 "excludes" actuators "$table1" --choose --stiffness 2
refused 2 "is of springs as bodies, and the springs have no diameter" contact "$table1" --end 6
refused 2 "has no --criterion energy" certify "$table1" --closed-form --criterion energy
sed "s/^{/{\"design\": {\"springs\": {\"rest_deg\": 60}},/" "$table1" > stopped.json
refused 2 "needs a filling that is relaxed flat and equal in all holes" optimise stopped.json --criterion energy
refused 2 "stores no energy, so it has no card" card "$table1" --fill '{"kind": "none"}'
sed "s/^{/{\"design\": {\"fill\": $plate},/" "$table1" > plates.json
"$program" certify plates.json --criterion energy --to 20 --json > certified.json || fail "a proof of plates"
json_test certified.json "json_extract(j, '\$.design.fill.prestretch') = 1.1" || fail "the certified file has lost its design"
"$program" actuators "$table1" --choose --most-rate 1 --from 90 --json > chosen.json || fail "chosen springs"
json_test chosen.json "json_extract(j, '\$.deploys_from_deg') = 156 AND json_extract(j, '\$.choice.drives')" ||
  fail "JSON of chosen springs"
refused 2 "is of springs, and this sheet's holes have rubber plates" actuators plates.json --stiffness 20
refused 2 'give springs by design.fill = {"kind":"springs"}' optimise plates.json
refused 2 'give springs by design.fill = {"kind": "springs"}' contact plates.json --diameter 5
"$program" actuators plates.json > words && head -2 words | grep -q "rubber plates of 1 mm" || fail "plates of a file: $(cat words)"
sed 's/"from_deg": 140/"from_deg": 200/; s/"miscut_mm": 0.05/"miscut": 0.05/' mine.json > bad.json
"$program" config --check bad.json > err 2>&1
[ $? = 3 ] && grep -q "design.from_deg = 200" err && grep -q "design.miscut" err || fail "faults of the block: $(cat err)"
finish
