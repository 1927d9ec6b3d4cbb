#!/usr/bin/env bash
# Splits the draws from 0 to DRAWS among the tasks of a Slurm array, each with a catalogue of its own, which
# queue themselves again until they are complete, and merges these into OUT.db when all are. The same call
# again goes on with what is there.
#   scripts/slurm/submit-array.sh CAMPAIGN.json OUT.db TASKS DRAWS [sbatch options]
#   scripts/slurm/submit-array.sh search/campaigns/miura-6x6.json found.db 20 100000000 --ntasks=32 --time=4:00:00
set -euo pipefail
if [ $# -lt 4 ]; then
  sed -n 's/^#   /usage: /p' "$0" | head -1 >&2
  exit 2
fi
campaign=$1
out=$2
tasks=$3
draws=$4
shift 4
root=$(cd "$(dirname "$0")/../.." && pwd)
export MISALIGN=${MISALIGN:-$(command -v misalign || echo "$root/build/release/misalign")}
number='^[1-9][0-9]*$'
if [[ ! $tasks =~ $number || ! $draws =~ $number ]] || ((draws < tasks)); then
  echo "TASKS and DRAWS must be whole numbers, and every task must have a draw" >&2
  exit 2
fi
if [ -e "$out" ]; then
  echo "$out is there already" >&2
  exit 1
fi

if ! command -v sbatch > /dev/null; then
  echo "there is no sbatch in PATH (Slurm's); call this on a login node of the cluster, or without Slurm give each" \
    "job a range of draws: search/manual/how-to/schedulers.md" >&2
  exit 1
fi

# The first draws % tasks tasks do one draw more.
list=${out%.db}.parts
parts=()
lo=0
for ((task = 1; task <= tasks; ++task)); do
  hi=$((lo + draws / tasks + (task <= draws % tasks)))
  parts+=("${out%.db}.$lo-$hi.db")
  echo "$lo:$hi ${parts[-1]}"
  lo=$hi
done > "$list"

# A task that queues itself again has not ended: the merge waits. Where a task fails, it is cancelled.
array=$(sbatch --parsable "$@" --array="1-$tasks" "$root/scripts/slurm/campaign.sbatch" "$campaign" "$list")
array=${array%%;*}
echo "array $array"
merge=$(sbatch --parsable "$@" --ntasks=1 --nodes=1 --job-name=misalign-merge \
  --dependency="afterok:$array" --kill-on-invalid-dep=yes \
  --wrap="$(printf '%q ' "$MISALIGN" merge "$out" "${parts[@]}")")
echo "merge ${merge%%;*}"
