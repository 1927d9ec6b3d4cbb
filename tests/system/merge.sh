# A campaign split over machines that share nothing, joined; and what does not fit is refused.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
search() { "$program" search $campaign --progress none "$@" > /dev/null 2>&1; }
search --catalogue whole.db --draws 6000 || fail "the whole"
expected=$(digest_of whole.db)
search --catalogue a.db --range 0:2000 --unit-draws 300 || fail "0:2000"
search --catalogue b.db --range 2000:4100 --unit-draws 500 || fail "2000:4100"
search --catalogue c.db --range 4000:6000 --unit-draws 700 || fail "4000:6000"

"$program" merge all.db a.db b.db c.db > out || fail "merge"
cat out
sound all.db 6000
[ "$(digest_of all.db)" = "$expected" ] || fail "joined: another digest"
"$program" status all.db --check > /dev/null || fail "joined: not complete"
"$program" verify all.db --sample 50 > /dev/null || fail "joined: verify"
[ "$(ls all.db*)" = all.db ] || fail "files beside the joined one: $(ls all.db*)"
# And on it goes from there, as from any catalogue.
search --catalogue all.db --draws 6500 || fail "a search goes on"
search --catalogue whole.db --draws 6500
[ "$(digest_of all.db)" = "$(digest_of whole.db)" ] || fail "gone on: another digest"

# While a search writes one of them.
"$program" search $campaign --catalogue live.db --range 6000:1000000 --progress none > /dev/null 2>&1 &
search=$!
begun live.db unit
"$program" merge both.db a.db live.db > /dev/null || fail "merge of a catalogue in use"
kill -TERM $search
wait $search
sound_so_far both.db

# refused CODE WORDS IN...: exit code, a sentence with these words, and no output.
refused() {
  local code=$1 words=$2
  shift 2
  "$program" merge no.db "$@" > /dev/null 2> err
  local got=$?
  [ $got = "$code" ] || { fail "exit $got, not $code: $*"; cat err; }
  grep -q -- "$words" err || { fail "no '$words': $*"; cat err; }
  ls no.db* 2> /dev/null && fail "something was written: $*"
}
cp b.db wrong.db
sqlite3 wrong.db 'UPDATE candidate SET deploys_from_sample = 22 WHERE draw = (SELECT min(draw) FROM candidate)'
refused 6 "digest_part" a.db wrong.db
cp c.db wrong.db
sqlite3 wrong.db "UPDATE candidate SET displacements_mm = '{}' WHERE draw = (SELECT min(draw) FROM candidate)"
refused 6 "draw 4000: displacements_mm is" b.db wrong.db
search --catalogue seed.db --seed 9 --draws 50
refused 5 "/seed" a.db seed.db
head -c 5000 a.db > cut.db
refused 3 "cut.db" a.db cut.db
refused 3 "no such file" a.db nowhere.db
"$program" merge all.db a.db > /dev/null 2> err
[ $? = 2 ] && grep -q "exists already" err || fail "an output that exists"

"$program" doctor > out || fail "doctor"
grep -q "golden verdicts" out || fail "doctor says nothing of verdicts"
"$program" doctor nowhere > /dev/null && fail "doctor of a place that is not there"
"${ranks[@]}" 2 "$program" doctor --json > out || fail "doctor with two ranks"
[ "$(sqlite3 :memory: "SELECT json_extract(readfile('out'), '\$.good')")" = 1 ] || fail "doctor --json"
finish
