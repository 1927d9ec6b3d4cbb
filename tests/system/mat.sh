# MAT-files as Octave reads them, beside the JSON of the same sheets; and a disk that is full.
. "$(dirname "$0")/lib.sh"

"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 1500 --progress none > /dev/null || fail "search"
file=$(ls results/miura-4x4-*.db) table1=$source_dir/search/patterns/table1.json
draw=$(sql "$file" 'SELECT draw FROM candidate ORDER BY draw LIMIT 1')
"$program" export "$file" --draw "$draw" --format mat --output out > name || fail "export mat"
[ "$(cat name)" = "out/miura-4x4-$draw.mat" ] || fail "mat: $(cat name)"
"$program" export "$table1" --format mat --stroke-limit 0.08 --output out > /dev/null || fail "export table1"
for format in json fold; do
  "$program" export "$file" --draw "$draw" --format $format --output out > /dev/null || fail "export $format"
  "$program" export "$table1" --format $format --output out > /dev/null || fail "export table1 as $format"
done
"$program" replay "$file" "$draw" --json > replay.json || fail "replay"
"$program" actuators "$file" "$draw" --json > springs.json || fail "actuators"
"$program" fold "$table1" --json > table1.json || fail "fold"
"$program" actuators "$table1" --stroke-limit 0.08 --json > table1-springs.json || fail "actuators of table1"
octave-cli --no-init-file "$source_dir/tests/system/mat_test.m" \
  "out/miura-4x4-$draw.mat" replay.json springs.json "out/miura-4x4-$draw.json" "out/miura-4x4-$draw.fold" \
  out/table1.mat table1.json table1-springs.json out/table1.json out/table1.fold || fail "MAT-files in Octave"

# Fillings with lists and names of diagonals in them.
"$program" export "$table1" --format mat --output plates --fill \
  '{"kind": "plate", "cut_outs": [{"hole": [1, 2], "of_flat": [0.9, 0.95]}]}' > /dev/null || fail "mat of plates"
"$program" export "$table1" --format mat --output single --fill \
  '{"kind": "springs", "preloads_n": {"A11-A17": 2}, "single": [{"from": "A11", "to": "A17", "stiffness_n_per_mm": 7}]}' \
  > /dev/null || fail "mat of single springs"
octave-cli --no-init-file --eval "
  plates = load('plates/table1.mat').filling.fill; springs = load('single/table1.mat').springs;
  assert(plates.cut_outs{1}.hole, [1; 2]); assert(plates.cut_outs{1}.of_flat, [0.9; 0.95]);
  assert(springs.single{1}.stiffness_n_per_mm, 7); assert(springs.preloads_n.A11_A17, 2);
  assert(springs.fill.single{1}.from, 'A11'); assert(isnan(springs.fill.single{1}.free_mm));" || fail "fillings in Octave"

# The same bytes from the same sheet; and of many one after the other.
"$program" export "$table1" --format mat --stroke-limit 0.08 --output again > /dev/null
cmp out/table1.mat again/table1.mat || fail "mat: not the same bytes again"
"$program" export "$file" --best 5 --format mat --output many > names || fail "export mat --best"
[ "$(wc -l < names)" = 5 ] && [ "$(ls many | wc -l)" = 5 ] || fail "mat --best 5: $(cat names)"

# A full disk, where one may be made: a sentence, and nothing under the name.
mkdir small
if mount -t tmpfs -o size=100k tmpfs small 2> /dev/null; then
  trap 'umount "$work/small"; rm -rf "$work"' EXIT
  "$program" export "$table1" --format mat --output small > /dev/null 2> err
  [ $? = 1 ] && grep -q "cannot be written" err || fail "mat on a full disk: $(cat err)"
  [ -z "$(ls -A small)" ] || fail "mat on a full disk leaves $(ls -A small)"
fi
finish
