# Half of the program, which scripts/run.sh builds first: it finds what the whole one finds, in a catalogue with which
# that goes on, and refuses what it cannot do.
. "$(dirname "$0")/lib.sh"
first=$(dirname "$program")/first/misalign
campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 3000 --catalogue whole.db > /dev/null 2>&1 || fail "search"
"$first" search "$campaign" --draws 1000 --catalogue first.db > /dev/null 2>&1 || fail "search by half of it"
"$first" search "$campaign" --draws 2000 --catalogue first.db --ranks 2 > /dev/null 2>&1 || fail "two ranks of half of it"
"$program" search "$campaign" --draws 3000 --catalogue first.db > /dev/null 2>&1 || fail "the whole one goes on"
sound first.db 3000
[ -n "$(digest_of whole.db)" ] && [ "$(digest_of first.db)" = "$(digest_of whole.db)" ] || fail "the digest"
for query in best acceptance "SELECT * FROM candidates ORDER BY draw"; do
  for half in first program; do
    "${!half}" query whole.db "$query" --csv > $half.csv || fail "$half: query $query"
    "${!half}" status whole.db > $half.text 2> /dev/null || fail "$half: status"
  done
  [ -s first.csv ] && cmp -s first.csv program.csv && cmp -s first.text program.text || fail "other answers to $query"
done

sed 's/"accept"/"certify": true, "accept"/' "$campaign" > certified.json
sed 's/"accept"/"search": {"method": "optimise", "from_deg": 36}, "accept"/' "$campaign" > optimising.json
search="--draws 100 --catalogue none.db"
while IFS=: read -r words lack; do
  "$first" $words > out 2> err
  [ $? = 1 ] && grep -q "$lack; cmake --build --preset release builds the whole program" err || fail "$words: $(cat err)"
  [ ! -e none.db ] && [ ! -s out ] || fail "$words: something is left"
done << EOF
search certified.json $search:certifies nothing
search certified.json $search --ranks 2:certifies nothing
search optimising.json $search:does not optimise
query whole.db --front D,stroke_max:finds no front
EOF
"$first" fold "$source_dir/search/patterns/table1.json" > out 2> err
[ $? = 2 ] && grep -q "fold is no verb" err || fail "fold: $(cat err)"
finish
