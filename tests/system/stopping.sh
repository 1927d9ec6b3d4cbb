# Asked to stop, by signal or by time: what was done is kept, the exit is clean, and it comes in time.
# The times are printed; none is asserted.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
now_ms() { date +%s%3N; }

# To mpirun: what was done is kept, of units that no rank would finish. SIGUSR1 lets the run end; after
# TERM and INT there is half a second, and who has not come with his unit by then is not waited for: on a busy
# machine that takes several tries.
sed 's/"deploys_from_deg": [0-9]*/"deploys_from_deg": 165/' "$source_dir/search/campaigns/miura-6x6.json" > rare.json
kept() {  # SIGNAL: whether the draws that were under way are
  local signal=$1
  rm -f stopped-$signal.db*
  "${ranks[@]}" 2 "$program" search rare.json --catalogue stopped-$signal.db --draws 1000000000 \
    --unit-draws 100000000 --progress none > /dev/null 2>&1 &
  launcher=$!
  begun stopped-$signal.db
  sleep 0.5
  start=$(now_ms)
  kill -"$signal" $launcher
  wait $launcher
  code=$?
  echo "$signal to mpirun: ended after $(($(now_ms) - start)) ms"
  # mpirun itself reports a TERM or INT that it was sent; its ranks must have ended by themselves.
  [ $signal != USR1 ] || [ $code = 0 ] || fail "USR1: exit $code"
  [ "$(sql stopped-$signal.db 'SELECT end FROM run')" = stopped ] || fail "$signal: the run was not ended"
  sound_so_far stopped-$signal.db
  gives_1 stopped-$signal.db 'SELECT sum(draws) > 0 FROM unit'
}
for signal in TERM INT USR1; do eventually "$signal: nothing kept" kept $signal; done

# A worker alone is asked to stop: the run ends cleanly, nothing hangs.
"${ranks[@]}" 2 "$program" search $campaign --catalogue worker.db --draws 1000000 --progress none > /dev/null 2>&1 &
launcher=$!
begun worker.db
pkill -TERM -n -f "^$program search .*--catalogue worker.db"
wait $launcher || fail "a worker that was asked to stop"

# Wall time ends a run, not the campaign: exit 0, work remains.
"$program" search $campaign --catalogue timed.db --max-time 1 --progress none > /dev/null 2>&1 ||
  fail "--max-time"
"$program" status timed.db --check > /dev/null
[ $? = 75 ] || fail "--max-time and --check"

# Alone, and SIGUSR2 on the way: a status line, and the search goes on.
"$program" search rare.json --catalogue alone.db --draws 1000000000 --progress plain > /dev/null 2> err &
search=$!
begun alone.db
kill -USR2 $search
eventually "a status line after SIGUSR2" grep -q "draws/s" err
begun alone.db unit  # what every few seconds is handed in
start=$(now_ms)
kill -TERM $search
wait $search || fail "SIGTERM alone: exit $?"
echo "TERM alone: ended after $(($(now_ms) - start)) ms"
[ "$(sql alone.db 'SELECT sum(draws) > 0 FROM unit')" = 1 ] || fail "SIGTERM alone: nothing kept"

# Draws that take longer than anyone waits: TERM leaves without them, a second one at once, and USR1
# waits for them.
cat > slow.json << 'END'
{ "name": "slow", "pattern": { "family": "miura", "rows": 20, "columns": 20 },
  "misalignment": { "amplitude_mm": 0.01 }, "accept": { "deploys_from_deg": 20 } }
END
"$program" search slow.json --catalogue slow.db --progress none > /dev/null 2>&1 &
search=$!
begun slow.db
sleep 0.3  # into the first draws: no row tells of them
start=$(now_ms)
kill -TERM $search
wait $search
code=$? took_ms=$(($(now_ms) - start))
echo "TERM among slow draws: ended after $took_ms ms"
[ $code = 0 ] || fail "TERM among slow draws: exit $code"
sound_so_far slow.db

"$program" search slow.json --catalogue slow.db --progress none > /dev/null 2>&1 &
search=$!
begun slow.db run 2
kill -TERM $search
sleep 0.02
kill -TERM $search 2> /dev/null
wait $search
code=$?
[ $code = 0 ] || fail "a TERM passed on twice: exit $code"
sound_so_far slow.db
"$program" search slow.json --catalogue slow.db --progress none > /dev/null 2> err &
search=$!
begun slow.db run 3
kill -TERM $search
sleep 0.7
kill -TERM $search 2> /dev/null
wait $search
code=$?
[ $code = 143 ] && grep -q "same command resumes" err || [ $code = 0 ] || fail "two TERMs: exit $code: $(cat err)"
sound_so_far slow.db

before=$(sql slow.db 'SELECT coalesce(sum(draws), 0) FROM unit')
"$program" search slow.json --catalogue slow.db --progress none > /dev/null 2>&1 &
search=$!
begun slow.db run 4
sleep 0.3
kill -USR1 $search
wait $search || fail "USR1 among slow draws: exit $?"
[ "$(sql slow.db 'SELECT sum(draws) FROM unit')" -gt "$before" ] || fail "USR1 did not wait for the draws"
[ "$(sql slow.db 'SELECT end FROM run ORDER BY id DESC LIMIT 1')" = stopped ] || fail "USR1: the run's end"

# Every signal by which something ends a job, and the exit code that was asked for. A shell that ignores SIGHUP
# (nohup) hands that on.
stopped_by() {  # SIGNAL CODE WORDS...: what ends the search of these words, and with which exit code
  "$program" search rare.json --catalogue signals.db --draws 1000000000 --progress none "${@:3}" > out 2> err &
  search=$!
  begun signals.db run $((++starts))
  kill -"$1" $search
  wait $search
  code=$?
  [ $code = "$2" ] && grep -q "^signals.db: stopped, " out || fail "$1 ${*:3}: exit $code: $(cat out err)"
  [ ! -e signals.db-wal ] && [ "$(stat -c %s signals.db)" -gt 4096 ] || fail "$1: $(ls -l signals.db*)"
}
starts=0
for signal in HUP XCPU ALRM; do stopped_by $signal 0; done
stopped_by INT 85 --stopped-exit 85
stopped_by USR1 200 --stopped-exit 200 --ranks 2
stopped_by TERM 143 --stopped-exit 143 --ranks 2
"$program" search rare.json --catalogue signals.db --stopped-exit 85 --max-time 0.2 --progress none > /dev/null 2>&1
[ $? = 85 ] || fail "--max-time and --stopped-exit"
starts=$((starts + 1))
"$program" search $campaign --catalogue ended.db --stopped-exit 85 --draws 500 --progress none > /dev/null 2>&1 ||
  fail "--stopped-exit of a search that is complete: exit $?"
(trap '' HUP && exec "$program" search rare.json --catalogue nohup.db --draws 1000000000 --progress none) > out 2> err &
search=$!
begun nohup.db
kill -HUP $search
sleep 0.2
kill -TERM $search
wait $search || fail "nohup: exit $?"

# Beside eight loops: one sentence, one file, one run that was ended.
busy=()
for ((k = 0; k < 8; ++k)); do
  while :; do :; done &
  busy+=($!)
done
trap 'kill "${busy[@]}" 2> /dev/null; rm -rf "$work"' EXIT
for signal in TERM INT; do stopped_by $signal 0; done
busy_ranks() {  # whether two ranks of mpirun leave as one process does
  rm -f busy.db*
  "${ranks[@]}" 2 "$program" search rare.json --catalogue busy.db --draws 1000000000 --progress none > out 2> err &
  launcher=$!
  begun busy.db
  kill -TERM $launcher
  wait $launcher
  grep -q "^busy.db: stopped, " out && [ ! -e busy.db-wal ] && [ "$(stat -c %s busy.db)" -gt 4096 ]
}
eventually "two ranks on a busy machine" busy_ranks
sound_so_far busy.db
kill "${busy[@]}"

# Tasks of srun or flux that MPI does not join would make the same draws each: said before anything is written. A
# script in a larger allocation is no task, a daemon of mpirun is one of others, and who says so is meant.
task() { env SLURM_JOB_ID=1 SLURM_NTASKS=4 SLURM_PROCID=1 "$@" --catalogue task.db --draws 200 --progress none; }
search_as() { task "$@" > out 2> err; }
for sizes in "SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=4" "FLUX_JOB_SIZE=4 FLUX_TASK_RANK=1" "PMI_SIZE=4"; do
  # shellcheck disable=SC2086
  search_as $sizes "$program" search $campaign
  [ $? = 2 ] && grep -q "has started 4 tasks (.*), but MPI counts 1 rank" err || fail "$sizes: $(cat err)"
  [ ! -e task.db ] || fail "$sizes: a catalogue"
done
step=(SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=4)
for meant in "" "${step[*]} --range 0:100" "${step[*]} --ranks 1" "SLURM_STEP_NUM_TASKS=1"; do
  read -ra words <<< "$meant"
  mapfile -t variables < <(printf '%s\n' "${words[@]}" | grep =)
  mapfile -t options < <(printf '%s\n' "${words[@]}" | grep -v =)
  search_as ${variables[0]:+"${variables[@]}"} "$program" search $campaign ${options[0]:+"${options[@]}"} ||
    fail "$meant: $(cat err)"
  rm -f task.db*
done
for n in 1 2; do
  search_as "${step[@]}" "${ranks[@]}" $n "$program" search $campaign || fail "mpirun -n $n in a step: $(cat err)"
done
[ "$(sql task.db 'SELECT group_concat(ranks) FROM run')" = 1 ] || fail "a complete search begins a run"

# A second search is refused at once; when the first one is killed, its catalogue is free at once.
"$program" search $campaign --catalogue held.db --draws 1000000000 --progress none > /dev/null 2>&1 &
search=$!
begun held.db
start=$(now_ms)
"$program" search $campaign --catalogue held.db --progress none > /dev/null 2> err
[ $? = 4 ] || fail "a catalogue in use: exit $?"
grep -q "another search" err || fail "a catalogue in use: $(cat err)"
echo "a catalogue in use: refused after $(($(now_ms) - start)) ms"
kill -KILL $search
wait $search 2> /dev/null
"$program" search $campaign --catalogue held.db --max-time 0.2 --progress none > /dev/null 2>&1 ||
  fail "after a kill the catalogue is not free"
sound_so_far held.db

# The rate is known well enough at the same draw for any number of ranks.
for n in 1 3; do
  "${ranks[@]}" $n "$program" search $campaign --catalogue known-$n.db --relative-error 0.02 --draws 1000000 \
    --unit-draws 100 --progress none > /dev/null 2>&1 || fail "--relative-error with $n ranks"
  "$program" status known-$n.db --check > /dev/null || fail "--relative-error: not complete"
done
[ "$(digest_of known-1.db)" = "$(digest_of known-3.db)" ] || fail "--relative-error: another digest"
[ "$(sql known-1.db 'SELECT goal_end % 4096 FROM campaign')" = 0 ] || fail "--relative-error: its end"
finish
