# What strangers wrote into files and databases, shown without doing anything to a terminal: no line
# that they forged, no control character, no flood; and the descriptors and limits that a caller sets.
. "$(dirname "$0")/lib.sh"
export TERM=xterm LC_ALL=C.UTF-8
campaign=quick.json
quick_campaign $campaign
"$program" search $campaign --catalogue good.db --draws 300 --progress none > /dev/null 2>&1 ||
  fail "a catalogue to begin with"

# Erases, forges a line, colours, moves (C1), turns the reading order, ends a title, is no UTF-8.
evil=$'x\n\e[2J\e[31mmisalign: accepted 99999\r\xc2\x9b1A\e]0;t\a\xe2\x80\xaetxt\x7f\xff'

# clean FILE WHAT: nothing in it that a terminal acts on, and no forged line.
clean() {
  LC_ALL=C grep -aqP '[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8e\x8f\xa8-\xae]|\xff' "$1" &&
    fail "$2: control characters: $(cat -v "$1" | head -5)"
  LC_ALL=C grep -aq '^misalign: accepted 99999' "$1" && fail "$2: a forged line: $(cat -v "$1" | head -5)"
  [ "$(wc -c < "$1")" -lt 20000 ] || fail "$2: $(wc -c < "$1") bytes"
}

# shows WHAT ARGUMENT...: clean on both outputs, whatever the exit code; something is said.
shows() {
  local what=$1
  shift
  "$program" "$@" > out 2> err
  [ -s out ] || [ -s err ] || fail "$what: nothing was said"
  clean out "$what"
  clean err "$what"
}

# hostile SQL: evil.db with this done to it, :evil bound.
hostile() {
  cp good.db evil.db
  sqlite3 evil.db "PRAGMA ignore_check_constraints = ON" "PRAGMA foreign_keys = OFF" ".parameter init" \
    ".parameter set :evil \"CAST(x'$(printf %s "$evil" | od -An -tx1 | tr -d ' \n')' AS TEXT)\"" "$1" > /dev/null ||
    fail "hostile: $1"
}
looks() {
  shows "status after $1" status evil.db
  shows "verify after $1" verify evil.db --sample 3
  shows "query after $1" query evil.db best
  shows "replay after $1" replay evil.db 5
  shows "export after $1" export evil.db --best 1 --output exported
  rm -rf exported merged.db
  shows "merge after $1" merge merged.db good.db evil.db
}
while IFS= read -r change; do
  hostile "$change"
  looks "$change"
done << 'END'
UPDATE campaign SET name = :evil
UPDATE campaign SET identity = :evil
UPDATE campaign SET configuration = :evil
UPDATE campaign SET configuration = json_set(configuration, '$.name', 'x' || char(27) || '[2J')
UPDATE campaign SET configuration = json_set(configuration, '$.x' || char(10, 27) || 'misalign: accepted 99999', 1)
UPDATE candidate SET displacements_mm = :evil, elongation = :evil
UPDATE fault_sample SET first_fault = :evil
UPDATE run SET golden_verdicts = :evil, "commit" = :evil, host = :evil
END

# Cells and names of columns; what programs read is what was there.
hex=$(printf %s "${evil%?}" | od -An -tx1 | tr -d ' \n')  # its UTF-8 part
select="SELECT CAST(x'$hex' AS TEXT) AS \"na${evil%?}me\", 1 AS n"
shows "a query" query good.db "$select"
"$program" query good.db "$select" --json > cell.json || fail "query --json"
clean cell.json "query --json"
same=$(sqlite3 :memory: "SELECT count(*) FROM json_each(readfile('cell.json'), '\$[0]')
  WHERE key = 'na' || CAST(x'$hex' AS TEXT) || 'me' AND value = CAST(x'$hex' AS TEXT)")
[ "$same" = 1 ] || fail "query --json is not what is stored: $(cat cell.json)"
"$program" query good.db "SELECT CAST(x'$hex' AS TEXT) AS c" --csv > cell.csv || fail "query --csv"
printf 'c\n"%s"\n' "${evil%?}" | cmp -s - cell.csv || fail "query --csv in a file is not what is stored: $(cat -v cell.csv)"
script -qec "$program query good.db \"SELECT CAST(x'$hex' AS TEXT) AS c\" --csv" /dev/null < /dev/null | tr -d '\r' > shown
clean shown "query --csv on a terminal"
script -qec "PAGER='cat > paged' $program query good.db \"SELECT CAST(x'$hex' AS TEXT) AS c\"" /dev/null < /dev/null | tr -d '\r' > shown
sed $'s/\e\\[[0-9]*m//g' paged > uncoloured
clean uncoloured "the pager"

# Sentences about what was typed or named.
shows "a word of SQL" query good.db "SELECT \"$evil\" FROM nothing"
shows "a name of a query" query good.db "$evil"
shows "a condition" export good.db --where "\"$evil\" > 1" --output exported
shows "a column" export good.db --best 1 --by "$evil" --output exported
shows "a verb" "$evil"
shows "an option" status good.db "--$evil"
shows "an argument" status good.db "$evil"
shows "a choice" search $campaign --progress "$evil"
shows "no such file" status "$evil"
cp good.db "$evil.db"
shows "a file's name" status "$evil.db"
cp $campaign "$evil.json"
shows "a campaign file's name" config --check "$evil.json"
shows "a file's name in a search" search "$evil.json" --catalogue "$evil.2.db" --draws 50 --progress plain
echo '{' > "$evil.json"
shows "a broken file's name" fold "$evil.json"
rm -f -- "$evil"*

# Files: keys, values, names of other files.
json_evil=$(sqlite3 :memory: "SELECT json_quote(CAST(x'$hex' AS TEXT))")
for text in "{ \"name\": $json_evil, $json_evil: 1, \"pattern\": { \"family\": $json_evil } }" \
  "{ \"pattern\": { \"family\": \"fold\", \"file\": $json_evil } }" \
  "{ \"pattern\": { \"family\": \"miura\", \"rows\": 4, \"columns\": 4, \"holes\": [[$json_evil, 1]], \"pilot\": $json_evil } }" \
  "{ \"x\": $evil" "$evil"; do
  printf '%s' "$text" > evil.json
  shows "the file $text" config --check evil.json
  shows "the file $text" search evil.json
  shows "the file $text" fold evil.json
done

# Names that go into other programs' files: refused where they are read, also from a catalogue.
printf '{ "family": "miura", "rows": 4, "columns": 4, "design": {"thickness_mm": 1, "material": {"name": %s, "e_gpa": 70}} }' \
  "$json_evil" > evil.json
hostile "UPDATE campaign SET configuration = json_set(configuration, '\$.design',
  json_object('material', json_object('name', 'steel' || char(10) || '*INCLUDE, INPUT=stolen.txt', 'e_gpa', 70)))"
for typed in "export evil.json --format inp --output names" "card evil.json --output names.html" "verify evil.db" \
  "export evil.db --best 1 --format inp --output names"; do
  # shellcheck disable=SC2086
  shows "$typed" $typed
  # shellcheck disable=SC2086
  "$program" $typed > out 2> err
  [ $? = 3 ] && grep -q "design.material.name" err || fail "$typed: $(cat out err)"
done
[ ! -e names ] && [ ! -e names.html ] || fail "something was written with such a name"

# A flood: 200,000 faults, a fault of a megabyte, a key of one.
many() { printf "$1%.0s" $(seq "$2"); }
printf '{ "family": "miura", "rows": 4, "columns": 4, "holes": [%s0] }' "$(many '0,' 200000)" > many.json
shows "many faults" fold many.json
[ "$(wc -l < err)" = 22 ] && grep -q "200001 faults" err && grep -q "^  and 199981 more" err ||
  fail "many faults: $(cut -c1-200 err | tail -3)"
printf '{ "family": "%s", "%s": 1 }' "$(many abcdefghij 100000)" "$(many abcdefghij 100000)" > long.json
shows "long words" fold long.json
hostile "UPDATE candidate SET elongation = json_array(hex(zeroblob(50000)))"
shows "long cells" verify evil.db --all
[ "$(grep -c '' out)" -le 30 ] || fail "verify lists $(grep -c '' out) lines"

# Nested to exhaust the stack of who copies or prints it.
hostile "UPDATE candidate SET displacements_mm = '{\"A8\":' || replace(hex(zeroblob(100000)), '0', '[') ||
  replace(hex(zeroblob(100000)), '0', ']') || '}'"
shows "deep JSON in a spread" export evil.db --diverse 3 --output exported
shows "deep JSON" verify evil.db --all
grep -q "displacements" out || fail "deep JSON in verify: $(head -3 out)"

# Closed descriptors: a catalogue never becomes one of them, whatever is said there.
for closed in "0<&-" "2>&-" "0<&- 1>&- 2>&-"; do
  rm -f closed.db
  eval "\"\$program\" search $campaign --catalogue closed.db --draws 300 --progress plain --log-level debug $closed" \
    > out 2> err
  sound closed.db 300
  [ "$(digest_of closed.db)" = "$(digest_of good.db)" ] || fail "$closed: another digest"
  eval "\"\$program\" status nowhere.db $closed" > out 2> err
  [ $? = 3 ] || fail "$closed: no such file"
done
"$program" search $campaign --catalogue held.db --draws 1000000000 --progress plain 0<&- 1>&- 2>&- &
search=$!
eventually "a search without descriptors" test -e held.db-wal
for descriptor in 0 1 2; do
  [ "$(readlink /proc/$search/fd/$descriptor)" = /dev/null ] ||
    fail "descriptor $descriptor is $(readlink /proc/$search/fd/$descriptor)"
done
kill -TERM $search
wait $search

# What is printed and cannot be written is never taken for written, whoever prints it.
draw=$(sql good.db 'SELECT min(draw) FROM candidate')
table1=$source_dir/search/patterns/table1.json
unwritten=0
while read -r line; do
  eval "\"\$program\" $line" > out 2> err < /dev/null || fail "$line: exit $?"
  [ -s out ] || fail "$line prints nothing"
  for lost in "> /dev/full" ">&-"; do
    rm -f new*.db
    eval "\"\$program\" $line $lost" 2> err < /dev/null
    [ $? = 1 ] && grep -q "could not be written to standard output" err || fail "$line $lost: $(cat err)"
    unwritten=$((unwritten + 1))
  done
done << END
--version
--help
status --help
help status
status good.db
search $campaign --catalogue new.db --draws 300 --progress none
search $campaign --catalogue new-2.db --draws 300 --progress none --ranks 2
fold $table1 --json
perforations $table1
replay good.db $draw
query good.db best
verify good.db --sample 1
certify good.db $draw
certify good.db --best 3 --again --ranks 2
config --default
tolerance good.db $draw --amplitude 0.01 --trials 10
actuators $table1
contact $table1
completion bash
END
[ $unwritten = 38 ] || fail "$unwritten of 38 outputs tried"
"$program" search $campaign --catalogue new-2.db --draws 300 --progress none --ranks 2 >&- 2>&-
[ $? = 1 ] || fail "ranks with nowhere to print"

# What is proposed can be pasted, also where a file's name looks like an option.
cp good.db ./-x.db
"$program" status -- -x.db > out 2> err || fail "a name like an option"
next=$(sed -n 's/^misalign: next: misalign \(query [^;]*\);.*/\1/p' err)
eval "\"\$program\" $next" > out 2> err || fail "$next: $(cat err)"
rm ./-x.db

# Limits of size and memory are sentences.
export PMIX_MCA_gds=hash  # without files of megabytes for one rank
(ulimit -f 64; "$program" search $campaign --catalogue limit.db --draws 100000 --progress none) > out 2> err
[ $? = 1 ] && grep -q "^misalign: limit.db: .*what was committed is good" err || fail "ulimit -f: $(cat err)"
"$program" search $campaign --catalogue limit.db --draws 300 --progress none > out 2> err || fail "after ulimit -f: $(cat err)"
sound limit.db 300
(ulimit -f 1; "$program" fold "$source_dir/search/patterns/table1.json" --json > full.json) 2> err
[ $? = 1 ] && grep -q "could not be written to standard output" err || fail "ulimit -f and a pipe: $(cat err)"
rm -rf exported
(ulimit -f 1; "$program" export good.db --best 1 --output exported) > out 2> err
[ $? = 1 ] && grep -q "cannot be written" err || fail "ulimit -f and an export: $(cat err)"
[ -z "$(find exported -type f)" ] || fail "half of an export: $(ls -l exported)"
printf '[%s0]' "$(many '[],' 3000000)" > large.json
(ulimit -v 300000; "$program" fold large.json) > out 2> err
[ $? = 1 ] && grep -q "memory has run out" err || fail "ulimit -v: $(cat err)"
wide=$(many ', hex(zeroblob(30000000))' 20)  # each within the limit of a value
(ulimit -v 500000; "$program" query good.db "SELECT 1$wide" --json) > out 2> err
[ $? = 1 ] && grep -q "memory has run out" err || fail "ulimit -v and a query: $(cat err)"
finish
