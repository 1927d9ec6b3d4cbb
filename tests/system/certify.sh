# `misalign certify` on a real catalogue: the same certificates whoever makes them and however often that is
# interrupted, and none that was spoilt passes.
# The long form: certify.sh PROGRAM SOURCE_DIR KILLS [SEED].
. "$(dirname "$0")/lib.sh"
kills_wanted=${3:-1}
RANDOM=${4:-1}
campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 200 --catalogue a.db --progress none > /dev/null 2>&1 || fail "search"
candidates=$(sql a.db 'SELECT count(*) FROM candidate')
[ "$candidates" -gt 60 ] || fail "too few candidates: $candidates"
digest=$(digest_of a.db)
for copy in ranks-1 ranks-2 ranks-3 killed asked; do cp a.db $copy.db; done

# rows FILE: every column but the seconds.
rows() {
  sql "$1" 'SELECT draw, certified_deg, asked_deg, ended, place, contact, intervals, hash, hex(proof)
            FROM certificate ORDER BY draw' | cksum
}
count() { sql "$1" 'SELECT count(*) FROM certificate'; }

# One, some, all: those that are there are not made again.
draw=$(sql a.db 'SELECT min(draw) FROM candidate')
"$program" certify a.db "$draw" --json > one.json || fail "one"
[ "$(field one.json draw)" = "$draw" ] || fail "its draw"
[ "$(field one.json asked_deg)" = "$(sql a.db "SELECT deploys_from_deg FROM candidate WHERE draw = $draw")" ] ||
  fail "its own D"
[ "$(field one.json certified_deg)" = "$(sql a.db "SELECT certified_deg FROM candidates WHERE draw = $draw")" ] ||
  fail "the column certified_deg"
[ "$(count a.db)" = 1 ] || fail "more than one"
"$program" certify a.db --best 3 > text || fail "the best three"
[ "$(grep -c '^draw .*: certified from flat to ' text)" = 3 ] || fail "a line each: $(cat text)"
"$program" certify a.db --all > text 2> err || fail "all"
grep -q "; [34] existed already$" text || fail "made again: $(cat text)"
[ "$(count a.db)" = "$candidates" ] || fail "not all"
seconds=$(sql a.db 'SELECT seconds FROM certificate ORDER BY draw' | cksum)
"$program" certify a.db --all --json > all.json || fail "all once more"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('all.json'))")" = "$candidates" ] || fail "a list"
[ "$(sql a.db 'SELECT seconds FROM certificate ORDER BY draw' | cksum)" = "$seconds" ] || fail "made once more"
[ "$(digest_of a.db)" = "$digest" ] || fail "the digest changed"
[ "$(sql a.db 'SELECT count(*) FROM certificate
               WHERE certified_deg = asked_deg OR ended = "reversal" AND certified_deg > 140')" = "$candidates" ] ||
  fail "ends: $(sql a.db 'SELECT ended, count(*), min(certified_deg) FROM certificate GROUP BY 1')"
expected=$(rows a.db)

# As if the processor had neither wide registers nor fused products: the C library's functions are others then.
cp asked.db narrow.db
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4 "$program" certify narrow.db --all > /dev/null 2>&1 ||
  fail "narrow registers"
[ "$(rows narrow.db)" = "$expected" ] || fail "narrow registers: other rows"

# By any number of ranks, and killed in the middle.
for n in 1 2 3; do
  "${ranks[@]}" $n "$program" certify ranks-$n.db --all > /dev/null 2> err || { fail "$n ranks"; cat err; }
  [ "$(rows ranks-$n.db)" = "$expected" ] || fail "$n ranks: other rows"
done
rm ranks-2.db && cp a.db ranks-2.db && sqlite3 ranks-2.db 'DELETE FROM certificate'
"$program" certify ranks-2.db --all --ranks 2 > text 2> err || { fail "--ranks 2"; cat err; }
[ "$(rows ranks-2.db)" = "$expected" ] || fail "--ranks 2: other rows"
"$program" certify killed.db --all > /dev/null 2>&1 &
begun killed.db certificate
kill -9 $!
wait $! 2> /dev/null
some=$(count killed.db)
[ "$some" -gt 0 ] && [ "$some" -lt "$candidates" ] || fail "$some when killed"
"$program" certify killed.db --all > text 2> err || fail "resumed"
grep -q "; $some existed already$" text || fail "what was committed is made again: $(cat text)"
[ "$(rows killed.db)" = "$expected" ] || fail "killed: other rows"
# At any moment, again and again, whatever was done before.
hit=0
for kill in $(seq 2 "$kills_wanted"); do
  [ "$(count killed.db)" -lt "$candidates" ] || sqlite3 killed.db 'DELETE FROM certificate'
  "$program" certify killed.db --all > /dev/null 2>&1 &
  sleep 0.$((RANDOM % 90 + 10))
  { kill -KILL $! && hit=$((hit + 1)); wait $!; } 2> /dev/null
  sound killed.db 200
done
[ "$kills_wanted" = 1 ] || echo "$hit of $((kills_wanted - 1)) kills met certificates under way"
"$program" certify killed.db --all > text 2> err || fail "resumed after all kills"
[ "$(rows killed.db)" = "$expected" ] || fail "killed again and again: other rows"
[ "$(digest_of killed.db)" = "$digest" ] || fail "killed again and again: another digest"
"$program" certify asked.db --all > /dev/null 2> err &
asked=$!
begun asked.db certificate
"$program" certify asked.db --all > /dev/null 2> err2
[ $? = 4 ] || fail "in use: $(cat err2)"
kill -TERM $asked
wait $asked || fail "SIGTERM: exit $?"
some=$(count asked.db)
grep -q "stopped: $((candidates - some)) of $candidates candidates are left" err || fail "SIGTERM: $(cat err)"

# As the search goes: the same rows, the same digest. Not where it splits.
sed '0,/{/s//{ "certify": true,/' "$campaign" > certify.json
"$program" search certify.json --draws 200 --catalogue goes.db --progress none > /dev/null 2>&1 || fail "as it goes"
[ "$(rows goes.db)" = "$expected" ] || fail "as it goes: other rows"
[ "$(digest_of goes.db)" = "$digest" ] || fail "as it goes: another digest"
"${ranks[@]}" 2 "$program" search certify.json --draws 200 --catalogue goes-2.db --progress none > /dev/null 2>&1 ||
  fail "as it goes, 2 ranks"
[ "$(rows goes-2.db)" = "$expected" ] || fail "as it goes, 2 ranks: other rows"
sed '0,/{/s//{ "certify": true,/' "$source_dir/search/campaigns/miura-6x6-flat.json" > splits.json
"$program" search splits.json --catalogue splits.db > /dev/null 2> err
[ $? = 3 ] && grep -q 'certify.*run `misalign certify`' err || fail "where it splits: $(cat err)"

# Checked: what is there, and what is not; spoilt ones are found, and made again.
"$program" certify a.db --best 2 --check > text || fail "check: $(cat text)"
[ "$(head -n 1 text)" = "2 certificates checked: all hold, up to their certified angles" ] || fail "check: $(cat text)"
"$program" certify a.db "$draw" --contact > text || fail "contact: $(cat text)"
grep -q "; no panels meet" text || fail "contact: $(cat text)"
"$program" certify a.db "$draw" --check > text || fail "contact is not checked: $(cat text)"
cp asked.db few.db
sqlite3 few.db "DELETE FROM certificate WHERE draw NOT IN (SELECT draw FROM certificate ORDER BY draw LIMIT 2)"
"${ranks[@]}" 2 "$program" certify few.db --check --json > check.json 2> err || fail "check, 2 ranks: $(cat err)"
[ "$(field check.json checked)" = 2 ] || fail "check, 2 ranks: $(cat check.json)"
[ "$(field check.json without)" = $((candidates - 2)) ] || fail "those without one: $(cat check.json)"
for spoilt in "certified_deg = certified_deg - 1" "ended = 'fold_limit'" "place = 'A1-A2'" "intervals = intervals + 1" \
  "proof = CAST(substr(proof, 1, 200) || x'55' || substr(proof, 202) AS BLOB)"; do
  cp few.db spoilt.db
  one=$(sql few.db 'SELECT draw FROM certificate ORDER BY draw LIMIT 1')
  sqlite3 spoilt.db "UPDATE certificate SET $spoilt WHERE draw = $one"
  "$program" certify spoilt.db "$one" --check > text
  [ $? = 6 ] && grep -q "^draw $one: its hash is not" text || fail "$spoilt passes: $(cat text)"
  "$program" certify spoilt.db "$one" > /dev/null 2> err || fail "$spoilt: not mended"
  grep -q "draw $one.*made again" err || fail "$spoilt: mended in silence"
  [ "$(rows spoilt.db)" = "$(rows few.db)" ] || fail "$spoilt: mended to something else"
done

# What ends them is proven of some: not that draw 11 comes to a fold limit, although it does.
cp a.db limited.db
"$program" certify limited.db 11 --to 180 > text || fail "to its fold limit"
grep -q "there the proof stops, next to a fold limit" text || fail "to its fold limit: $(cat text)"
turns=$(sql limited.db "SELECT draw FROM certificate WHERE ended = 'reversal' ORDER BY draw LIMIT 1")
"$program" certify limited.db 11 "$turns" --check > text || fail "two ends: $(cat text)"
grep -q "^proven ends: 1 (reversal 1)$" text || fail "two ends: $(cat text)"
grep -q "^unproven ends: 1 (fold_limit 1); the proof merely stops there" text || fail "two ends: $(cat text)"

# A pattern file: nothing is kept, and what is printed can be checked.
table1=$source_dir/search/patterns/table1.json
"$program" certify "$table1" --json > certified.json || fail "table 1"
[ "$(field certified.json certificate.certified_deg)" = 156.0 ] || fail "table 1 to its D"
"$program" certify certified.json --check > text || fail "table 1: $(cat text)"
[ "$(cat text)" = "1 certificate checked: it holds, up to its certified angle
proven ends: 1 (to_the_end 1)" ] || fail "table 1: $(cat text)"
sed 's/"asked_deg": 156.0/"asked_deg": 157.0/' certified.json > more.json
"$program" certify more.json --check > text
[ $? = 6 ] || fail "another angle passes: $(cat text)"

# Asked for more it ends where the first diagonal turns back, as close steps have it.
"$program" certify "$table1" --to 180 --json > beyond.json || fail "table 1 to 180"
[ "$(field beyond.json certificate.end)" = reversal ] || fail "table 1 to 180: $(field beyond.json certificate.end)"
"$program" fold "$table1" --to 156.3 --step 0.02 --json > close.json || fail "close steps"
sqlite3 :memory: "
  CREATE TABLE sample AS SELECT key, value AS deg FROM json_each(readfile('close.json'), '\$.samples_deg');
  CREATE INDEX by_key ON sample (key);
  CREATE TABLE length AS SELECT d.key AS diagonal, l.key AS key, l.value AS mm
    FROM json_each(readfile('close.json'), '\$.diagonals') d, json_each(d.value, '\$.length_mm') l;
  WITH step AS (SELECT diagonal, deg, sign(mm - lag(mm) OVER (PARTITION BY diagonal ORDER BY deg)) AS way
    FROM length JOIN sample USING (key) WHERE deg > 100),
  turn AS (SELECT deg, way != lag(way) OVER (PARTITION BY diagonal ORDER BY deg) AS turns FROM step)
  SELECT min(deg) FROM turn WHERE turns" > turn
# The largest, or least, length lies within two steps of that.
[ "$(sqlite3 :memory: "SELECT $(field beyond.json certificate.certified_deg) BETWEEN $(cat turn) - 0.04 AND $(cat turn)")" = 1 ] ||
  fail "table 1 turns back between close steps at $(cat turn), not at $(field beyond.json certificate.certified_deg)"

# Wells: of a file, whose springs are relaxed at 60 degrees, and of draws, whose are flat. Nothing is kept.
"$program" certify "$table1" --wells --rest-deg 60 --to 150 > text || fail "wells of table 1"
[ "$(cat text)" = "table1: one well at 60.00 deg between flat and 150 deg, proven; flat is no well, the energy falls from there" ] ||
  fail "wells of table 1: $(cat text)"
"$program" certify "$table1" --wells --rest-deg 60 --to 170 --json > wells.json || fail "wells beyond its end"
[ "$(field wells.json wells)" = 1 ] && [ "$(field wells.json flat)" = top ] && [ "$(field wells.json end)" != to_the_end ] &&
  [ "$(sqlite3 :memory: "SELECT $(field wells.json proven_deg) BETWEEN 156 AND 157")" = 1 ] ||
  fail "wells beyond its end: $(cat wells.json)"
wells_before=$(rows a.db)
"$program" certify a.db --best 2 --wells > text || fail "wells of draws"
[ "$(grep -c '^draw .* between flat and .* proven; flat is a well, too' text)" = 2 ] || fail "wells of draws: $(cat text)"
[ "$(rows a.db)" = "$wells_before" ] || fail "wells of draws are kept"

# refused CODE WORDS ARGS...
refused() {
  local code=$1 words=$2
  shift 2
  "$program" certify "$@" > out 2> err
  [ $? = "$code" ] && grep -q -- "$words" err || fail "certify $*: $(cat err)"
}
refused 2 "no candidates are chosen" a.db
refused 2 "excludes --all" a.db 1 --all
refused 2 "excludes --check" a.db --check --to 90
refused 2 "excludes --check" a.db --check --again
refused 2 "holds no such candidate" a.db 99999999
refused 2 "excludes --wells" "$table1" --wells --check
refused 2 "requires --wells" "$table1" --rest-deg 60
refused 2 "--rest-deg 175: table1 folds to 156.3487 deg only" "$table1" --wells --rest-deg 175
refused 2 "has no proof of its wells (the force of springs that only pull" "$table1" --wells --fill '{"kind": "springs", "pull_only": true}'
refused 2 "is no number\|between\|range\|number" a.db 1 --to 181
refused 2 "which is one sheet" "$table1" --all
refused 2 "which is one sheet" "$table1" --ranks 2
refused 2 "without --best" a.db --all --by draw
refused 3 "" nowhere.db --all
refused 3 "holds no certificate, so that there is nothing to check" "$table1" --check
sqlite3 few.db 'DELETE FROM certificate'
refused 3 "none of $candidates candidates has a certificate" few.db --check
refused 3 "none of 2 candidates has a certificate" few.db --best 2 --check --json
"${ranks[@]}" 2 "$program" certify few.db --check > /dev/null 2> err
[ $? = 3 ] || fail "nothing to check, 2 ranks: $(cat err)"
sed 's/"A10"/"A9"/; s/"displacements_mm": {/"displacements_mm": {},\n "no": {/' "$table1" > bad.json
refused 3 "" bad.json
finish
