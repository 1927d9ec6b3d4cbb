# An optimising search: one digest whatever the ranks, kills, order, registers, files and functions of the C library;
# ends that keep what is asked by other verbs' numbers, proven; and what cannot be is refused.
# The long form: optimising.sh PROGRAM SOURCE_DIR KILLS [SEED].
. "$(dirname "$0")/lib.sh"
kills_wanted=${3:-3}
RANDOM=${4:-1}
draws=$((8 * kills_wanted))
campaign() {  # FILE SEARCH
  cat > "$1" << END
{"name": "better", "pattern": {"family": "miura", "rows": 4, "columns": 4}, "accept": {"deploys_from_deg": 150},
 "search": {"method": "optimise", $2}, "stop": {"draws": $draws}}
END
}
campaign better.json '"from_deg": 36, "subject_to": ["stroke_max <= 0.06", "miscut_margin_mm >= 0.005"]'
search() { "$program" search better.json --progress none "$@" > out 2> err; }

search --catalogue calm.db || fail "search: $(cat err)"
cat out
sound calm.db $draws
[ "$(sql calm.db 'SELECT (SELECT count(*) FROM ascent) = count(*) AND count(*) > 4 FROM candidate')" = 1 ] || fail "ascents"
[ "$(sql calm.db "SELECT count(*) > 3 AND min(end_value > start_value) FROM ascent WHERE steps > 0")" = 1 ] || fail "nothing is better"
"$program" verify calm.db --all --units 100 > out || { fail "verify"; cat out; }
"$program" certify calm.db --all > out || fail "certify"
[ "$(sql calm.db 'SELECT min(certified_deg) >= 150 FROM certificate JOIN ascent USING (draw) WHERE steps > 0')" = 1 ] ||
  fail "an end is not proven"
"$program" certify calm.db --best 3 --by end_value --check > out || { fail "a proof is none"; cat out; }

# Ranks, registers, other functions of the C library, halves that overlap, and kills at any moment.
for n in 2 3; do
  "${ranks[@]}" $n "$program" search better.json --progress none --unit-draws $((3 + n)) --catalogue ranks$n.db > /dev/null 2>&1
done
search --catalogue baseline.db --instruction-set baseline
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 "$program" search better.json --progress none --catalogue library.db > out 2> err
search --catalogue a.db --range 0:$((draws / 2 + 5))
search --catalogue b.db --range $((draws / 2 - 5)):$draws
"$program" merge joined.db b.db a.db > out || { fail "merge"; cat out; }
on_some_ranks() { "${ranks[@]}" $((1 + RANDOM % 3)) "$program" search better.json --unit-draws 4 "$@"; }
killed_often "$kills_wanted" on_some_ranks
# A signal hands in what is done, and drops the block that is on its way.
search --catalogue killed.db --max-time 1
sound_so_far killed.db
search --catalogue killed.db
same_as() {  # ONE DRAWS FILE...: sheets and ways
  local one=$1 draws=$2 file
  shift 2
  for file; do
    sound "$file.db" "$draws"
    [ "$(digest_of "$file.db")" = "$(digest_of "$one.db")" ] || fail "$file: another digest"
    [ "$(ways_of "$file.db")" = "$(ways_of "$one.db")" ] || fail "$file: other ways"
  done
}
ways_of() { sql "$1" 'SELECT draw, start_value, end_value, steps, sheets_folded, ended, limited_by FROM ascent' | cksum; }
same_as calm "$draws" ranks2 ranks3 baseline library joined killed

# The best end as a file, by other verbs.
best=$("$program" query calm.db ends --csv 2> /dev/null | sed -n 2p | cut -d, -f1)
end_value=$(sql calm.db "SELECT end_value FROM ascent WHERE draw = $best")
file=$("$program" export calm.db --best 1 --by end_value --output found)
grep -q "$best" <<< "$file" || fail "the best is another: $file, $best"
"$program" deploy "$file" --from 36 --stiffness 50 --json > let_go.json || fail "deploy"
"$program" fold "$file" --json > folded.json || fail "fold"
json_test let_go.json "abs(json_extract(j, '\$.critical_friction_n_mm_per_mm') / $end_value - 1) < 1e-9" || fail "worth something else"
json_test folded.json "json_extract(j, '\$.verdict.deploys_from_deg') >= 150" || fail "D"
json_test folded.json "(SELECT max(abs(l.value / json_extract(d.value, '\$.flat_mm') - 1)) <= 0.06 FROM json_each(j, '\$.diagonals') d,
  json_each(d.value, '\$.length_mm') l WHERE l.key < 150)" || fail "a longer stroke"
[ "$(sql calm.db "SELECT miscut_margin_mm >= 0.005 FROM candidates WHERE draw = $best")" = 1 ] || fail "a smaller margin"
# From the draw once more, and as it is stored; a draw that is not accepted is its own.
for again in '' --again; do
  # shellcheck disable=SC2086
  "$program" replay calm.db "$best" $again --json > "replayed$again.json" || fail "replay $again"
done
cmp -s replayed.json replayed--again.json || fail "made again it is another"
other=$(sql calm.db "WITH RECURSIVE n(k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n WHERE k < $draws - 1)
  SELECT min(k) FROM n WHERE k NOT IN (SELECT draw FROM candidate)")
"$program" replay calm.db "$other" > out && grep -q 'not accepted' out || fail "a draw that is rejected"
"$program" status calm.db --json > state.json
json_test state.json "abs(json_extract(j, '\$.ends.best') - $end_value) < 1e-12" || fail "status"
"$program" status calm.db | grep -q 'best critical_friction_n_mm_per_mm .*, median' || fail "status in words"

"$program" status calm.db --at 160 > out 2> err
[ $? = 2 ] && grep -q 'optimises its draws' err || fail "a rate of draws from their ends: $(cat err)"

# What was changed in the file is found.
cp calm.db changed.db
sqlite3 changed.db "UPDATE ascent SET end_value = end_value * 1.001 WHERE draw = $best"
"$program" verify changed.db --all > out && fail "a value that is none"
grep -q "draw $best: ascent.end_value" out || fail "it is not named: $(cat out)"

# Other goals and shifts.
for way in '"maximise": "energy_n_mm", "from_deg": 36' '"maximise": "miscut_margin_mm"' '"from_deg": 36, "shifts": "ternary"' '"from_deg": 36, "grid_mm": 0.1, "preload_n": 0.1'; do
  campaign other.json "$way"
  "$program" search other.json --draws 12 --progress none --catalogue other.db > /dev/null 2> err || fail "$way: $(cat err)"
  "$program" verify other.db --all --units 100 > out || { fail "$way"; cat out; }
  [ "$(sql other.db 'SELECT count(*) > 1 AND max(end_value > 1.1 * start_value) FROM ascent')" = 1 ] || fail "$way: nothing is better"
  rm other.db
done

# Starts that populations find: the same sheets as a splitting search finds, and one digest whatever the ranks, kills,
# halves and signals.
populations=$((2 * kills_wanted))
climbing() {  # FILE METHOD
  cat > "$1" << END
{"name": "found", "pattern": {"family": "miura", "rows": 4, "columns": 4}, "accept": {"deploys_from_deg": 175},
 "search": {"particles": 50, "sweeps": 3, "first_draws": 500, "method": $2}, "stop": {"populations": $populations}}
END
}
climbing found.json '"optimise", "starts": "splitting", "starts_of_population": 4, "from_deg": 36, "subject_to": ["stroke_max <= 0.05"]'
climbing splitting.json '"splitting"'
climb() { "$program" search found.json --progress none "$@" > out 2> err; }
climb --catalogue found.db || fail "search from what populations find: $(cat err)"
cat out
sound found.db ${populations}0000000000
"$program" search splitting.json --progress none --catalogue plain.db > /dev/null 2> err || fail "splitting: $(cat err)"
[ "$(sql found.db "ATTACH 'plain.db' AS plain; SELECT count(*) > 0 AND min(hash IN (SELECT hash FROM plain.sheet))
  FROM ascent JOIN sheet USING (draw) WHERE ended = 'breaks_a_limit' AND start_value IS NULL")" = 1 ] || fail "starts of no population"
[ "$(sql found.db "SELECT count(*) > 3 AND min(end_value > start_value) FROM ascent WHERE steps > 0")" = 1 ] || fail "nothing is better"
[ "$(sql found.db "SELECT sum(starts) = 4 * $populations FROM ends")" = 1 ] || fail "a start without an end"
"$program" verify found.db --all --units 100 > out || { fail "verify"; cat out; }
"$program" certify found.db --all > out || fail "certify"
[ "$(sql found.db 'SELECT min(certified_deg) >= 175 FROM certificate JOIN ascent USING (draw) WHERE steps > 0')" = 1 ] ||
  fail "an end is not proven"
for n in 2 3; do
  "${ranks[@]}" $n "$program" search found.json --progress none --catalogue found$n.db > /dev/null 2>&1
done
climb --catalogue low.db --range 0:$((populations / 2 + 2))
climb --catalogue high.db --range $((populations / 2 - 1)):$populations
"$program" merge halves.db high.db low.db > out || { fail "merge"; cat out; }
rm -f killed.db*
climb_on_some_ranks() { "${ranks[@]}" $((1 + RANDOM % 3)) "$program" search found.json "$@"; }
killed_often "$kills_wanted" climb_on_some_ranks
climb --catalogue killed.db --max-time 1
sound_so_far killed.db
climb --catalogue killed.db
same_as found ${populations}0000000000 found2 found3 halves killed
best=$("$program" query found.db ends --csv 2> /dev/null | sed -n 2p | cut -d, -f1)
for again in '' --again; do
  # shellcheck disable=SC2086
  "$program" replay found.db "$best" $again --json > "replayed$again.json" || fail "replay $again"
done
cmp -s replayed.json replayed--again.json || fail "made again it is another"
"$program" replay found.db 1 > out 2> err
[ $? = 2 ] && grep -q 'no candidate' err || fail "a number of no candidate: $(cat err)"
"$program" status found.db | grep -q 'best critical_friction_n_mm_per_mm .*, median' || fail "status in words"
"$program" export found.db --best 1 --by end_value --output found-best | grep -q "$best" || fail "export"
cp found.db changed.db
sqlite3 changed.db "UPDATE ascent SET start_value = start_value * 0.9 WHERE draw = $best"
"$program" verify changed.db --units 100 > out && fail "a start's value that is none"
grep -q "draw $best: ascent.start_value" out || fail "it is not named: $(cat out)"

# All that is wrong at once, and nothing is begun.
campaign wrong.json '"maximise": "friction", "subject_to": ["stroke <= 0.1", "stroke_max >= 0.1"], "shifts": "ternarry"'
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q 'search.maximise' err && grep -q 'did you mean stroke_max' err && grep -q 'needs an upper bound' err &&
  grep -q 'search.shifts' err || fail "faults: $(cat err)"
[ ! -e wrong.db ] || fail "something was begun"
campaign wrong.json '"maximise": "static_friction_n_mm_per_mm"'
"$program" search wrong.json --catalogue wrong.db > out 2> err
[ $? = 3 ] && grep -q 'misalign optimise' err || fail "a goal of single sheets: $(cat err)"
finish
