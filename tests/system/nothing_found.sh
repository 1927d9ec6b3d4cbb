# A campaign that accepts nothing says what it learned all the same; and draws with large numbers have
# the rows of the fault sample that the rule gives them.
. "$(dirname "$0")/lib.sh"

sed 's/"rows": 6, "columns": 6/"rows": 10, "columns": 10/; s/"deploys_from_deg": 170/"deploys_from_deg": 175/' \
  "$source_dir/search/campaigns/miura-6x6.json" > ten.json
grep -q '"rows": 10, "columns": 10' ten.json && grep -q '"deploys_from_deg": 175' ten.json || fail "ten.json"
"$program" search ten.json --catalogue ten.db --draws 40000 > out 2> err || { fail "search"; cat err; }
[ "$(sql ten.db 'SELECT sum(accepted) FROM unit')" = 0 ] || fail "something was accepted after all"
[ "$(wc -l < out)" = 1 ] || fail "the summary is one line: $(cat out)"

# Another way to the same angles: the sample's rows in order, the deepest first.
nth() { sql ten.db "SELECT deploys_from_sample FROM fault_sample ORDER BY 1 DESC LIMIT 1 OFFSET $1 - 1"; }
rows=$(sql ten.db 'SELECT count(*) FROM fault_sample')
[ "$rows" = 40 ] || fail "rows of the sample: $rows"
half="half of the draws deploy from $(nth 20) deg"
tenth="one in ten from $(nth 4) deg"
deepest="the largest angle seen is $(nth 1) deg"
"$program" status ten.db > status.txt 2> /dev/null || fail "status"
"$program" query ten.db best > best.txt 2> /dev/null || fail "query best"
for file in err status.txt best.txt; do
  for words in "below 7.5e-05 (3/n, 95 %)" "more than 13333 draws" "$half" "$tenth" "$deepest" "a guess" \
               "accept.deploys_from_deg = " "amplitude_mm" "splitting finds"; do
    grep -qF "$words" "$file" || fail "$file does not say: $words"
  done
done
grep -q "^  accepted from 175 deg  *0 " status.txt || fail "status does not name the threshold: $(cat status.txt)"
grep -q "fold_limit_deg" best.txt && fail "a header without rows: $(cat best.txt)"
for name in tolerant simplest smooth stroke; do
  "$program" query ten.db $name 2> /dev/null | grep -qF "$half" || fail "query $name"
done
[ "$("$program" query ten.db best --json)" = "[]" ] || fail "query --json"
[ "$("$program" query ten.db best --csv | wc -l)" = 1 ] || fail "query --csv"
"$program" query ten.db rejections | grep -q not_monotone || fail "query rejections"

"$program" status ten.db --json > status.json
[ "$(field status.json threshold_deg)" = 175.0 ] || fail "threshold_deg"
[ "$(field status.json survival.sampled)" = 40 ] || fail "survival.sampled"
[ "$(field status.json survival.shares[0].deploys_from_deg)" = "$(nth 20).0" ] || fail "survival.shares"
[ "$(sqlite3 :memory: "SELECT json_extract(readfile('status.json'), '\$.survival.guess_at_threshold.rate')
  BETWEEN 0 AND 3 / 40000.0")" = 1 ] || fail "the guess"
# What it says to try finds some.
try_deg=$(sed -n 's/.*accept.deploys_from_deg = \([0-9.]*\) .*/\1/p' status.txt)
sed "s/\"deploys_from_deg\": 175/\"deploys_from_deg\": $try_deg/" ten.json > try.json
"$program" search try.json --catalogue try.db --draws 8000 --progress none > out || fail "search from $try_deg deg"
[ "$(sql try.db 'SELECT sum(accepted) > 0 FROM unit')" = 1 ] || fail "nothing from $try_deg deg either"
"$program" query try.db best 2> /dev/null | head -1 | grep -q fold_limit_deg || fail "no header over rows"

# Time left is the run's, not the campaign's.
"$program" search ten.json --catalogue left.db --draws 1000000000 --max-time 3 --progress json > out 2> err
grep '"elapsed_s"' err | while read -r line; do
  [ "$(sqlite3 :memory: "SELECT json_extract('$line', '\$.left_s') <= 3")" = 1 ] || echo "$line"
done > too_long
[ -s too_long ] && fail "more time left than the run has: $(cat too_long)"
grep -q '"left_s"' err || fail "no line of progress"

# The fault sample where numbers are large: every draw by the rule as it is written down.
sed 's/"deploys_from_deg": 150/"deploys_from_deg": 180/' "$source_dir/search/campaigns/miura-4x4.json" > 4x4.json
for border in $((1 << 27)) $((1 << 28)) $((1 << 40)); do
  lo=$((border - 2100)) hi=$((border + 4200))
  "$program" search 4x4.json --catalogue large.db --range $lo:$hi --progress none > out || fail "search --range $lo:$hi"
  for ((draw = lo; draw < hi; draw++)); do
    every=1024
    for ((doubling = 1 << 27; doubling <= draw; doubling *= 2)); do every=$((2 * every)); done
    ((draw % every == 0)) && echo "$draw|$every"
  done > expected
  sqlite3 -readonly large.db "SELECT draw, stands_for FROM fault_sample WHERE draw >= $lo AND draw < $hi" > found
  [ -s expected ] && cmp -s expected found || fail "rows about $border: $(diff expected found)"
done
"$program" verify large.db --sample 3 > /dev/null || fail "verify of large numbers"
[ "$("$program" query large.db 'SELECT sum(draws) FROM faults' --csv | tail -1)" = \
  "$(sql large.db 'SELECT sum(stands_for) FROM fault_sample')" ] || fail "view faults"
finish
