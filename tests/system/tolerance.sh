# `misalign tolerance` on a real catalogue: what it says, what it keeps, and what it refuses.
. "$(dirname "$0")/lib.sh"
campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 100 --catalogue a.db > /dev/null 2>&1 || fail "search"
draw=$(sql a.db 'SELECT draw FROM candidate ORDER BY slope_min_mm_per_deg DESC LIMIT 1')
before=$(digest_of a.db)

"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 300 --vertices --json > all.json ||
  fail "tolerance"
[ "$(field all.json trials)" = 300 ] || fail "trials"
[ "$(field all.json draw)" = "$draw" ] || fail "its draw"
[ "$(field all.json deploys_from_deg)" = \
  "$(sql a.db "SELECT deploys_from_deg FROM candidate WHERE draw = $draw")" ] || fail "its own D"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('all.json'), '\$.vertices')")" = 25 ] ||
  fail "every vertex, of the perimeter too"
[ "$(field all.json 'vertices[0].trials')" = 200 ] || fail "trials of one vertex"
low=$(field all.json from_threshold.share_low) share=$(field all.json from_threshold.share)
high=$(field all.json from_threshold.share_high)
[ "$(sqlite3 :memory: "SELECT 0 < $low AND $low < $share AND $share <= $high AND $high <= 1")" = 1 ] ||
  fail "the share and its interval"
for jobs in 1 3; do
  "$program" tolerance a.db "$draw" --amplitude 0.05 --trials 300 --vertices --jobs $jobs --json |
    cmp -s - all.json || fail "another answer with $jobs threads"
done
"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 20 --vertices > text || fail "in words"
tail -1 text | grep -q "^yield from 150" || fail "the answer is not the last line"
[ "$(grep -c '^A[0-9]' text)" = 25 ] || fail "the table"
"$program" tolerance a.db "$draw" --amplitude 0.05 --trials 20 > text || fail "without vertices"
grep -q '^A[0-9]' text && fail "vertices that nobody asked for"
"$program" tolerance a.db "$draw" --amplitude 0 --trials 20 --no-keep --json > none.json ||
  fail "no error"
[ "$(field none.json from_own.share)" = 1.0 ] || fail "no error, no loss"

# Joints with play: nothing of that is kept.
"$program" tolerance a.db "$draw" --backlash 0.01 --trials 40 --json > loose.json || fail "backlash"
[ "$(field loose.json one_way.trials)" -le 40 ] || fail "trials that move one way"
[ "$(sqlite3 :memory: "SELECT $(field loose.json largest.backlash_mm) BETWEEN 1e-5 AND 1")" = 1 ] ||
  fail "the largest backlash"
"$program" tolerance a.db "$draw" --backlash 0.01 --trials 40 --jobs 3 --json | cmp -s - loose.json ||
  fail "another backlash with 3 threads"
"$program" tolerance a.db "$draw" --backlash 0.01 --trials 20 > text || fail "backlash in words"
tail -1 text | grep -q "^95 % clearance .* mm, from 5 to .* deg$" || fail "the largest backlash comes last: $(tail -1 text)"
"$program" tolerance a.db --best 2 --backlash 0.01 --backlash-from 30 --trials 10 > text || fail "of two"
[ "$(grep -c '^draw ' text)" = 2 ] || fail "a line for each: $(cat text)"

# What was found is kept: that with the most trials.
[ "$(sql a.db 'SELECT draw, amplitude_mm, trials FROM yield')" = "$draw|0.05|300" ] || fail "kept"
[ "$(sql a.db 'SELECT share FROM yields')" = "$share" ] || fail "the share that is kept"
[ "$(digest_of a.db)" = "$before" ] || fail "the digest changed"
"$program" verify a.db --sample 1 > /dev/null || fail "verify"

# Several at once, and then sorted by what was found.
"$program" tolerance a.db --best 5 --by miscut_margin_mm --amplitude 0.05 --trials 60 --json \
  > some.json || fail "the best five"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('some.json'))")" = 5 ] || fail "a list"
"$program" tolerance a.db --where "slope_min_mm_per_deg > 0" --amplitude 0.05 --trials 60 > text ||
  fail "those of a condition"
head -1 text | grep -q "most tolerant last" || fail "a table: $(head -1 text)"
all=$(sql a.db 'SELECT count(*) FROM candidate')
[ "$(grep -c '^draw ' text)" = "$all" ] || fail "a line for each"
[ "$(sql a.db 'SELECT count(*) FROM yield WHERE trials = 60')" = $((all - 1)) ] || fail "all are kept"
first=$(sql a.db 'SELECT draw FROM yields ORDER BY share DESC, draw LIMIT 1')
"$program" export a.db --best 1 --by yield --output out > /dev/null || fail "export --by yield"
exported=$(ls out/*.json)
share_of() { sql a.db "SELECT share FROM yield WHERE draw = $1"; }
[ "$(share_of "$(field "$exported" draw)")" = "$(share_of "$first")" ] || fail "the best by yield"
[ "$(field "$exported" 'yields[0].share')" = "$(share_of "$first")" ] || fail "exported yields"
"$program" query a.db yields > rows && [ "$(wc -l < rows)" -gt 5 ] || fail "query yields"
"$program" query a.db tolerant > rows && grep -q yield rows || fail "query tolerant"
"$program" query a.db robust > /dev/null 2> err
[ $? = 2 ] && grep -q "did you mean tolerant" err || fail "the former name: $(cat err)"

# As verify finds it: 2 of 1 trials.
cp a.db wrong.db
sqlite3 wrong.db \
  "PRAGMA ignore_check_constraints = ON; UPDATE yield SET survivors = trials + 1 WHERE draw = $draw"
"$program" verify wrong.db --sample 1 > findings
[ $? = 6 ] && grep -q "yield.survivors" findings || fail "verify: more survivors than trials"

# Where the catalogue cannot be written the answer is there all the same, and why it is not kept.
"$program" search "$campaign" --draws 100000000 --catalogue busy.db > /dev/null 2>&1 &
searching=$!
begun busy.db candidate
there=$(sql busy.db 'SELECT draw FROM candidate LIMIT 1')
"$program" tolerance busy.db "$there" --amplitude 0.05 --trials 20 > text 2> err || fail "in use"
kill $searching
wait $searching 2> /dev/null
tail -1 text | grep -q "^yield from 150" || fail "no answer while another one writes"
[ "$(grep -c "not kept.*another search is writing" err)" = 1 ] || fail "why it is not kept: $(cat err)"

# What takes the catalogue's place while copies are judged is said, and nothing else is put there.
cp a.db away.db
"$program" search "$campaign" --draws 1 --catalogue other.db > /dev/null 2>&1
for other in "" other.db; do
  cp away.db moved.db
  rm -f err  # stopped while it judges
  "$program" tolerance moved.db "$draw" --amplitude 0.06 --trials 60000 --jobs 1 --log-level debug > text 2> err &
  judging=$!
  eventually "copies judged" grep -q "copies judged" err
  kill -STOP $judging || fail "too quick to be disturbed: more trials"
  rm moved.db
  [ -n "$other" ] && cp "$other" moved.db
  kill -CONT $judging
  wait $judging || fail "the catalogue is gone, and so is the answer"
  tail -1 text | grep -q "^yield from 150" || fail "no answer without the catalogue"
  [ "$(grep -c "not kept.*any more" err)" = 1 ] || fail "why it is not kept: $(cat err)"
  if [ -n "$other" ]; then
    [ "$(sql moved.db 'SELECT count(*) FROM yield')" = 0 ] || fail "kept in another catalogue"
  else
    [ -e moved.db ] && fail "an empty catalogue in the former one's place"
  fi
done

# An older catalogue is brought up to date, a copy of it kept.
cp "$source_dir/tests/fixtures/catalogue-7.db" old.db
old=$(sql old.db 'SELECT draw FROM candidate LIMIT 1')
"$program" tolerance old.db "$old" --amplitude 0.05 --trials 20 > /dev/null || fail "an older one"
[ "$(sql old.db 'SELECT trials FROM yield')" = 20 ] || fail "an older one keeps nothing"
[ -s old.db.version-7 ] || fail "an older one was not copied"

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
rm -rf out
rejected=$(sql a.db 'WITH RECURSIVE n(d) AS (SELECT 0 UNION ALL SELECT d + 1 FROM n WHERE d < 99)
  SELECT d FROM n WHERE d NOT IN (SELECT draw FROM candidate) LIMIT 1')
refused 2 "misalign replay" a.db "$rejected" --amplitude 0.05
refused 2 "misalign replay" a.db 123456789 --amplitude 0.05
refused 2 "must be below .* a facet of draw $draw can lose convexity); try [0-9.]*$" a.db "$draw" --amplitude 45
# What it says to try is nearly the largest, and can be had.
read -r below try <<< "$(sed -E 's/.*must be below ([0-9.]*) mm.*; try ([0-9.]*)$/\1 \2/' err)"
"$program" tolerance a.db "$draw" --amplitude "$try" --trials 10 > out 2> err || fail "--amplitude $try: $(cat err)"
awk "BEGIN { exit !($try < $below && $try > 0.85 * $below) }" || fail "--amplitude: below $below, try $try"
refused 2 "amplitude" a.db "$draw" --amplitude -1
refused 2 "amplitude" a.db "$draw" --amplitude nan
refused 2 "amplitude" a.db "$draw"
refused 2 "no error is named" a.db "$draw"
refused 2 "excludes" a.db "$draw" --backlash 0.01 --amplitude 0.05
refused 2 "excludes" a.db "$draw" --backlash 0.01 --vertices
refused 2 "excludes" a.db "$draw" --backlash 0.01 --friction 0.01
# A stop: what copies have in their holes is checked, and is that of the sheet itself.
refused 3 "is no hole of this sheet" a.db "$draw" --amplitude 0.05 \
  --fill '{"kind": "plate", "rest_deg": 20, "cut_outs": [{"hole": [0, 0], "of_flat": [1, 1]}]}'
refused 2 "give one of the two" a.db "$draw" --amplitude 0.05 --fill '{"kind": "springs", "rest_deg": 20, "preload_n": 1}'
"$program" tolerance a.db "$draw" --amplitude 0.000001 --rest-deg 20 --trials 10 --no-keep > out 2> err
grep -q "^stops at          20 deg; of 10 copies 10 stop, 0 unfold flat$" out || fail "a stop: $(cat out err)"
refused 2 "requires --backlash" a.db "$draw" --amplitude 0.05 --backlash-from 10
refused 2 "is not a number" a.db "$draw" --backlash 0
refused 2 "is not a number" a.db "$draw" --backlash nan
refused 2 "must be below [78].* mm (a tenth of the shortest crease of draw $draw.*try 0.008$" a.db "$draw" --backlash 45
refused 2 "must be below .* deg (where the range of angles of draw $draw ends)" a.db "$draw" --backlash 0.01 --backlash-from 179
refused 2 "is not a number" a.db "$draw" --backlash 0.01 --backlash-from 0
refused 2 "at most 1000000 with --backlash" a.db "$draw" --backlash 0.01 --trials 2000000
refused 2 "trials" a.db "$draw" --amplitude 0.05 --trials 0
refused 2 "no candidates are chosen" a.db --amplitude 0.05
refused 2 "no meaning without" a.db "$draw" --by stroke_min --amplitude 0.05
refused 2 "excludes" a.db "$draw" --best 2 --amplitude 0.05
refused 3 "no such file" nothing.db "$draw" --amplitude 0.05
finish
