# Materials and hinges by name are the numbers written out, in files and options, and are recorded as such.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json

"$program" config --materials --json > tables.json || fail "config --materials --json"
"$program" config --materials > tables.md || fail "config --materials"
json_test tables.json "json_array_length(j, '\$.materials') > 8 AND json_array_length(j, '\$.hinges') > 8 AND
  (SELECT sum(length(value ->> 'source') < 20) FROM json_each(j, '\$.materials')) = 0" || fail "tables: $(cat tables.json)"
for table in materials hinges; do
  sqlite3 :memory: "SELECT value ->> 'name' FROM json_each(readfile('tables.json'), '\$.$table')" | while IFS= read -r name; do
    grep -qF "| \`$name\` |" tables.md || echo "$name"
  done > absent
  [ -s absent ] && fail "names that the text lacks: $(cat absent)"
  sed -n "s/^| \`\([^\`]*\)\` | .*/\1/p" "$source_dir/search/manual/reference/materials.md" > in_manual
  sqlite3 :memory: "SELECT value ->> 'name' FROM json_each(readfile('tables.json'), '\$.$table')" | grep -vxFf in_manual &&
    fail "the manual's table of $table lacks these"
done
"$program" config --json > out 2> err
[ $? = 2 ] && grep -q -- "--materials" err || fail "config --json alone: $(cat err)"

# row TABLE NAME: what a design may hold of it.
row() {
  sqlite3 :memory: "SELECT json_remove(value, '\$.source', '\$.stiffness_n_mm_per_mm', '\$.play_mm') FROM
    json_each(readfile('tables.json'), '\$.$1') WHERE value ->> 'name' = '$2'"
}
# of_design NAME DESIGN: a pattern file with it.
of_design() { sed "s/^{/{\"design\": ${2//\//\\/},/" "$table1" > "$1"; }

# card NAME OPTION...: a card, whether it passes or not.
card() {
  "$program" card "$@" --no-remedies --trials 10 --json
  case $? in 0 | 6) ;; *) false ;; esac
}
# same VERB NAMED WRITTEN OPTION...: the same answer of both files.
same() {
  local verb=$1 named=$2 written=$3
  shift 3
  "$program" "$verb" "$named" "$@" --json > named.out 2> err
  code=$?
  case $code:$verb in 0:* | 6:card) ;; *) fail "$verb $named $*: $(cat err)" ;; esac
  "$program" "$verb" "$written" "$@" --json > written.out 2> err
  [ $? = $code ] || fail "$verb $written $*: $(cat err)"
  sed -i 's/"pattern": ".*"/"pattern": ""/' named.out written.out
  cmp -s named.out written.out || fail "$verb: $named and $written differ: $(diff named.out written.out | head -5)"
}
birch=$(row materials "birch plywood")
film=$(row hinges "polyester film 0.05 mm")
pin=$(row hinges "steel pin 1 mm in PTFE")
use='"from_deg": 60, "thickness_mm": 1'
of_design named.json "{$use, \"material\": \"birch plywood\", \"hinges\": {\"like\": \"polyester film 0.05 mm\"}}"
of_design written.json "{$use, \"material\": $birch, \"hinges\": $(echo "$film" | sed 's/"[a-z_]*":null,//g')}"
of_design plain.json "{$use, \"hinges\": {\"friction_n_mm_per_mm\": 0.5, \"kind\": \"dash\"}, \"play_mm\": 0.05}"
same deploy named.json written.json
json_test named.out "json_extract(j, '\$.bent.material.name') = 'birch plywood' AND json_extract(j, '\$.bent.material.e_gpa') = 8.75" ||
  fail "the material that bends"
same card named.json written.json --no-remedies --trials 10
json_test named.out "json_extract(j, '\$.design.material.e_gpa') = 8.75 AND json_extract(j, '\$.design.hinges.name') = 'polyester film 0.05 mm'
  AND json_extract(j, '\$.design.hinges.film.e_gpa') = 4.9" || fail "a recorded design: $(cat named.out)"
# What a card records is the design of a file that has the same card.
of_design again.json "$(sqlite3 :memory: "SELECT json_extract(readfile('named.out'), '\$.design')")"
same card again.json named.json --no-remedies --trials 10

# Options are files; named hinges replace a file's, and options' numbers go before theirs.
echo "$birch" > birch.json
"$program" deploy plain.json --material "birch plywood" --hinge "polyester film 0.05 mm" --json > options.out 2> err || fail "options: $(cat err)"
"$program" deploy named.json --json > named.out
sed -i 's/"pattern": ".*"/"pattern": ""/' options.out named.out
cmp -s options.out named.out || fail "options and files differ: $(diff options.out named.out | head -5)"
same deploy plain.json plain.json --material birch.json --hinge "glued textile"
json_test named.out "json_extract(j, '\$.friction_n_mm_per_mm') IS NOT 0.5" || fail "the file's friction"
card plain.json --hinge "steel pin 1 mm in PTFE" > pin.json || fail "pins"
json_test pin.json "json_extract(j, '\$.design.hinges.pin_friction_mm') = $(echo "$pin" | sed 's/.*"pin_friction_mm":\([0-9.]*\).*/\1/')
  AND json_extract(j, '\$.design.hinges.friction_n_mm_per_mm') IS NULL AND json_extract(j, '\$.design.play_mm') = 0.05" ||
  fail "hinges of an option: $(cat pin.json)"
card plain.json --hinge "printed pin hinge" --pin-friction 0.3 > pin.json || fail "printed pins"
json_test pin.json "json_extract(j, '\$.design.hinges.pin_friction_mm') = 0.3 AND json_extract(j, '\$.design.play_mm') = 0.2" ||
  fail "numbers of options go first: $(cat pin.json)"
card "$table1" --material "birch plywood" --thickness 1 > card.json || fail "--material of a card"
json_test card.json "json_extract(j, '\$.design.material.strength_mpa') = 17.4" || fail "the strength: $(cat card.json)"

# A kit's creases: option, design, material, score.
# layer OPTION...: the layers of creases in its kit.
layer() {
  rm -rf kit
  "$program" export "$@" --format svg --kit --output kit > /dev/null 2> err || fail "kit $*: $(cat err)"
  cat kit/*.svg | grep -oE '(score|dash)_(mountain|valley)' | sort -u | tr '\n' ' '
}
of_design boards.json '{"material": "cardboard"}'
of_design cut.json '{"material": "birch plywood"}'
of_design dashed.json '{"material": "birch plywood", "hinges": {"kind": "dash"}}'
[ "$(layer "$table1")" = "$(layer boards.json)" ] && [ "$(layer boards.json)" = "score_mountain score_valley " ] || fail "scored kits"
[ -z "$(layer cut.json)" ] || fail "plywood is cut: $(layer cut.json)"
[ "$(layer dashed.json)" = "dash_mountain dash_valley " ] || fail "the design goes before its material"
[ "$(layer cut.json --crease score)" = "score_mountain score_valley " ] || fail "an option goes before both"
[ -z "$(layer "$table1" --material acrylic)" ] || fail "--material of a kit"

# refused CODE WORDS ARGUMENT...: one sentence.
refused() {
  local code=$1 words=$2
  shift 2
  "$program" "$@" > out.txt 2> err
  [ $? = "$code" ] && [ ! -s out.txt ] && [ "$(wc -l < err)" = 1 ] && grep -qF -- "$words" err || fail "$*: $(cat err)"
}
for verb in card deploy optimise "export --format inp --output o" "stress --output o"; do
  # shellcheck disable=SC2086
  refused 2 "--material birch: is no material of the table; did you mean birch plywood?, and no file; write a name that" \
    $verb "$table1" --material birch
done
refused 2 "--hinge textile: is no hinge of the table; did you mean glued textile?; write a name that" deploy "$table1" --hinge textile
refused 2 "has no meaning without --format inp, or --kit" export "$table1" --format csv --material PLA --output o
of_design wrong.json '{"material": "plywood"}'
refused 3 'design.material = "plywood" (is no material of the table; did you mean birch plywood?); write a name that `misalign config --materials`' \
  fold wrong.json
of_design wrong.json '{"hinges": {"like": "polyester"}}'
refused 3 'design.hinges.like = "polyester" (is no hinge of the table; did you mean polyester film 0.05 mm or polyester film 0.1 mm?)' \
  fold wrong.json

# The design changes no digest, and a catalogue keeps numbers.
quick_campaign plain.campaign.json
sed 's/^{/{"design": {"material": "MDF", "hinges": {"like": "printed pin hinge"}},/' plain.campaign.json > named.campaign.json
for which in plain named; do
  "$program" search $which.campaign.json --draws 50 --catalogue $which.db > /dev/null 2> err || fail "search: $(cat err)"
done
[ "$(digest_of plain.db)" = "$(digest_of named.db)" ] || fail "names change the digest"
[ "$(sql named.db "SELECT json_extract(configuration, '\$.design.material.e_gpa') || ' ' ||
  json_extract(configuration, '\$.design.play_mm') FROM campaign")" = "2.7 0.2" ] || fail "the catalogue's design"
finish
