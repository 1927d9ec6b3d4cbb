# `misalign tolerance` on a real catalogue: what it says, and what it refuses.
. "$(dirname "$0")/lib.sh"
campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 100 --catalogue a.db > /dev/null 2>&1 || fail "search"
draw=$(sql a.db 'SELECT draw FROM candidate ORDER BY slope_min_mm_per_deg DESC LIMIT 1')
field() { sqlite3 :memory: "SELECT json_extract(readfile('$1'), '\$.$2')"; }

"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 300 --json > all.json || fail "tolerance"
[ "$(field all.json trials)" = 300 ] || fail "trials"
[ "$(field all.json deploys_from_deg)" = \
  "$(sql a.db "SELECT deploys_from_deg FROM candidate WHERE draw = $draw")" ] || fail "its own D"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('all.json'), '\$.vertices')")" = 25 ] ||
  fail "every vertex, of the perimeter too"
[ "$(field all.json 'vertices[0].trials')" = 200 ] || fail "trials of one vertex"
low=$(field all.json from_threshold.share_low) share=$(field all.json from_threshold.share)
high=$(field all.json from_threshold.share_high)
[ "$(sqlite3 :memory: "SELECT 0 < $low AND $low < $share AND $share <= $high AND $high <= 1")" = 1 ] ||
  fail "the share and its interval"
"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 300 --json | cmp -s - all.json ||
  fail "another answer the second time"
"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 20 > text || fail "in words"
grep -q "^still from 150" text || fail "the share in words"
[ "$(grep -c '^A[0-9]' text)" = 25 ] || fail "the table"
"$program" tolerance a.db "$draw" --amplitude 0 --trials 20 --json > none.json || fail "no error"
[ "$(field none.json from_own.share)" = 1.0 ] || fail "no error, no loss"

# refused CODE WORDS ARGS...
refused() {
  local code=$1 words=$2
  shift 2
  "$program" tolerance "$@" > out 2> err
  [ $? = "$code" ] || fail "exit code of tolerance $*"
  [ -s out ] && fail "stdout of tolerance $*"
  [ "$(wc -l < err)" = 1 ] || fail "one sentence: tolerance $*"
  grep -q -- "$words" err || fail "no '$words': tolerance $*"
}
rejected=$(sql a.db 'WITH RECURSIVE n(d) AS (SELECT 0 UNION ALL SELECT d + 1 FROM n WHERE d < 99)
  SELECT d FROM n WHERE d NOT IN (SELECT draw FROM candidate) LIMIT 1')
refused 2 "misalign replay" a.db "$rejected" --amplitude 0.05
refused 2 "misalign replay" a.db 123456789 --amplitude 0.05
refused 2 "must be below" a.db "$draw" --amplitude 45
refused 2 "amplitude" a.db "$draw" --amplitude -1
refused 2 "amplitude" a.db "$draw" --amplitude nan
refused 2 "amplitude" a.db "$draw"
refused 2 "trials" a.db "$draw" --amplitude 0.05 --trials 0
refused 3 "no such file" nothing.db "$draw" --amplitude 0.05
finish
