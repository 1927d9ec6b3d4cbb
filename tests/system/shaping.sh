# A search among sheets of one shape: one digest whatever the ranks, kills, files, registers and functions of the C library;
# ends that have the shape by other verbs' numbers; their front; and what cannot be is refused, all at once.
. "$(dirname "$0")/lib.sh"
draws=28
campaign() {  # FILE SEARCH [ACCEPT]
  cat > "$1" << END
{"name": "dome", "pattern": {"family": "miura", "rows": 4, "columns": 4}, "accept": {"deploys_from_deg": ${3:-105}},
 "target": {"surface": "sphere", "radius_mm": 960}, "misalignment": {"vertices": "all", "amplitude_mm": 4, "levels": "uniform"},
 "search": {"method": "shape", $2}, "stop": {"draws": $draws}}
END
}
campaign dome.json '"shape_max_mm": 0.05, "shift_weights": [0.003, 0.03], "turned_diagonals": 1'
search() { "$program" search dome.json --progress none "$@" > out 2> err; }

search --catalogue calm.db || fail "search: $(cat err)"
cat out
sound calm.db $draws
[ "$(sql calm.db 'SELECT (SELECT count(*) FROM ascent) = count(*) AND count(*) BETWEEN 4 AND 27 FROM candidate')" = 1 ] || fail "ends"
[ "$(sql calm.db "SELECT count(*) FROM screened WHERE cause = 'off_shape' AND tested_deg != 90")" = 0 ] || fail "off the shape elsewhere"
"$program" verify calm.db --all --units 100 > out || { fail "verify"; cat out; }
"$program" certify calm.db --best 3 --by shape_rms_mm > out || fail "certify"
[ "$(sql calm.db 'SELECT count(*) = 3 AND min(certified_deg) > 100 FROM certificate')" = 1 ] || fail "an end is not proven: $(cat out)"

# Ranks, registers, other functions of the C library, halves that overlap, and kills at any moment.
for n in 2 3; do
  "${ranks[@]}" $n "$program" search dome.json --progress none --unit-draws $((3 + n)) --catalogue ranks$n.db > /dev/null 2>&1
done
search --catalogue baseline.db --instruction-set baseline
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 "$program" search dome.json --progress none --catalogue library.db > out 2> err
search --catalogue a.db --range 0:17
search --catalogue b.db --range 11:$draws
"$program" merge joined.db b.db a.db > out || { fail "merge"; cat out; }
on_some_ranks() { "${ranks[@]}" $((1 + RANDOM % 3)) "$program" search dome.json --unit-draws 4 "$@"; }
killed_often 3 on_some_ranks
search --catalogue killed.db --max-time 1
sound_so_far killed.db
search --catalogue killed.db
ends_of() { sql "$1" 'SELECT draw, start_value, end_value, steps, sheets_folded, ended FROM ascent' | cksum; }
for file in ranks2 ranks3 baseline library joined killed; do
  sound $file.db $draws
  [ "$(digest_of $file.db)" = "$(digest_of calm.db)" ] || fail "$file: another digest"
  [ "$(ends_of $file.db)" = "$(ends_of calm.db)" ] || fail "$file: other ends"
done

# The distances, against another verb: a shape that begins at the base is about as near.
[ "$("$program" query calm.db "SELECT max(abs(shape_rms_mm(draw) / end_value - 1)) < 1e-6 AND max(shape_max_mm(draw)) <= 0.05 AND
  min(shape_max_mm(draw) >= shape_rms_mm(draw)) AND min(stop_stiffness_mm2_per_rad2(draw)) > 0 AS it FROM candidates" --csv | tail -1)" = 1 ] || fail "distances"
best=$("$program" query calm.db ends --csv 2> /dev/null | sed -n 2p | cut -d, -f1)
[ "$(sql calm.db "SELECT end_value = (SELECT min(end_value) FROM ascent) FROM ascent WHERE draw = $best")" = 1 ] || fail "the best is not the nearest"
"$program" status calm.db | grep -q 'best shape_rms_mm .*, median' || fail "status in words"
"$program" query calm.db --front shape_rms_mm,slope_min_mm_per_deg --csv > front.csv || fail "front"
[ "$(sed -n 2p front.csv | cut -d, -f1)" = "$best" ] || fail "the front begins elsewhere: $(cat front.csv)"
file=$("$program" export calm.db --draw "$best" --output found)
"$program" fold "$file" --json > folded.json && json_test folded.json "json_extract(j, '\$.verdict.deploys_from_deg') >= 105" || fail "D"
for again in '' --again; do
  # shellcheck disable=SC2086
  "$program" replay calm.db "$best" $again --json > "replayed$again.json" || fail "replay $again"
done
cmp -s replayed.json replayed--again.json || fail "made again it is another"

# What was changed in the file is found.
cp calm.db changed.db
sqlite3 changed.db "UPDATE ascent SET end_value = end_value * 1.001 WHERE draw = $best"
"$program" verify changed.db --all > out && fail "a distance that is none"
grep -q "draw $best: ascent.end_value" out || fail "it is not named: $(cat out)"

# The target is of the identity, however its numbers are written.
identity_of() { "$program" status "$1" --json | sed -n 's/.*"identity": "\(.*\)".*/\1/p'; }
sed 's/"radius_mm": 960/"radius_mm": 960.0, "at_deg": 90, "of": "vertices"/' dome.json > same.json
sed 's/"radius_mm": 960/"radius_mm": 961/' dome.json > other.json
"$program" search same.json --draws 1 --progress none --catalogue same.db > /dev/null 2>&1
"$program" search other.json --draws 1 --progress none --catalogue other.db > /dev/null 2>&1
[ "$(identity_of same.db)" = "$(identity_of calm.db)" ] || fail "another identity"
[ "$(identity_of other.db)" != "$(identity_of calm.db)" ] || fail "the same identity"
"$program" search other.json --progress none --catalogue calm.db > out 2> err
[ $? = 5 ] && grep -q '/target/radius_mm' err || fail "another campaign: $(cat err)"

# All that is wrong at once, and nothing is begun.
campaign wrong.json '"shape_max_mm": -1, "shift_weights": [0], "turned_diagonals": 1.5'
sed -i 's/"surface": "sphere"/"surface": "spear"/' wrong.json
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q 'search.shape_max_mm = -1' err && grep -q 'search.shift_weights' err && grep -q 'search.turned_diagonals' err &&
  grep -q 'target.surface' err || fail "faults: $(cat err)"
campaign wrong.json '"turned_diagonals": 0' 90
sed -i 's/"vertices": "all"/"vertices": "ring"/' wrong.json
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q 'target.at_deg = 90' err && grep -q 'misalignment.vertices' err || fail "faults: $(cat err)"
sed 's/"shape", [^}]*}/"plain"}/' dome.json > wrong.json
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q '^.*target.*search among sheets of one shape' err || fail "a target of no shape: $(cat err)"
sed 's/"target": {.*}, "mis/"mis/' dome.json > wrong.json
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q 'target (is missing' err || fail "no target: $(cat err)"
[ ! -e wrong.db ] || fail "something was begun"
finish
