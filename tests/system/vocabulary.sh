# Each function of a sheet that `query --help` lists, in every place where it can stand; others are refused.
. "$(dirname "$0")/lib.sh"
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 60 --catalogue a.db > /dev/null 2>&1 || fail "search"
names=$("$program" query --help | sed -n '/^Functions of any draw/,/^D is/p' | sed -n 's/^  \([a-z_]*\) .*/\1/p')
[ "$(echo "$names" | wc -l)" -ge 7 ] || fail "the functions of query --help: $names"
few="draw < 10"
number=$(sql a.db "SELECT count(*) FROM candidates WHERE $few")
[ "$number" -ge 3 ] || fail "too few candidates: $number"
all="$few AND D >= 150"

for name in $names; do
  for word in "$name" "$name(draw)" "$name(draw, 90)"; do
    # The best by query, and those from its number on.
    "$program" query a.db --csv --no-pager "SELECT draw, $word FROM candidates WHERE $all ORDER BY 2 DESC, draw LIMIT 1" > best.csv 2> err ||
      fail "query $word: $(cat err)"
    IFS=, read -r draw value <<< "$(tail -1 best.csv)"
    [ "$value" ] || continue  # none of the few has one
    condition="$all AND $word >= $value"
    expected=$("$program" query a.db --csv "SELECT count(*) FROM candidates WHERE $condition" | tail -1)
    [ "$expected" -ge 1 ] || fail "query WHERE $word"
    "$program" export a.db --where "$condition" --output "out-$name" > names 2> err || fail "export --where $word: $(cat err)"
    [ "$(wc -l < names)" = "$expected" ] || fail "export --where $word: $(wc -l < names) of $expected"
    "$program" export a.db --best 1 --where "$all" --by "$word" --output "by-$name" > names 2> err || fail "export --by $word: $(cat err)"
    again=$("$program" query a.db --csv "SELECT $word FROM candidates WHERE draw = $(field "$(cat names)" draw)" | tail -1)
    [ "$again" = "$value" ] || fail "export --by $word: $again is not $value"
  done
  "$program" tolerance a.db --where "$condition" --by "$name" --best 1 --amplitude 0.01 --trials 2 --no-keep > /dev/null 2> err ||
    fail "tolerance --where, --by $name: $(cat err)"
  "$program" certify a.db --where "$condition" --by "$name" --best 1 --from 5 > /dev/null 2> err ||
    fail "certify --where, --by $name: $(cat err)"
  "$program" report a.db --where "$condition" --by "$name" --best 1 --column "$name" --rows 3 --output page.html > /dev/null 2> err ||
    fail "report --where, --by, --column $name: $(cat err)"
  grep -q "\"$name\":\[" page.html || fail "report --column $name"
done
[ "$("$program" query a.db --csv "SELECT D FROM candidates ORDER BY D DESC LIMIT 1" | tail -1)" = \
  "$(sql a.db 'SELECT max(deploys_from_deg) FROM candidate')" ] || fail "D in a query"
[ "$("$program" query a.db --csv "SELECT count(*) FROM candidates D WHERE D.draw >= 0" | tail -1)" = \
  "$(sql a.db 'SELECT count(*) FROM candidate')" ] || fail "a table of somebody's own that is called D"

# refused WORDS ARGUMENT...: by one sentence.
refused() {
  local words=$1
  shift
  "$program" "$@" > out 2> err
  [ $? = 2 ] && [ ! -s out ] && [ "$(wc -l < err)" = 1 ] && grep -q -- "$words" err || fail "$*: $(cat err)"
}
for place in "export a.db --output o --where" "tolerance a.db --amplitude 0.01 --where" "certify a.db --where" \
  "export a.db --output o --best 1 --by" "tolerance a.db --amplitude 0.01 --best 1 --by" "report a.db --output p.html --best 1 --by"; do
  refused "did you mean thickness_mm?" $place "thicknes_mm"
  refused "did you mean thickness_mm?" $place "thicknes_mm(draw)"
done
refused "did you mean stall_deg?" report a.db --output p.html --column stal_deg
refused "no such column: thicknes_mm; did you mean thickness_mm?" query a.db "SELECT thicknes_mm FROM candidates"
for typed in friction "friction(draw)"; do
  refused "did you mean [a-z_]*friction_n_mm_per_mm?" query a.db "SELECT $typed FROM candidates"
done
finish
