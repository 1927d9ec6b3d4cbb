#!/usr/bin/env bash
# watched_commits.sh PROGRAM WATCHED_COMMITS FOLDER [SECONDS] [BEFORE]: what commits take while nobody looks, and while eight
# clients ask `misalign watch` every second and the page is loaded every three: of 5,000 invented candidates a second
# in an empty catalogue and behind BEFORE others (a million), and of a real campaign. Results in results/watch.md.
set -euo pipefail
program=$1 bench=$2 folder=$3 seconds=${4:-60} before=${5:-1000000}
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$folder"
cd "$folder"
rm -f -- *.db *.db-* url times
clients=()
stop_watching() {
  [ ${#clients[@]} = 0 ] && return
  kill "${clients[@]}" 2> /dev/null || true
  wait "${clients[@]}" 2> /dev/null || true
  clients=()
}
trap stop_watching EXIT

# ask PATH PAUSE: again and again; how long each answer took.
ask() {
  while sleep "$2"; do
    curl -s --max-time 30 -o /dev/null -w "$1 %{http_code} %{time_total} %{size_download}\n" "$url$1" >> times || true
  done
}
watch() {  # FILE
  : > times
  rm -f url
  "$program" watch "$1" --port 0 > url 2> /dev/null &
  clients+=($!)
  until [ -s url ]; do sleep 0.1; done
  url=$(sed 's|/$||' url)
  for client in 1 2 3 4 5 6 7 8; do
    ask /live 1 &
    clients+=($!)
  done
  ask / 3 &
  clients+=($!)
}
answers() {
  awk '{ n[$1 " " $2]++; if ($3 > most[$1 " " $2]) most[$1 " " $2] = $3; kb[$1 " " $2] = $4 / 1000 }
    END { for (k in n) printf "  %d answers %s, the slowest %.2f s, the last %.0f kB\n", n[k], k, most[k], kb[k] }' times
}
commits() { sqlite3 -readonly "$1" 'SELECT printf("%d commits, mean %.0f ms, longest %.0f ms, %.0f candidates/s", commits,
  1000 * commit_s / commits, 1000 * longest_commit_s, (SELECT count(*) FROM candidate) /
  (86400 * (julianday(ended_at) - julianday(started_at)))) FROM run ORDER BY id DESC LIMIT 1'; }

"$bench" filled.db "$before" 0
for start in none filled.db; do
  for watched in "" watched; do
    rm -f -- steady.db*
    [ $start = none ] || cp $start steady.db
    echo "invented candidates, behind $([ $start = none ] && echo 0 || echo "$before")${watched:+, $watched}"
    "$bench" steady.db 0 "$seconds" > csv &
    writer=$!
    if [ -n "$watched" ]; then
      until [ -s steady.db ]; do sleep 0.1; done
      watch steady.db
    fi
    wait $writer
    stop_watching
    tail -4 csv
    [ -z "$watched" ] || answers
  done
done

sed 's/"deploys_from_deg": 150/"deploys_from_deg": 60/' "$source_dir/search/campaigns/miura-4x4.json" > from_60.json
for watched in "" watched; do
  rm -f -- real.db*
  echo "miura-4x4 from 60 degrees, two ranks${watched:+, $watched}"
  "$program" search from_60.json --catalogue real.db --draws 1000000000 --max-time "$seconds" --ranks 2 --progress none > /dev/null 2>&1 &
  writer=$!
  if [ -n "$watched" ]; then
    until [ -s real.db ]; do sleep 0.1; done
    watch real.db
  fi
  wait $writer
  stop_watching
  commits real.db
  [ -z "$watched" ] || answers
done
