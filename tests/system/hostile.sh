# Catalogues and arguments made to harm, and answers that are larger than the memory.
. "$(dirname "$0")/lib.sh"
quick_campaign quick.json
search() { "$program" search quick.json --progress none "$@" > out 2> err; }
search --catalogue a.db --draws 2000 || fail "a search"

# refused CODE WORDS COMMAND...
refused() {
  local code=$1 words=$2 got
  shift 2
  timeout $patience_s "$@" > out 2> err
  got=$?
  [ $got = "$code" ] || { fail "$*: exit $got"; cat err; }
  grep -q -- "$words" err || { fail "$*: no '$words'"; cat err; }
}

# A trigger that makes the campaign complete; every verb names it.
cp a.db b.db
sqlite3 b.db 'CREATE TRIGGER quiet AFTER INSERT ON unit BEGIN UPDATE campaign SET goal_end = 0; END'
words='trigger quiet on unit is foreign'
refused 3 "$words" "$program" status b.db --check
refused 3 "$words" "$program" search quick.json --catalogue b.db --draws 3000 --progress none
refused 3 "$words" "$program" verify b.db
refused 3 "$words" "$program" merge c.db a.db b.db
refused 3 "$words" "$program" query b.db best
refused 3 "$words" "$program" report b.db --output b.html
refused 3 "$words" "$program" export b.db --best 1 --format json --output exported
[ ! -e c.db ] && [ ! -e b.html ] || fail "something was written from b.db"

# SQL of one's own: no function that knows addresses; a condition stands by itself.
refused 2 'fts3_tokenizer' "$program" query a.db "SELECT hex(fts3_tokenizer('simple'))"
for where in '1)/*' "1) UNION SELECT 1 --" '1; DROP TABLE unit' 'SELECT 1' "draw = '" '1 ORDER BY draw'; do
  refused 2 'is no condition' "$program" export a.db --where "$where" --format json --output exported
done
"$program" export a.db --where "draw < 100 -- the first (few" --format json --output exported > out 2> err ||
  fail "a condition with a comment"

# A quoted name that is no column is no text, which would be larger than any number.
refused 2 '"D"' "$program" export a.db --where '"D" > 999' --format json --output exported
# Functions of sheets that are asked for without an end, with 200 MB more than the program needs.
n="WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n)"
rm -rf exported
(ulimit -v 1500000
 timeout $patience_s "$program" query a.db "$n SELECT k FROM n WHERE energy_n_mm(k) > 0 LIMIT 1" --csv > out 2> err) ||
  fail "a query whose functions say nothing ahead: $(cat err)"
(ulimit -v 1500000
 timeout $patience_s "$program" export a.db --format json --output exported --where \
   "draw < 20 AND ($n SELECT k FROM n WHERE energy_n_mm(k) > 0 LIMIT 1) > 0" > out 2> err) ||
  fail "a condition whose functions say nothing ahead: $(cat err)"
rm -rf exported

# A name is a name.
for name in :memory: 'file:x?mode=memory'; do
  search --catalogue "$name" --draws 500 || { fail "--catalogue $name"; cat err; }
  [ "$(sql "./$name" 'SELECT sum(draws) FROM unit')" = 500 ] || fail "$name was lost"
done
ln a.db twin.db
refused 1 'has 2 names' "$program" search quick.json --catalogue twin.db --draws 3000 --progress none
rm twin.db

# A configuration that names a pipe, which nobody writes to.
cp a.db pipe.db
mkfifo fifo
sqlite3 pipe.db "UPDATE campaign SET configuration = json_set(configuration, '\$.pattern',
  json('{\"family\": \"fold\", \"file\": \"fifo\"}'))"
for verb in verify "replay DRAW" "report --output x.html"; do
  read -r name rest <<< "$verb"
  refused 3 'no other file is opened' "$program" "$name" pipe.db ${rest/DRAW/1}
done

# Another sheet than that of the rows: large, and it is said instead of folded.
cp a.db large.db
sqlite3 large.db "UPDATE campaign SET configuration = json_set(configuration, '\$.pattern.rows', 40, '\$.pattern.columns', 40)"
timeout $patience_s "$program" verify large.db > out 2> err
[ $? = 6 ] && grep -q "campaign: identity" out && grep -q "candidates   0 of" out || fail "another sheet: $(cat out err)"

# A million rows through 60 MB more than the program needs to start with.
rows="WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n WHERE k < 1000000)
  SELECT k, 'some text beside the number, so that it is more than a few bytes' AS t FROM n"
for style in --csv --json --no-pager; do
  (
    "$program" query a.db 'SELECT 1' > /dev/null &
    wait $!
    ulimit -v 600000
    "$program" query a.db "$rows" $style 2> err | tail -n 5 | grep -q 1000000
  ) || { fail "a million rows, $style"; cat err; }
done
finish
