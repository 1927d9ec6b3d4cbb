# The job scripts on a Slurm of this test's own: two nodes of one CPU each, both on this machine, so that
# mpirun starts its second rank through Slurm. Stopped in every way and queued again, a campaign gives the
# same digest as undisturbed. Called as TEST.sh PROGRAM SOURCE_DIR; as root it installs Slurm if need be.
. "$2/scripts/packages.sh"
# shellcheck disable=SC2086
need_packages $slurm_packages openmpi-bin sqlite3
. "$(dirname "$0")/../system/lib.sh"
# The job scripts must do without.
unset OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_pml OMPI_MCA_btl
export MISALIGN=$program SLURM_CONF=$work/slurm.conf PATH=$PATH:/usr/sbin
scripts=$source_dir/scripts/slurm

# The daemons and what they started are known by SLURM_CONF in their environment.
stop_cluster() {
  scancel --quiet --user="$(id -un)" 2> /dev/null
  for wait in {1..50}; do
    [ -z "$(squeue --noheader 2> /dev/null)" ] && break
    sleep 0.1
  done
  scontrol shutdown 2> /dev/null
  munged --stop --socket="$work/munge.socket" > /dev/null 2>&1
  sleep 0.5
  for process in /proc/[0-9]*; do
    grep -qsz "^SLURM_CONF=$work/" "$process/environ" && kill -KILL "${process#/proc/}" 2> /dev/null
  done
  [ "$failures" = 0 ] || tail -n 30 ./*.out ./*.log
  rm -rf "$work"
}
trap stop_cluster EXIT

# give_up WHAT: where nothing that follows could be right.
give_up() {
  fail "$@"
  finish
}

# until_true SECONDS COMMAND...: tries five times a second.
until_true() {
  for ((wait = $1 * 5; wait > 0; --wait)); do
    "${@:2}" && return
    sleep 0.2
  done
  return 1
}

host=$(hostname -s)
second=$host-second
port=$((20000 + RANDOM % 10000))
cat > "$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd-%n.log
PlugStackConfig=/dev/null
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,sched_min_interval=0,bf_interval=1
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 Port=$((port + 1))
NodeName=$second NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2))
PartitionName=usual Nodes=ALL Default=YES
PartitionName=urgent Nodes=ALL PriorityTier=2
CONF
mkdir state
(umask 077 && head -c 1024 /dev/urandom > munge.key)
# --force: the socket lies in a directory that nobody else may enter.
munged --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munge.pid" \
  --log-file="$work/munge.log" --seed-file="$work/munge.seed" > munged.log 2>&1 || give_up "munged"
slurmctld && slurmd -N "$host" && slurmd -N "$second" || give_up "Slurm's daemons"
started=$SECONDS
idle_nodes() { [ "$(sinfo --noheader --partition=usual --states=idle --format=%D 2> /dev/null)" = "$1" ]; }
until_true 20 idle_nodes 2 || give_up "no cluster of two nodes"

# show JOB KEY: what Slurm says about a job. An array's task is named ARRAY_TASK.
show() { scontrol show job "$1" 2> /dev/null | sed -n "s/.*\b$2=\([^ ]*\).*/\1/p"; }
in_state() { [ "$(show "$1" JobState)" = "$2" ]; }

# at_work JOB CATALOGUE N: waits until the job's Nth start has committed draws.
committed() { [ "$(sql "$1" "SELECT count(*) > 0 FROM unit WHERE run = $2" 2> /dev/null)" = 1 ]; }
at_work() { until_true 20 committed "$2" "$3" || give_up "job $1 does nothing"; }

# queued_again JOB N WHAT: waits until the job is in the queue again for the Nth time. Slurm would leave it there
# for two minutes. go_on has it start sooner, but not in the second it ended: slurmd, which was told to end it,
# would refuse it.
in_queue() { [ "$(show "$1" Restarts)" = "$2" ] && in_state "$1" PENDING; }
queued_again() { until_true 40 in_queue "$1" "$2" || give_up "$3: job $1 was not queued again"; }
go_on() { scontrol update JobId="$1" StartTime=now+2 || give_up "job $1 cannot go on"; }

# stop_draws N: how many draws quick.json wants.
quick_campaign endless.json
stop_draws() { sed "s/\"draws\": [0-9]*/\"draws\": $1/" endless.json > quick.json; }
stop_draws 1000000000
submit() { sbatch --parsable --output="$1.out" "${@:2}" || fail "sbatch"; }

# undisturbed FILE: all of $draws at once, without Slurm.
undisturbed() {
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "${ranks[@]}" 2 "$program" search quick.json \
    --catalogue "$1" --draws $draws --progress none > /dev/null 2>&1 || fail "undisturbed"
}

# A search that fails is not queued again, nor is a job that somebody cancels.
echo "no catalogue, but enough text to be none" > text.db
failing=$(submit failing "$scripts/campaign.sbatch" quick.json text.db)
mkdir -p build/release && ln -s "$program" build/release/misalign
cancelled=$(MISALIGN='' submit cancelled --time=10 "$scripts/campaign.sbatch" quick.json cancelled.db)
at_work "$cancelled" cancelled.db 1
scancel "$cancelled"
until_true 10 in_state "$cancelled" CANCELLED || fail "a cancelled job: $(show "$cancelled" JobState)"
until_true 10 in_state "$failing" FAILED || fail "a failing job: $(show "$failing" JobState)"
[ "$(show "$failing" ExitCode)" = 3:0 ] || fail "a failing job's exit code: $(show "$failing" ExitCode)"
[ "$(show "$cancelled" Restarts)$(show "$failing" Restarts)" = 00 ] || fail "queued again"
echo "$((SECONDS - started)) s: failing and cancelled"

# A single job is stopped by its time limit. Slurm looks at these every half a minute since its start: the job
# shall have time to start until then, and no more.
until (((SECONDS - started) % 31 >= 18 && (SECONDS - started) % 31 < 25)); do sleep 0.2; done
job=$(submit single --ntasks=2 --nodes=2 --time=1 --signal=B:USR1@50 "$scripts/campaign.sbatch" quick.json single.db)
at_work "$job" single.db 1
queued_again "$job" 1 "time limit"
grep -Eq "search --max-time (29|30)$" single.out || fail "the time that is left"
[ "$(sql single.db 'SELECT "end" || ranks FROM run')" = stopped2 ] || fail "the signal did not reach the ranks"
echo "$((SECONDS - started)) s: time limit"

# Then it gives way to another job, and Slurm queues it again.
scontrol update JobId="$job" TimeLimit=10
go_on "$job"
at_work "$job" single.db 2
submit urgent --partition=urgent --ntasks=2 --nodes=2 --wrap="sleep 1" > /dev/null
queued_again "$job" 2 "preempted"
until_true 10 idle_nodes 2
echo "$((SECONDS - started)) s: preempted"

# Then the second node's rank and what mpirun started there are killed: mpirun fails.
go_on "$job"
at_work "$job" single.db 3
for process in $(scontrol listpids "$job.0" "$second" | awk '$1 + 0 > 1 { print $1 }'); do
  kill -KILL "$process"
done
queued_again "$job" 3 "a lost node"
echo "$((SECONDS - started)) s: lost ranks"

# Then the second node is down.
go_on "$job"
at_work "$job" single.db 4
scontrol update NodeName="$second" State=DOWN Reason=test
queued_again "$job" 4 "a node that is down"
scontrol update NodeName="$second" State=RESUME 2> /dev/null
until_true 20 idle_nodes 2 || fail "the second node is not back"

# At last it may complete, not far from here. What it did beyond stays in the catalogue, but not in the digest.
draws=$(sql single.db 'SELECT min(lo) + 5000 FROM gaps')
stop_draws $draws
go_on "$job"
until_true 30 in_state "$job" COMPLETED || give_up "the last start: $(show "$job" JobState)"
sound_so_far single.db
[ "$(sql single.db 'SELECT count(*) FROM run')" = 5 ] || fail "not five runs"
undisturbed undisturbed.db
[ "$(digest_of single.db)" = "$(digest_of undisturbed.db)" ] || fail "single job: another digest"
echo "$((SECONDS - started)) s: complete, $draws draws"

# An array: its first and its last task, of a few seconds, are stopped and queue themselves again. The last
# one's job number is that of the whole array. The merge waits for all.
if "$program" --help | grep -q '^ *merge '; then
  third=$(sql single.db 'SELECT CAST(2.5 * sum(draws) / sum(seconds) AS INTEGER) FROM unit')
  draws=$((third * 3))
  undisturbed undisturbed-array.db
  "$scripts/submit-array.sh" quick.json joined.db 3 $draws --output=%x-%j.out --time=10 > jobs ||
    give_up "submit-array.sh"
  array=$(sed -n 's/^array //p' jobs)
  merge=$(sed -n 's/^merge //p' jobs)
  for task in 1 3; do
    at_work "${array}_$task" "joined.$(((task - 1) * third))-$((task * third)).db" 1
    scancel --batch --signal=USR1 "${array}_$task"
    queued_again "${array}_$task" 1 "task $task"
    [ "$(show "$merge" Reason)" = Dependency ] || fail "the merge did not wait for task $task"
    go_on "${array}_$task"
  done
  until_true 30 in_state "$merge" COMPLETED || give_up "the merge: $(show "$merge" JobState)"
  [ "$(show "${array}_2" Restarts)" = 0 ] || fail "task 2 was queued again with another one"
  sound joined.db $draws
  [ "$(digest_of joined.db)" = "$(digest_of undisturbed-array.db)" ] || fail "array: another digest"
else
  echo "without the array: the program has no verb merge"
fi
echo "$((SECONDS - started)) s: array"
finish
