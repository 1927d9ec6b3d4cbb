# A campaign killed again and again, ranks and mpirun, in every way and at any moment: nothing is lost or
# counted twice, and every time it gets to its end the digest is that of an undisturbed run.
# The long form: kill_campaign.sh PROGRAM SOURCE_DIR 250 [SEED]; SIGNALS="KILL" for kill -9 alone; ALONE=1 for
# one process without mpirun, which dies and starts ten times as often in the same time.
. "$(dirname "$0")/lib.sh"
kills_wanted=${3:-10}
RANDOM=${4:-1}
echo "seed ${4:-1}"
campaign=quick.json
quick_campaign $campaign
# As much as one rank does in three seconds on this machine: some kills fall into every round.
"$program" search $campaign --catalogue calm.db --max-time 3 --progress none > /dev/null 2>&1
draws=$(sql calm.db 'SELECT sum(draws) FROM unit')
expected=$(digest_of calm.db)

# The processes that work on the catalogue.
ranks_of() { pgrep -f "^$program search .*--catalogue $PWD/killed.db"; }

read -ra signals <<< "${SIGNALS:-KILL TERM USR1}"
kills=0 rounds=0 resumes=0 slowest_ms=0 lingered=0
declare -A counts
while [ $kills -lt "$kills_wanted" ] || [ $rounds = 0 ]; do
  n=$((resumes % 4 + 1))
  resumes=$((resumes + 1))
  start=("${ranks[@]}" $n)
  [ -n "${ALONE:-}" ] && start=(env)
  "${start[@]}" "$program" search $campaign --catalogue "$PWD/killed.db" --draws "$draws" \
    --unit-draws $((20 + RANDOM % 400)) --progress none > out 2> err &
  launcher=$!
  if [ $kills -lt "$kills_wanted" ]; then
    sleep 0.$((RANDOM % 10))$((RANDOM % 10))
    signal=${signals[RANDOM % ${#signals[@]}]}
    case $((RANDOM % 3)) in
      0) victim=mpirun pids=$launcher ;;
      1) victim=rank pids=$(ranks_of | shuf -n 1 --random-source=<(yes $RANDOM)) ;;
      2) victim=all pids="$launcher $(ranks_of)" ;;
    esac
    # shellcheck disable=SC2086
    if kill -$signal $pids 2> /dev/null; then
      kills=$((kills + 1))
      counts[$signal-$victim]=$((${counts[$signal-$victim]:-0} + 1))
    fi
    start_ms=$(date +%s%3N)
    # Ranks that have lost their mpirun end by themselves. mpirun 4.1 itself now and then waits for ever
    # for a rank that died while it was being started: alone for five seconds, it is killed.
    alone=0
    none_left() {
      if ranks_of > /dev/null; then
        alone=0
        return 1
      fi
      alone=$((alone + 1))
      ! kill -0 $launcher 2> /dev/null || [ $alone -gt 100 ]
    }
    eventually "the end of all ranks" none_left
    if ranks_of > left; then
      fail "left after $signal to $victim: $(xargs ps -o pid=,stat=,wchan:20=,args= -p < left)"
      # shellcheck disable=SC2086
      [ -z "${STACKS:-}" ] || for pid in $(cat left); do gdb -batch -ex 'thread apply all bt' -p $pid 2> /dev/null; done
      pkill -KILL -f -- "$PWD/killed.db"
    fi
    took_ms=$(($(date +%s%3N) - start_ms))
    [ $took_ms -gt $slowest_ms ] && slowest_ms=$took_ms
    kill -KILL $launcher 2> /dev/null && lingered=$((lingered + 1))
    wait $launcher 2> /dev/null
    # Killed before there was anything; what a killed transaction has left is rolled back by a writer.
    [ -s killed.db ] && [ "$(sqlite3 killed.db 'SELECT count(*) FROM sqlite_schema')" != 0 ] || continue
    sound_so_far killed.db
  else
    wait $launcher || { fail "resume"; cat err; }
  fi
  if "$program" status killed.db --check > /dev/null 2>&1; then
    rounds=$((rounds + 1))
    sound killed.db "$draws"
    [ "$(digest_of killed.db)" = "$expected" ] || fail "round $rounds: another digest"
    rm -f killed.db*
  fi
  [ $failures -gt 5 ] && break
done
for kind in "${!counts[@]}"; do echo "$kind ${counts[$kind]}"; done | sort
echo "$kills kills in $rounds campaigns, $resumes starts; the last rank was gone after $slowest_ms ms at most"
[ $lingered = 0 ] || echo "mpirun alone was left $lingered times"
finish
