# search --ranks: it starts mpirun itself, gives the same answers, and ends as the program alone would.
. "$(dirname "$0")/lib.sh"
unset OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_pml OMPI_MCA_btl  # a user has not set them
campaign=quick.json
quick_campaign $campaign

# Any number of ranks, more than there are cores too: the same digest.
for n in 1 2 5 all; do
  "$program" search --ranks $n $campaign --catalogue ranks-$n.db --draws 1500 --unit-draws 37 --progress none \
    < /dev/null > out 2> err || { fail "--ranks $n"; cat err; }
  [ "$(cut -d: -f1 out)" = ranks-$n.db ] && [ "$(wc -l < out)" = 1 ] || fail "--ranks $n: $(cat out)"
  ranks_of_run=$(sql ranks-$n.db 'SELECT ranks FROM run')
  [ $n = all ] && [ "$ranks_of_run" = "$(nproc)" ] || [ "$ranks_of_run" = $n ] || fail "--ranks $n: $ranks_of_run ranks"
  sound ranks-$n.db 1500
  [ "$(digest_of ranks-$n.db)" = "$(digest_of ranks-1.db)" ] || fail "--ranks $n: another digest"
done
"$program" search $campaign --ranks=2 --catalogue=ranks-2.db --draws 1600 --progress none > /dev/null 2>&1 ||
  fail "--ranks=2"
[ "$(sql ranks-2.db 'SELECT count(*) FROM run WHERE ranks = 2')" = 2 ] || fail "--ranks=2: not resumed"

# Alone nothing of MPI is asked for, which here could not even begin.
OMPI_MCA_pml=none "$program" search $campaign --catalogue alone.db --draws 200 --progress none > /dev/null 2> err ||
  fail "alone, where MPI cannot begin: $(cat err)"

# A parent that ignores its children's ends hands that on; the program waits for mpirun all the same.
timeout $patience_s perl -e '$SIG{CHLD} = "IGNORE"; exec @ARGV' "$program" search $campaign --ranks 2 \
  --catalogue ranks-2.db --draws 1700 --progress none > /dev/null 2>&1 < /dev/null || fail "children ignored: exit code $?"

# What is in standard input is for others.
printf 'one\ntwo\n' | { "$program" search $campaign --ranks 2 --catalogue ranks-2.db --draws 1600 > /dev/null 2>&1; cat; } > left
[ "$(wc -l < left)" = 2 ] || fail "standard input was read: $(cat left)"

# What a rank refuses is said once, with its exit code, and mpirun adds nothing.
# refused CODE PATTERN WORDS...
refused() {
  "$program" search "${@:3}" > out 2> err < /dev/null
  local code=$?
  [ $code = "$1" ] && [ "$(wc -l < err)" = 1 ] && grep -q -- "$2" err || fail "exit $code for ${*:3}: $(cat err)"
}
refused 3 "cannot be opened" nothing.json --ranks 2
refused 5 "another campaign" $campaign --seed 7 --catalogue ranks-2.db --ranks 2
for count in 0 -1 1.5 many 5000 ""; do refused 2 "neither all nor a whole number" $campaign --ranks "$count"; done
refused 2 "did you mean --ranks?" $campaign --rank 2
mkdir nothing
PATH=$PWD/nothing "$program" search $campaign --ranks 2 --catalogue none.db > out 2> err
[ $? = 1 ] && [ "$(wc -l < err)" = 1 ] && grep -q "mpirun is not in PATH" err || fail "without mpirun: $(cat err)"
printf '#!/bin/sh\nexit 213\n' > nothing/mpirun && chmod +x nothing/mpirun
PATH=$PWD/nothing:$PATH "$program" search $campaign --ranks 2 --catalogue none.db > out 2> err
[ $? = 1 ] && [ "$(wc -l < err)" = 1 ] && grep -q "could not start 2 ranks" err || fail "an mpirun that cannot: $(cat err)"
[ ! -e none.db ] || fail "a catalogue that no rank made"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
"${ranks[@]}" 2 "$program" search $campaign --ranks 2 > out 2> err
[ "$(grep -c 'no meaning under mpirun' err)" = 1 ] || fail "under mpirun: $(cat err)"
unset OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM

# One core of several: what would use all of them is said, and can be typed; nowhere else.
"$program" search $campaign --catalogue "one core.db" --draws 200 > /dev/null 2> err || fail "one core"
if [ "$(nproc)" -gt 1 ]; then
  sed -n 's/^misalign: using one core of [0-9]*; to use all: //p' err > command
  [ "$(wc -l < command)" = 1 ] || fail "one core: $(cat err)"
  sed 's/--draws 200/--draws 300/' command > more
  bash -e more > out 2>&1 || fail "$(cat more): $(cat out)"
  [ "$(sql "one core.db" 'SELECT ranks FROM run WHERE id = 2')" = "$(nproc)" ] || fail "$(cat more): not all cores"
fi
for quiet in "--ranks 1" "--ranks 2" "--progress none" "--progress json"; do
  # shellcheck disable=SC2086
  "$program" search $campaign --catalogue quiet.db --draws 200 $quiet 2>&1 | grep "one core" && fail "said with $quiet"
done
taskset -c 0 "$program" search $campaign --catalogue quiet.db --draws 200 2>&1 | grep "one core" && fail "said on one core"

# On a terminal: the live line, as alone, within its width.
script -qec "stty cols 60; echo \$\$ > pid; exec '$program' search $campaign --ranks 2 --catalogue bar.db --draws 1000000000" \
  /dev/null > shown < /dev/null &
terminal=$!
live_lines() {
  tr '\r' '\n' < shown | grep $'draws.*\x1b\\[K' | sed $'s/\x1b\\[K//' > lines
  [ "$(wc -l < lines)" -ge 2 ]
}
eventually "two live lines" live_lines
kill -USR1 "$(cat pid)"
wait $terminal
while IFS= read -r line; do [ ${#line} -lt 60 ] || fail "a live line of ${#line} columns: $line"; done < lines

# said: what is on standard error but the line that every run begins with, and what is left out where draws or a
# commit take long: mpirun ends the ranks that are left by the signal that asks them to stop.
said() {
  grep -v "^misalign: campaign \|^misalign: stopped without the draws under way\|^misalign: asked to stop while the" err
}

# Signals, to the program as to the program alone: everything is kept, and the exit code is 0. INT comes
# from a terminal, to all of its processes.
for signal in TERM INT USR1; do
  setsid "$program" search $campaign --ranks 2 --catalogue $signal.db --draws 1000000000 --progress none > out 2> err &
  search=$!
  begun $signal.db unit
  if [ $signal = INT ]; then kill -INT -$search; else kill -$signal $search; fi
  wait $search
  code=$?
  [ $code = 0 ] && [ -z "$(said)" ] || fail "$signal: exit $code: $(cat err)"
  grep -q "^$signal.db: stopped, " out || fail "$signal: no summary: $(cat out err)"
  [ "$(sql $signal.db 'SELECT end FROM run')" = stopped ] || fail "$signal: the run was not ended"
  [ "$(sql $signal.db 'SELECT sum(draws) > 0 FROM unit')" = 1 ] || fail "$signal: nothing kept"
  sound_so_far $signal.db
done
"$program" search $campaign --ranks 2 --catalogue usr2.db --draws 1000000000 --progress plain > out 2> err &
search=$!
begun usr2.db
kill -USR2 $search
eventually "a status line after SIGUSR2" grep -q "draws/s" err
kill -TERM $search
wait $search || fail "TERM after USR2: exit $?"

# Draws that take longer than anyone waits: TERM leaves without them, with 0.
cat > slow.json << 'END'
{ "name": "slow", "pattern": { "family": "miura", "rows": 20, "columns": 20 },
  "misalignment": { "amplitude_mm": 0.01 }, "accept": { "deploys_from_deg": 20 } }
END
"$program" search slow.json --ranks 2 --catalogue slow.db --progress none > out 2> err &
search=$!
begun slow.db
sleep 0.3  # into the first draws: no row tells of them
kill -TERM $search
wait $search
code=$?
[ $code = 0 ] && [ -z "$(said)" ] || fail "TERM among slow draws: exit $code: $(cat err)"
sound_so_far slow.db

# A rank that dies is a failure in one sentence; a starter that dies takes the ranks with it.
"$program" search $campaign --ranks 2 --catalogue lost.db --draws 1000000000 --progress none > out 2> err &
search=$!
begun lost.db
worker=$(pgrep -n -f "^$program search .*--catalogue lost.db")
kill -KILL "$worker"
wait $search
code=$?
[ $code = 1 ] && [ "$(said | grep '^misalign: ')" = "$(grep '^misalign: a rank was killed from outside' err)" ] ||
  fail "a lost rank: exit $code: $(cat err)"
{ "$program" search $campaign --ranks 2 --catalogue lost.db --draws 1000000000 --progress none & } > /dev/null 2>&1
search=$!
begun lost.db run 2
kill -KILL $search
{ wait $search; } 2> /dev/null
free() { "$program" search $campaign --catalogue lost.db --max-time 0.1 --progress none > /dev/null 2> err; }
eventually "the catalogue of a starter that was killed is free" free
[ -z "$(said)" ] || fail "after a starter that was killed: $(cat err)"
sound_so_far lost.db
finish
