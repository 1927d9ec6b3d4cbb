# What is typed wrongly: one sentence that says what was meant, exit code 2, nothing on standard output.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
"$program" search $campaign --catalogue json.db --draws 100 --progress none > /dev/null || fail "search"
cp json.db other.db
cp json.db third.db
touch best  # as in: misalign query json.db best > best

"$program" > out 2> err
[ $? = 2 ] && [ ! -s out ] && grep -q "^  search " err || fail "misalign alone: $(cat err)"
while IFS='|' read -r words meant; do
  # shellcheck disable=SC2086
  "$program" $words > out 2> err
  [ $? = 2 ] && [ "$(wc -l < err)" = 1 ] && [ ! -s out ] || fail "$words: $(cat err)"
  grep -q -- "$meant" err || fail "no '$meant' for: $words: $(cat err)"
done << 'END'
serch x.json|did you mean search?
quer x.db|did you mean query?
search x.json --draw 5|did you mean --draws?
search x.json --max-tim=5|did you mean --max-time?
status x.db --colour never|did you mean --color?
--jsn|--jsn is no option;
status|CATALOGUE is required; see misalign status --help
query json.db bst|did you mean best?
query json.db nonsense|nonsense names no query);
fold PATTERN more|fold takes no further argument, such as more
frobnicate|frobnicate is no verb;
help serch|serch is no verb (did you mean search?)
actuators json.db 1 --stroke-limit 6|did you mean 0.06?
actuators json.db 1 --stroke-limit 600|600 is not a number from 1e-06 to 1;
certify nothing.json --to 185|^misalign: --to: 185 is not a number from 0.01 to 180;
certify nothing.json --from=185|^misalign: --from: 185 is not a number from 0.01 to 180;
contact json.db 1 --trim=-1|-1 is not a number from 0 to 1000000;
contact json.db 1 --trim 100|--trim 100: leaves nothing of an edge of draw 1
contact json.db|no DRAW is given
export json.db --best 1 --thickness 2 --output out|--thickness has no meaning without --format stl, mjcf or inp, or --kit;
search quick.json --relative-error 5|a share, not percent; did you mean 0.05?
status json.db other.db|two files match (json.db, other.db) and status takes one; name one;
query json.db other.db best|two files match (json.db, other.db)
query json.db other.db|two files match (json.db, other.db)
query json.db other.db third.db best|3 files match
replay json.db other.db 7|two files match (json.db, other.db)
actuators json.db other.db 7|two files match (json.db, other.db)
tolerance json.db other.db 7 --amplitude 0.1 --trials 9|two files match (json.db, other.db)
export --format fold json.db other.db --best 1 --output out|two files match (json.db, other.db)
report json.db other.db --output page.html|two files match (json.db, other.db)
search quick.json quick.json|two files match
status json.db nothing.db|status takes no further argument, such as nothing.db;
END
for good in "query json.db best" "export --best 1 json.db --output folder.db"; do
  # shellcheck disable=SC2086
  "$program" $good > out 2> err || fail "$good: $(cat err)"
done

# help, with or without a verb: what --help says.
for verb in "" search status help; do
  # shellcheck disable=SC2086
  "$program" help $verb > out 2> err || fail "help $verb: $(cat err)"
  # shellcheck disable=SC2086
  "$program" $verb --help | cmp -s - out || fail "help $verb is not --help: $(cat out)"
done

# Under mpirun every rank would say it; one does.
for fault in "--draw 5" "--max-time never" "--stroke-limit 6"; do
  # shellcheck disable=SC2086
  "${ranks[@]}" 4 "$program" search $campaign $fault > out 2> err
  [ "$(grep -c '^misalign: ' err)" = 1 ] || fail "four ranks with $fault: $(cat err)"
done
# A shell that a launcher started has a rank's number, and the verbs that it runs still speak.
for rank in OMPI_COMM_WORLD_RANK PMIX_RANK PMI_RANK; do
  for words in "status nothing.db" "verify nothing.db" "fold nothing.json" "config --check nothing.json" \
    "query json.db bst" frobnicate --jsn ""; do
    # shellcheck disable=SC2086
    env $rank=1 "$program" $words > out 2> err
    [ $? != 0 ] && [ -s err ] || fail "silent with $rank: misalign $words"
  done
done
finish
