# Every query of the cookbook on a real catalogue, and pages of the manual that are what the program says.
. "$(dirname "$0")/lib.sh"
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 20000 --progress none \
  > /dev/null || fail "search"
file=$(ls results/*.db)
cookbook=$source_dir/schema/queries/README.md
mkdir queries
awk '/^## [0-9]+\. /{n = $2 + 0} /^```$/{sql = 0} sql{print > ("queries/" n ".sql")} /^```sql$/{sql = 1}' "$cookbook"
[ "$(grep -c '^## [0-9]*\. .*?$' "$cookbook")" = 10 ] || fail "there are not ten questions"
for n in 1 2 3 4 5 6 7 8 9 10; do
  "$program" query "$file" "$(cat "queries/$n.sql")" --json > rows.json || fail "query $n"
  rows=$(sqlite3 :memory: "SELECT json_array_length(readfile('rows.json'))")
  [ "$rows" -gt 0 ] || fail "query $n has no rows"
done
named=$("$program" query "$file" --help | sed -n 's/^ *Named queries: //p')
[ -n "$named" ] || fail "the help names no queries"

# The Pareto front, the long way.
"$program" query "$file" "$(cat queries/3.sql)" --csv | tail -n +2 | cut -d, -f1 | sort > front
sql "$file" 'SELECT draw FROM candidates c WHERE miscut_margin_mm IS NOT NULL AND NOT EXISTS (
  SELECT 1 FROM candidates o WHERE o.deploys_from_deg >= c.deploys_from_deg
    AND o.miscut_margin_mm >= c.miscut_margin_mm
    AND (o.deploys_from_deg > c.deploys_from_deg OR o.miscut_margin_mm > c.miscut_margin_mm))' |
  sort > expected
cmp -s front expected || fail "the Pareto front: $(tr '\n' ' ' < front), expected $(tr '\n' ' ' < expected)"

"$program" query "$file" --front deploys_from_deg,miscut_margin_mm --csv | tail -n +2 | cut -d, -f1 | sort > front
cmp -s front expected || fail "--front: $(tr '\n' ' ' < front)"
# Of three, of which less is better in one, where a condition holds; some have no slope.
"$program" query "$file" --front "stroke_max, slope_min_mm_per_deg, miscut_margin_mm" --where "deploys_from_deg < 170" --csv | tail -n +2 | cut -d, -f1 | sort > front
sql "$file" 'WITH some AS (SELECT * FROM candidates WHERE deploys_from_deg < 170 AND slope_min_mm_per_deg IS NOT NULL
  AND miscut_margin_mm IS NOT NULL) SELECT draw FROM some c WHERE NOT EXISTS (SELECT 1 FROM some o WHERE o.stroke_max <= c.stroke_max
  AND o.slope_min_mm_per_deg >= c.slope_min_mm_per_deg AND o.miscut_margin_mm >= c.miscut_margin_mm AND (o.stroke_max < c.stroke_max
  OR o.slope_min_mm_per_deg > c.slope_min_mm_per_deg OR o.miscut_margin_mm > c.miscut_margin_mm))' | sort > expected
[ "$(wc -l < expected)" -gt 3 ] && cmp -s front expected || fail "--front of three: $(tr '\n' ' ' < front)"
# Functions of sheets are found as elsewhere, also from an angle of one's own.
"$program" query "$file" --front "critical_friction_n_mm_per_mm(draw, 30),D" --where "draw < 40" --json > rows.json || fail "--front of a function"
json_test rows.json "json_array_length(j) > 0 AND json_extract(j, '\$[0].D') >= 150" || fail "--front of a function: $(cat rows.json)"
for wrong in "strok,D" "D,-stroke_max" ""; do
  "$program" query "$file" --front "$wrong" > out 2> err && fail "--front '$wrong'"
  grep -q "is no column or function of a candidate" err || fail "--front '$wrong': $(cat err)"
done
"$program" query "$file" best --front D > out 2> err && fail "--front of a query"
"$program" query "$file" --where "D > 170" > out 2> err && fail "--where without a front"

# The keys of a campaign as the schema says them.
"$program" config --keys > keys.md || fail "config --keys"
for key in pattern.rows misalignment.amplitude_mm accept.deploys_from_deg actuators.stroke_limit stop.wall_s; do
  grep -q "^| \`$key\` |" keys.md || fail "config --keys: no $key"
done
sed -n '/^| key/,$p' "$source_dir/search/campaigns/README.md" | sed '/^$/,$d' > written.md
cmp -s keys.md written.md ||
  fail "search/campaigns/README.md is not what \`misalign config --keys\` prints; paste it there"
python3 "$source_dir/scripts/site/reference.py" "$program" || fail "pages of the reference"
finish
