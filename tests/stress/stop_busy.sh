#!/usr/bin/env bash
# Stops searches beside loops that never rest: does each say how far it is, and leave a whole file?
#   stop_busy.sh PROGRAM [--loops N] TIMES RANKS SIGNAL
# N loops (8); so many TIMES; RANKS alone, mpirun (two ranks of it) or starter (--ranks 2); SIGNAL TERM or INT. Ten
# stops in turn go into one catalogue, which then goes on to its end: has it the digest of a run without a break?
# A line for each kind of end, and at last what was counted.
set -uo pipefail
program=$(realpath "$1")
source_dir=$(realpath "$(dirname "$0")/../..")
shift
loops=8
[ "${1:-}" = --loops ] && loops=$2 && shift 2
times=$1 ranks=$2 signal=$3
work=$(mktemp -d)
cd "$work" || exit 1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader
draws=3000
sed 's/"end_deg": 180/"end_deg": 30/; s/"deploys_from_deg": 150/"deploys_from_deg": 20/' \
  "$source_dir/search/campaigns/miura-4x4.json" > quick.json
digest() { "$program" status "$1" --json 2> /dev/null | sed -n 's/.*"digest": "\(.*\)".*/\1/p'; }
"$program" search quick.json --catalogue calm.db --draws $draws --progress none > /dev/null 2>&1
expected=$(digest calm.db)
busy=()
trap 'kill "${busy[@]}" 2> /dev/null; rm -rf "$work"' EXIT
for ((k = 0; k < loops; ++k)); do
  while :; do :; done &
  busy+=($!)
done
case $ranks in
  alone) start=("$program") more=() ;;
  mpirun) start=(mpirun --oversubscribe --bind-to none -n 2 "$program") more=() ;;
  starter) start=("$program") more=(--ranks 2) ;;
  *) echo "RANKS is alone, mpirun or starter" >&2 && exit 2 ;;
esac

summaries=0 sentences=0 silent=0 logs=0 bare=0 unended=0 digests=0 campaigns=0 longest_ms=0 least=
declare -A codes
# A run is under way once its row is there; the log is read too.
runs() { sqlite3 -readonly try.db 'SELECT count(*) FROM run' 2> /dev/null || echo 0; }
for ((k = 1; k <= times; ++k)); do
  before=$(runs)
  "${start[@]}" search quick.json --catalogue try.db --draws 1000000000 --unit-draws 200 --progress none "${more[@]}" \
    > out 2> err &
  search=$!
  until [ "$(runs)" -gt "$before" ]; do sleep 0.05; done
  sleep $((RANDOM % 2)).$((RANDOM % 10))
  begin=$(date +%s%3N)
  kill -"$signal" $search
  wait $search
  code=$?
  took=$(($(date +%s%3N) - begin))
  codes[$code]=$((${codes[$code]:-0} + 1))
  [ $took -gt $longest_ms ] && longest_ms=$took
  bytes=$(stat -c %s try.db)
  [ -z "$least" ] || [ "$bytes" -lt "$least" ] && least=$bytes
  [ "$bytes" -gt 4096 ] || bare=$((bare + 1))
  [ ! -e try.db-wal ] || logs=$((logs + 1))
  if grep -q "^try.db: stopped, .* digest" out; then
    summaries=$((summaries + 1))
  elif grep -q "^misalign: .*same command" err; then
    sentences=$((sentences + 1))
  else
    silent=$((silent + 1))
    echo "silent: try $k, exit $code after $took ms: $(tr '\n' ' ' < err | head -c 300)"
  fi
  [ "$(sqlite3 -readonly try.db 'SELECT end FROM run ORDER BY id DESC LIMIT 1')" = stopped ] || unended=$((unended + 1))
  if ((k % 10 == 0 || k == times)); then
    "$program" search quick.json --catalogue try.db --draws $draws --progress none > /dev/null 2>&1
    campaigns=$((campaigns + 1))
    [ "$(digest try.db)" = "$expected" ] && digests=$((digests + 1))
    rm -f try.db*
  fi
done
exits=$(for code in "${!codes[@]}"; do echo -n " $code (${codes[$code]} times)"; done)
echo "SIG$signal $ranks: $times stops beside $loops loops on $(nproc) cores, load $(cut -d' ' -f1 /proc/loadavg):" \
  "$summaries summaries, $sentences other sentences, $silent silent; exit codes$exits; $logs logs left," \
  "$bare bare files (the least $least bytes), $unended runs without an end; $digests of $campaigns digests equal;" \
  "the longest took $longest_ms ms"
[ $silent = 0 ] && [ $digests = $campaigns ]
