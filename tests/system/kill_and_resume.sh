# Killed with -9 at any moment and resumed, or asked to stop: the same digest as undisturbed.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
# As much as one rank does in four seconds on this machine: no kill may come after the end.
"$program" search "$campaign" --catalogue calm.db --max-time 4 --progress none > /dev/null 2>&1
draws=$(sql calm.db 'SELECT sum(draws) FROM unit')
expected=$(digest_of calm.db)

units() { sql killed.db 'SELECT count(*) FROM unit' 2> /dev/null || echo 0; }

kills=0
for n in 1 2 3 2; do
  before=$(units)
  "${ranks[@]}" $n "$program" search "$campaign" --catalogue killed.db --draws "$draws" --unit-draws 20 --progress none \
    > /dev/null 2>&1 &
  launcher=$!
  for wait in {1..400}; do
    [ "$(units)" -gt "$before" ] && break
    sleep 0.05
  done
  sleep 0.$((RANDOM % 2))$((RANDOM % 10))
  # In turn one rank, and everything at once with the launcher.
  if [ $((kills % 2)) = 0 ]; then
    pkill -KILL -n -f "^$program search .*--catalogue killed.db" && kills=$((kills + 1))
  else
    pkill -KILL -f -- "--catalogue killed.db" && kills=$((kills + 1))
  fi
  wait $launcher 2> /dev/null
  [ "$(sql killed.db 'PRAGMA integrity_check')" = ok ] || fail "integrity after kill $kills"
done
[ $kills = 4 ] || fail "only $kills of 4 kills hit"
done_before=$(sql killed.db 'SELECT coalesce(sum(draws), 0) FROM unit')
[ "$done_before" -gt 0 ] || fail "nothing was committed before the kills"
[ "$done_before" -lt "$draws" ] || fail "the kills came too late to test anything"
"$program" status killed.db --check > /dev/null
[ $? = 75 ] || fail "status --check before the end"
"${ranks[@]}" 2 "$program" search "$campaign" --catalogue killed.db --draws "$draws" --progress none > /dev/null 2>&1 ||
  fail "resume"
sound killed.db "$draws"
[ "$(digest_of killed.db)" = "$expected" ] || fail "killed and resumed: another digest"
"$program" status killed.db --check > /dev/null || fail "status --check at the end"

# Asked to stop: exit 0, and what was done is kept, parts of units too.
for signal in TERM INT USR1; do
  "${ranks[@]}" 2 "$program" search "$campaign" --catalogue stopped-$signal.db --draws 1000000 --unit-draws 100000 \
    --progress none > /dev/null 2>&1 &
  launcher=$!
  sleep 1.5
  kill -$signal $launcher
  wait $launcher
  code=$?
  # mpirun itself reports a TERM or INT that it was sent; its ranks must have ended by themselves.
  [ $signal != USR1 ] || [ $code = 0 ] || fail "USR1: exit $code"
  [ "$(sql stopped-$signal.db 'SELECT sum(draws) > 0 FROM unit')" = 1 ] || fail "$signal: nothing kept"
  [ "$(sql stopped-$signal.db "SELECT count(*) FROM run WHERE end = 'stopped'")" = 1 ] ||
    fail "$signal: the run was not ended"
done

# A worker alone is asked to stop: the run ends cleanly, nothing hangs.
"${ranks[@]}" 2 "$program" search "$campaign" --catalogue worker.db --draws 1000000 --progress none > /dev/null 2>&1 &
launcher=$!
sleep 1.5
pkill -TERM -n -f "^$program search .*--catalogue worker.db"
wait $launcher || fail "a worker that was asked to stop"

# Wall time ends a run, not the campaign: exit 0, work remains.
"$program" search "$campaign" --catalogue timed.db --max-time 1 --progress none > /dev/null 2>&1 ||
  fail "--max-time"
"$program" status timed.db --check > /dev/null
[ $? = 75 ] || fail "--max-time and --check"

# Alone: SIGTERM ends it within a second, with exit 0.
"$program" search "$campaign" --catalogue alone.db --progress none > /dev/null 2>&1 &
search=$!
sleep 1
kill -TERM $search
wait $search || fail "SIGTERM alone: exit $?"
[ "$(sql alone.db 'SELECT sum(draws) > 0 FROM unit')" = 1 ] || fail "SIGTERM alone: nothing kept"
finish
