# A search by energy: one digest whatever the ranks, kills, order, registers and files; each candidate's energy falls by the
# lengths that `fold` prints, and one that diagonals judge has the digest that it had.
# The long form: energy.sh PROGRAM SOURCE_DIR KILLS [SEED].
. "$(dirname "$0")/lib.sh"
kills_wanted=${3:-4}
RANDOM=${4:-1}
draws=4000
cat > energy.json << END
{"name": "energy", "pattern": {"family": "miura", "rows": 4, "columns": 4},
 "accept": {"by": "energy", "deploys_from_deg": 160, "least_friction_n_mm_per_mm": 0.3}, "stop": {"draws": $draws}}
END
search() { "$program" search energy.json --progress none "$@" > out 2> err; }

search --catalogue calm.db || fail "search: $(cat err)"
sound calm.db $draws
[ "$(sql calm.db 'SELECT count(*) > 20 AND count(*) < 3000 AND min(energy_friction_n_mm_per_mm) >= 0.3
  AND min(energy_deploys_from_deg) >= 160 FROM candidate')" = 1 ] || fail "candidates: $(sql calm.db 'SELECT count(*),
  min(energy_friction_n_mm_per_mm), min(energy_deploys_from_deg) FROM candidate')"
[ "$(sql calm.db 'SELECT count(*) > 0 FROM candidate WHERE reverses_at_deg < 160')" = 1 ] || fail "all diagonals are monotone"
"$program" verify calm.db --units 100 > out || { fail "verify"; cat out; }
"$program" query calm.db strongest --csv > out || fail "query strongest"
best=$(sed -n 2p out | cut -d, -f1)

# Ranks, registers, halves that overlap, and kills at any moment.
"${ranks[@]}" 2 "$program" search energy.json --progress none --unit-draws 300 --catalogue ranks.db > /dev/null 2>&1
search --catalogue baseline.db --instruction-set baseline
search --catalogue a.db --range 0:$((draws / 2 + 500))
search --catalogue b.db --range $((draws / 2 - 500)):$draws
"$program" merge joined.db b.db a.db > out || { fail "merge"; cat out; }
on_two_ranks() { "${ranks[@]}" 2 "$program" search energy.json --unit-draws $((50 + RANDOM % 200)) "$@"; }
killed_often "$kills_wanted" on_two_ranks
search --catalogue killed.db
for file in ranks baseline joined killed; do
  sound $file.db $draws
  [ "$(digest_of $file.db)" = "$(digest_of calm.db)" ] || fail "$file: another digest"
done

# Springs of 50 N/mm: their energy by the lengths that replay prints falls from 160 degrees to flat, and is the one it prints.
"$program" replay calm.db "$best" --json > best.json || fail "replay"
json_test best.json "json_extract(j, '\$.verdict.accepted') = 1 AND json_extract(j, '\$.energy.deploys_from_deg') >= 160" ||
  fail "verdict of $best"
[ "$(sqlite3 :memory: "WITH f AS (SELECT readfile('best.json') AS j),
  e AS (SELECT length.key AS k, 25 * sum((length.value - json_extract(d.value, '\$.flat_mm'))
                                         * (length.value - json_extract(d.value, '\$.flat_mm'))) AS n_mm
        FROM f, json_each(j, '\$.diagonals') AS d, json_each(d.value, '\$.length_mm') AS length GROUP BY 1)
  SELECT count(*) = 160 AND min(n_mm > (SELECT coalesce(max(n_mm), 0) FROM e AS b WHERE b.k = e.k - 1))
     AND max(abs(n_mm - json_extract(j, '\$.energy.energy_n_mm[' || k || ']'))) < 1e-6 FROM e, f WHERE k < 160")" = 1 ] ||
  fail "the energy of $best does not fall"
"$program" replay calm.db "$best" > out
grep -q "energy of springs of 50 N/mm falls to flat from 1[67]" out || { fail "text"; cat out; }

# An exported candidate is judged as its campaign was.
file=$("$program" export calm.db --best 1 --by energy_friction_n_mm_per_mm --output found) || fail "export"
grep -q "$best" <<< "$file" || fail "the strongest is another: $file, $best"
"$program" verify "$file" > out || { fail "verify of an export"; cat out; }
finish
