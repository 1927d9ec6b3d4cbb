# `misalign verify` says nothing against a good catalogue, and finds every single altered cell.
. "$(dirname "$0")/lib.sh"
quick_campaign campaign.json
"$program" search campaign.json --draws 1200 --unit-draws 400 --catalogue good.db > /dev/null 2>&1 ||
  fail "search"
"$program" verify good.db --all --json > good.json || fail "verify of a good catalogue"
[ "$(field good.json good)$(field good.json panels_checked)" = 11 ] || fail "good, with panels"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('good.json'), '\$.checked')")" = \
  "$(sql good.db 'SELECT count(*) FROM candidate')" ] || fail "--all: how many"
"$program" verify good.db > text || fail "verify in words"
grep -q "^candidates   100 of" text || fail "the default sample"
grep -q "^findings     none" text || fail "findings of a good catalogue"
[ "$("$program" verify good.db --sample 7 --json | grep -c first_contact_deg)" = 7 ] ||
  fail "--sample"

# A small one, quickly computed again.
"$program" search campaign.json --draws 90 --unit-draws 30 --catalogue small.db > /dev/null 2>&1 ||
  fail "search"
# found SQL WORD: a copy with this done to it, past keys and checks, is refused with exit code 6, and
# some sentence names the word.
found() {
  rm -f bad.db
  cp small.db bad.db
  sqlite3 bad.db "PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; $1" ||
    fail "sqlite3: $1"
  "$program" verify bad.db --all > text 2> err
  [ $? = 6 ] || fail "exit code after $1"
  grep -q "$2" text || fail "no sentence names $2 after $1"
}

draw=$(sql small.db 'SELECT draw FROM candidate ORDER BY draw LIMIT 1 OFFSET 5')
columns=$(sql small.db "SELECT name FROM pragma_table_info('candidate')")
for column in $columns; do
  case $column in
    draw) change="draw + 1000000" names=unit ;;
    unit) change="unit + 30" names=candidate.unit ;;
    deploys_from_sample) change="$column - 1" names="draw $draw: $column" ;;
    shifted_vertices | increasing | decreasing) change="$column + 1" names="draw $draw: $column" ;;
    residual_max) change="$column + 3e-12" names="draw $draw: $column" ;;
    displacements_mm) change="replace($column, '0.4', '0.39')" names="draw $draw: $column" ;;
    elongation) change="json_set($column, '\$[1]', json_extract($column, '\$[1]') + 1e-9)"
      names="draw $draw: $column" ;;
    bump_deg | reverses_at_deg) change="coalesce($column, 40) + 0.01" names="draw $draw: $column" ;;
    *) change="$column * 1.0001 + 1e-7" names="draw $draw: $column" ;;
  esac
  found "UPDATE candidate SET $column = $change WHERE draw = $draw" "$names"
done

found "DELETE FROM candidate WHERE draw = $draw" "unit 0: accepted"
found "UPDATE unit SET accepted = accepted - 1, rejected = rejected + 1 WHERE lo = 30" \
  "unit 30: accepted"
found "UPDATE unit SET undecided = undecided + 1, rejected = rejected - 1 WHERE lo = 30" \
  "unit 30: undecided"
found "UPDATE unit SET rejected = rejected + 1 WHERE lo = 60" "unit 60: rejected"
found "UPDATE unit SET digest_part = randomblob(16) WHERE lo = 60" "unit 60: digest_part"
found "DELETE FROM fault_sample" "rows of fault_sample"
found "UPDATE campaign SET identity = lower(hex(randomblob(16)))" identity
found "UPDATE campaign SET goal_end = 0" "campaign: goal_end"
found "UPDATE campaign SET diagonals = json_set(diagonals, '\$[0].to', 'A1')" "campaign: diagonals"
found "UPDATE unit SET worker = 1 WHERE lo = 30" "ranks"
found "UPDATE fault_sample SET first_fault = 'bump', fault_deg = 29" "draw 0: fault_sample.first_fault"

# A goal's end that is none: neither complete nor incomplete, until the next search puts it right.
"$program" search campaign.json --draws 1000000 --max-time 0.1 --catalogue some.db > /dev/null 2>&1 || fail "some"
sed '0,/{/s//{ "search": {"method": "splitting", "particles": 20, "sweeps": 2, "first_draws": 60},/' campaign.json > split.json
"$program" search split.json --populations 2 --catalogue split.db > /dev/null 2>&1 || fail "splitting"
for file in small some split; do
  cp $file.db goal.db
  "$program" status goal.db --check > /dev/null 2> err
  [ $? != 6 ] && ! grep -q goal_end err || fail "$file: the goal's end is good"
  sqlite3 goal.db "UPDATE campaign SET goal_end = 0"
  "$program" status goal.db --check > /dev/null 2> err
  [ $? = 6 ] && grep -q "goal.db: campaign: goal_end is 0 as stored, [1-9]" err ||
    fail "$file: a goal's end of 0: $(cat err)"
  "$program" status goal.db > /dev/null 2> err
  [ $? = 0 ] && grep -q "goal_end is 0 as stored" err || fail "$file: without --check: $(cat err)"
done
"$program" search split.json --populations 2 --catalogue goal.db > /dev/null 2>&1 || fail "the next search"
"$program" status goal.db --check > /dev/null 2>&1 || fail "the next search puts it right"

# All draws of some units once more.
"$program" verify small.db --sample 1 --units 2 --seed 7 > text || fail "--units"
grep -q "^units        2 of 3 made again, 60 draws (--seed 7).* probability 0.667" text || { fail "--units"; cat text; }
"$program" verify small.db --seed 7 2> /dev/null
[ $? = 2 ] || fail "--seed without --units"

# While a search writes, every look is at one moment.
"$program" search campaign.json --draws 10000000 --unit-draws 20 --progress none --catalogue live.db > /dev/null 2>&1 &
search=$!
begun live.db unit
for look in 1 2 3 4 5 6 7 8 9 10; do
  "$program" verify live.db --sample 2 > text || { fail "verify while a search writes"; cat text; }
done
kill -TERM $search
wait $search || fail "the search that was looked at"
"$program" verify live.db --sample 2 --units 3 > text || { fail "verify after it"; cat text; }

"$program" verify nothing.db 2> /dev/null
[ $? = 3 ] || fail "verify of no file"
"$program" verify good.db --all --sample 3 2> /dev/null
[ $? = 2 ] || fail "verify --all --sample"
finish
