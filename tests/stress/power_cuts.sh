#!/usr/bin/env bash
# Power cuts under a real file system: ext4 on a loop device, whose image is copied as it is at a random moment. What the
# system has not written back by then is lost, as on a machine that goes dark. The next start is from the copy.
#   power_cuts.sh PROGRAM [TIMES [SEED]]   (as root)
# After each cut the file system must be mounted, the catalogue must be readable and pass `verify`, and every draw that
# `status` had counted before must be there. A campaign that comes to its end must have the digest of an undisturbed one.
# The copy is of a moment in which nothing was written to the device for a copy's time.
set -uo pipefail
program=$(realpath "$1")
source_dir=$(realpath "$(dirname "$0")/../..")
times=${2:-100}
RANDOM=${3:-1}
work=$(mktemp -d -p /dev/shm)
disk=$work/disk
mkdir "$disk"
trap 'kill -9 $search 2> /dev/null; umount -l "$disk" 2> /dev/null; rm -rf "$work"' EXIT
draws=8000
sed 's/"end_deg": 180/"end_deg": 30/; s/"deploys_from_deg": 150/"deploys_from_deg": 20/' \
  "$source_dir/search/campaigns/miura-4x4.json" > "$work/quick.json"
field() { "$program" status "$1" --json 2> /dev/null | sed -n "s/^ *\"$2\": \"\?\([^\",]*\).*/\1/p" | head -1; }
"$program" search "$work/quick.json" --catalogue "$work/calm.db" --draws $draws --progress none > /dev/null 2>&1
expected=$(field "$work/calm.db" digest)
format() {
  truncate -s 160M "$work/image" && mkfs.ext4 -q -F "$work/image"
}
switch_on() { mount -o loop "$work/image" "$disk"; }
# A copy of the image during which nothing was written, so that it is of one moment.
cut() {
  until cp "$work/image" "$work/first" && cp "$work/image" "$work/second" && cmp -s "$work/first" "$work/second"; do :; done
  kill -9 $search 2> /dev/null
  wait $search 2> /dev/null
  umount "$disk" && mv "$work/first" "$work/image"
}
search=
cuts=0 lost=0 unsound=0 wrong=0 completed=0 created=0 draws_seen=0
format && switch_on || { echo "no loop device can be mounted here" >&2; exit 2; }
while [ $cuts -lt "$times" ]; do
  "$program" search "$work/quick.json" --catalogue "$disk/a.db" --draws $draws --unit-draws $((20 + RANDOM % 200)) \
    --progress none > "$work/out" 2>&1 &
  search=$!
  sleep 0.$((RANDOM % 10))$((RANDOM % 10))
  seen=$(field "$disk/a.db" draws_in_ledger)
  [ $((RANDOM % 2)) = 0 ] || sleep 0.0$((RANDOM % 10))
  cut
  cuts=$((cuts + 1))
  switch_on || { echo "cut $cuts: the file system cannot be mounted"; exit 1; }
  if [ -e "$disk/a.db" ]; then
    "$program" status "$disk/a.db" --recover > "$work/recovered" 2>&1 || {
      unsound=$((unsound + 1))
      echo "cut $cuts: $(tail -1 "$work/recovered")"
    }
    now=$(field "$disk/a.db" draws_in_ledger)
  else
    now=0
  fi
  draws_seen=$((draws_seen + ${seen:-0}))
  if [ "${now:-0}" -lt "${seen:-0}" ]; then
    lost=$((lost + 1))
    echo "cut $cuts: ${seen:-0} draws were counted before, ${now:-none} after: $(tail -1 "$work/recovered")"
  fi
  if [ -n "${now:-}" ] && [ "$now" -gt 0 ] && ! "$program" verify "$disk/a.db" --sample 0 > "$work/verified" 2>&1; then
    unsound=$((unsound + 1))
    echo "cut $cuts: $(tail -1 "$work/verified")"
  fi
  [ "${now:-0}" -gt 0 ] || created=$((created + 1))
  if [ "${now:-0}" -ge $draws ]; then
    completed=$((completed + 1))
    [ "$(field "$disk/a.db" digest)" = "$expected" ] || { wrong=$((wrong + 1)); echo "cut $cuts: another digest"; }
    umount "$disk" && format && switch_on
  fi
done
echo "$cuts power cuts on ext4: $lost with a loss of what status had counted ($draws_seen draws), $unsound catalogues unsound," \
  "$wrong of $completed campaigns with another digest; $created cuts came before the first commit"
[ $((lost + unsound + wrong)) = 0 ]
