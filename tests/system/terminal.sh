# What the program shows on a terminal, and what it does not show elsewhere. The terminals are those
# of script (util-linux).
. "$(dirname "$0")/lib.sh"
export TERM=xterm LC_ALL=C.UTF-8
unset NO_COLOR PAGER LESS
escape=$'\x1b'
campaign=quick.json
quick_campaign $campaign
pattern=$source_dir/search/patterns/table1.json

# on_terminal COLUMNS COMMAND: what it shows, the carriage returns before line feeds left out.
on_terminal() { script -qec "stty cols $1; $2" /dev/null < /dev/null | sed 's/\r$//'; }

# The live line: drawn again and again within the terminal's width, and what follows is on a new line.
# searching CATALOGUE: in the background, until two live lines are there; $terminal, and its search in pid.
searching() {
  rm -f pid shown
  script -qec "stty cols 60; echo \$\$ > pid; exec $program search $campaign --catalogue $1 --draws 1000000000" \
    /dev/null > shown < /dev/null &
  terminal=$!
  two_lines() { [ -s shown ] && [ "$(tr '\r' '\n' < shown | grep -c "draws.*$escape\[K")" -ge 2 ]; }
  eventually "two live lines" two_lines
}
searching bar.db
kill -USR1 "$(cat pid)"
wait $terminal
sed -i 's/\r$//' shown
tr '\r' '\n' < shown | grep "$escape\[K" | sed "s/$escape\[K//" > lines
while IFS= read -r line; do
  [ ${#line} -lt 60 ] || fail "a live line of ${#line} columns: $line"
done < lines
grep -q "^bar.db: stopped" shown || fail "the summary does not begin a line: $(cat -v shown)"
grep -q "^misalign: next: " shown || fail "no next step: $(cat -v shown)"

# A message in between has a line of its own.
searching usr2.db
kill -USR2 "$(cat pid)"
eventually "a status line" grep -q "draws/s" shown
kill -TERM "$(cat pid)"
wait $terminal
grep -q $'\r'"$escape\[K[0-9]* s: .*draws/s" shown || fail "USR2 within a live line: $(cat -v shown)"

# Nowhere else: not under mpirun, not in a file, not on a terminal that cannot, not if not wanted.
for case in "${ranks[*]} 2 $program|" "OMPI_COMM_WORLD_RANK=0 $program|" "$program|2> err" "TERM=dumb $program|" "$program|--progress plain"; do
  rm -f plain.db err
  on_terminal 100 "${case%|*} search $campaign --catalogue plain.db --draws 1000 ${case#*|}" > shown
  ! grep -q "$escape\[K" shown || fail "a live line for $case: $(cat -v shown)"
  cat shown err 2> /dev/null | grep -q "^[0-9]* s: 1000 of 1000 draws" || fail "no plain line for $case"
done
"$program" search $campaign --catalogue none.db --draws 1000 --progress none 2> err > /dev/null
grep -qv "^misalign: campaign" err && fail "--progress none: $(cat err)"

# For programs: objects of JSON, the last one with what the catalogue says.
"$program" search $campaign --catalogue json.db --draws 3000 --progress json 2> err > /dev/null
grep -v "^misalign: " err > objects
[ -s objects ] || fail "--progress json prints nothing"
while IFS= read -r object; do
  [ "$(sqlite3 :memory: "SELECT json_valid('$object')")" = 1 ] || fail "no JSON: $object"
done < objects
said() { sqlite3 :memory: "SELECT json_extract('$(tail -1 objects)', '\$.$1')"; }
[ "$(said last)$(said draws)$(said draws_left)$(said left_s)" = 1300000.0 ] || fail "the last object: $(tail -1 objects)"
[ "$(said accepted)" = "$(sql json.db 'SELECT count(*) FROM candidate')" ] || fail "accepted: $(tail -1 objects)"
[ "$(said best.draw)" = "$(sql json.db 'SELECT draw FROM candidate ORDER BY deploys_from_deg DESC, draw LIMIT 1')" ] ||
  fail "best: $(tail -1 objects)"
for key in elapsed_s draws draws_left draws_per_s draws_per_s_mean accepted rate best left_s last; do
  "$program" search --help | grep -q "\b$key\b" || fail "search --help does not say $key"
  grep -q "\"$key\":" objects || fail "$key is in no object"
done

# What takes long says so, on standard error alone: in a live line on a terminal, elsewhere in lines, and how far it
# is where that is known. Debugging it says so at once.
endless="WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n) SELECT k FROM n"
"$program" query json.db "$endless WHERE k < 0" > out 2> err &
asking=$!
script -qec "stty cols 60; echo \$\$ > pid; exec $program query json.db '$endless WHERE k < 0'" /dev/null > shown < /dev/null &
terminal=$!
eventually "a line of a long query" grep -q "^[0-9]* s: query is under way" err
eventually "a live line of a long query" grep -q $'\r'"[0-9]* s: query is under way$escape\[K" shown
kill $asking "$(cat pid)"
wait
[ -s out ] && fail "a long query: $(cat out)"
for verb in "export json.db --where deploys_from_deg>=0 --output found-all" "report json.db --output page.html --deploy" \
  "verify json.db --sample 3" "certify json.db --best 3 --again"; do
  # shellcheck disable=SC2086
  "$program" $verb > quiet 2> err || fail "$verb: $(cat err)"
  rm -f json.db.studies  # or nothing is left to compute
  # shellcheck disable=SC2086
  "$program" $verb --log-level debug > out 2> err || fail "$verb: $(cat err)"
  cmp -s quiet out || [[ $verb = verify* || $verb = certify* ]] || fail "$verb: other words on standard output"
  grep -qE "^([0-9]+ min )?[0-9]+ s: [0-9]+ of [0-9]+ (sheets|candidates) " err || fail "$verb does not say how far it is: $(cat err)"
done
rm json.db.studies
"$program" report json.db --output page.html --deploy --log-level debug 2>&1 | grep -q " sheets studied$" || fail "nothing of --deploy"
# Rows of a table without an end come as they are made.
"$program" query json.db "$endless" 2> err | head -3 > rows
[ "$(tr -s ' \n' ' ' < rows)" = " k 1 2 " ] || fail "a table without an end: $(cat rows err)"

# Colors only where they are wanted.
colored() { grep -q "$escape\[[0-9]"; }
on_terminal 80 "$program status json.db" | colored || fail "no colors on a terminal"
on_terminal 80 "$program status json.db --color never" | colored && fail "--color never"
on_terminal 80 "NO_COLOR=1 $program status json.db" | colored && fail "NO_COLOR"
on_terminal 80 "TERM=dumb $program status json.db" | colored && fail "TERM=dumb"
"$program" status json.db 2>&1 | colored && fail "colors in a pipe"
"$program" status json.db --color always 2> /dev/null | colored || fail "--color always"
on_terminal 80 "$program fold $pattern --json" | colored && fail "colors in JSON"

# The table of status, and the sparklines of fold: 80 columns, and signs that the locale has.
narrow() {
  while IFS= read -r line; do
    [ ${#line} -le 80 ] || fail "$1: ${#line} columns: $line"
  done
}
narrow status < <("$program" status json.db --at 25 2> /dev/null)
for draw in 0 1; do narrow replay < <("$program" replay json.db $draw); done
"$program" fold "$pattern" > folding || fail "fold"
narrow fold < folding
[ "$(grep -c '▁.*█\|█.*▁' folding)" = 16 ] || fail "sparklines: $(cat folding)"
grep -q "^pilot_deg" folding && fail "the table is too wide, and was shown"
"$program" fold "$pattern" --table | grep -q "^pilot_deg" || fail "--table"
on_terminal 200 "$program fold $pattern" | grep -q "^pilot_deg" || fail "a wide terminal has room for the table"
LC_ALL=C "$program" fold "$pattern" > folding
LC_ALL=C grep -q '[^ -~]' folding && fail "signs beyond ASCII: $(cat folding)"
[ "$(grep -c '_.*#\|#.*_' folding)" = 16 ] || fail "sparklines in ASCII: $(cat folding)"
# A sheet that nobody shifted has diagonals of one length, whatever rounding makes of them.
for still in miura-wide-6x6 double-corrugation-6x6 turned-quads-6x6; do
  LC_ALL=C "$program" fold "$source_dir/search/patterns/$still.json" > folding || fail "fold $still"
  [ "$(grep -c ' still .*  _*$' folding)" = 16 ] || fail "$still moves: $(cat folding)"
done

# The pager.
query="$program query json.db best"
$query > rows 2> err
[ "$(wc -l < rows)" = 21 ] || fail "query best: $(cat rows)"
grep -q "first 20 rows" err || fail "nothing said of the rows left out: $(cat err)"
$query --color never > same 2> /dev/null && cmp -s rows same || fail "query: not the same twice"
on_terminal 80 "PAGER='cat > paged' $query --color never" > shown
cmp -s rows paged || fail "what the pager gets: $(cat -v paged)"
for unpaged in "PAGER=cat $query" "PAGER= $query" "PAGER='touch called; cat' $query --no-pager" \
  "PAGER='touch called; cat' $query --csv" "PAGER='touch called; cat' $query | cat" "PAGER=/no/such/pager $query"; do
  on_terminal 80 "$unpaged" > shown
  [ "$(grep -c '^.\{0,8\} *[0-9]' shown)" -ge 20 ] || fail "$unpaged: $(cat -v shown)"
  [ ! -e called ] || fail "$unpaged: paged"
done
all="SELECT * FROM candidates a, candidates LIMIT 3000"
on_terminal 80 "PAGER='head -1' $program query json.db '$all'; echo exit \$?" > shown
[ "$(tail -1 shown)" = "exit 0" ] && ! grep -q misalign: shown || fail "a pager that is left: $(tail -3 shown)"
for pipe in "" "trap '' PIPE;"; do
  bash -c "$pipe \"\$0\" query json.db '$all' | head -1 > /dev/null" "$program" 2> err
  [ ! -s err ] || fail "a pipe that is closed ($pipe): $(cat err)"
done

# What to type next can be typed.
next_of() { sed -n 's/^misalign: next: //p' | sed "s|misalign |$program |g; s|CAMPAIGN.json|$campaign|; s| resumes\$||"; }
"$program" search $campaign --catalogue "next one.db" --draws 40 2>&1 > /dev/null | next_of > next
[ "$(wc -l < next)" = 1 ] || fail "next: $(cat next)"
bash -e next > out 2>&1 || fail "$(cat next): $(cat out)"
[ -n "$(ls found)" ] || fail "next exports nothing: $(cat next)"
"$program" search $campaign --catalogue part.db --draws 1000 > /dev/null 2>&1
sqlite3 part.db "UPDATE campaign SET goal_draws = 1100, goal_end = 1100" || fail "a farther goal"
"$program" status part.db 2>&1 > /dev/null | next_of > next
bash -e next > out 2>&1 || fail "$(cat next): $(cat out)"
"$program" status part.db --check > /dev/null 2>&1 || fail "not complete after $(cat next)"

finish
