# For the whole-program tests: called as TEST.sh PROGRAM SOURCE_DIR, each runs in a directory of its own.
set -u
program=$1
source_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# All ranks are on this machine: Open MPI looks for no network, which takes half of its start.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

finish() {
  [ "$failures" -eq 0 ] && echo "all good"
  exit $((failures > 0))
}

# "${ranks[@]}" N "$program" ...: under mpirun. No function: in the background $! must be mpirun itself.
ranks=(mpirun --oversubscribe --bind-to none -n)

# quick_campaign FILE: a campaign of short paths, most of them accepted.
quick_campaign() {
  sed 's/"end_deg": 180/"end_deg": 30/; s/"deploys_from_deg": 150/"deploys_from_deg": 20/' \
    "$source_dir/search/campaigns/miura-4x4.json" > "$1"
}

# sql FILE QUERY: all rows, a line each, columns between bars.
sql() { sqlite3 -readonly "$1" "$2"; }

# field FILE PATH: what JSON has there; true is 1.
field() { sqlite3 :memory: "SELECT json_extract(readfile('$1'), '\$.$2')"; }
# json_test FILE CONDITION: in SQL, of the document j.
json_test() { [ "$(sqlite3 :memory: "WITH f AS (SELECT readfile('$1') AS j) SELECT $2 FROM f")" = 1 ]; }

# No test fails for want of time: it waits for what is to happen, and only what is stuck is given up.
patience_s=600

# eventually WHAT COMMAND...: tries until it succeeds.
eventually() {
  local what=$1 begin=$SECONDS
  shift
  until "$@"; do
    [ $((SECONDS - begin)) -lt $patience_s ] || { fail "$what: not within $patience_s s"; return 1; }
    sleep 0.05
  done
}
# gives_1 FILE SQL: whether it does, as soon as it can be asked.
gives_1() { [ "$(sql "$1" "$2" 2> /dev/null)" = 1 ]; }
# begun FILE [TABLE [ROWS]]: waits until the catalogue's run has begun, or that table has a row, or so many.
begun() { eventually "$1: rows in ${2:-run}" gives_1 "$1" "SELECT count(*) >= ${3:-1} FROM ${2:-run}"; }

# killed_often KILLS COMMAND...: a search into killed.db, killed with all of its ranks some moments after its next unit is
# there, and again; one that was done before begins anew.
killed_often() {
  local wanted=$1 hit=0 ended=0 some search
  shift
  goes_on_or_ended() {
    gives_1 killed.db "SELECT count(*) > ${some:-0} FROM unit" || ! kill -0 $search 2> /dev/null
  }
  while [ $hit -lt "$wanted" ] && [ $failures = 0 ]; do
    some=$(sql killed.db 'SELECT count(*) FROM unit' 2> /dev/null)
    "$@" --progress none --catalogue "$PWD/killed.db" > /dev/null 2>&1 &
    search=$!
    eventually "a unit more than ${some:-0}" goes_on_or_ended
    sleep 0.0$((RANDOM % 10))
    if pkill -KILL -f -- "^$program search .*--catalogue $PWD/killed.db"; then  # no other test's
      hit=$((hit + 1))
    else
      ended=$((ended + 1))
      rm -f killed.db*
    fi
    { wait $search; } 2> /dev/null
  done
  echo "$hit kills of a search under way, $ended came too late"
}

digest_of() { "$program" status "$1" --json | sed -n 's/.*"digest": "\(.*\)".*/\1/p'; }

# sound_so_far FILE: integrity, no overlap, and every draw of a unit counted once.
sound_so_far() {
  [ "$(sql "$1" 'PRAGMA integrity_check')" = ok ] || fail "$1: integrity_check"
  [ -z "$(sql "$1" 'PRAGMA foreign_key_check')" ] || fail "$1: foreign_key_check"
  local overlaps='SELECT count(*) FROM unit a JOIN unit b ON a.lo < b.lo AND b.lo < a.hi'
  [ "$(sql "$1" "$overlaps")" = 0 ] || fail "$1: overlaps"
  local sums='SELECT coalesce(sum(hi - lo), 0) = coalesce(sum(accepted + rejected + undecided), 0) FROM unit'
  [ "$(sql "$1" "$sums")" = 1 ] || fail "$1: the sums of the ledger"
  [ "$(sql "$1" 'SELECT coalesce(sum(accepted), 0) = (SELECT count(*) FROM candidate) FROM unit')" = 1 ] ||
    fail "$1: accepted and candidates"
  local per_unit='SELECT count(*) FROM unit WHERE accepted !=
    (SELECT count(*) FROM candidate WHERE draw >= lo AND draw < hi)'
  [ "$(sql "$1" "$per_unit")" = 0 ] || fail "$1: candidates of a unit"
}

# sound FILE DRAWS: that, no gap, and all of these draws.
sound() {
  sound_so_far "$1"
  [ "$(sql "$1" 'SELECT count(*) FROM gaps')" = 0 ] || fail "$1: gaps"
  [ "$(sql "$1" 'SELECT sum(hi - lo) FROM unit')" = "$2" ] || fail "$1: draws"
}

# fresh_clone FOLDER: of the source folder, whoever owns that; what was changed there and not committed comes along.
fresh_clone() {
  printf '[safe]\n\tdirectory = *\n' > "$work/gitconfig"
  GIT_CONFIG_GLOBAL=$work/gitconfig git clone -q "$source_dir" "$1" || return
  GIT_CONFIG_GLOBAL=$work/gitconfig git -C "$source_dir" ls-files -z --modified --others --exclude-standard |
    tar -C "$source_dir" --null --files-from=- --ignore-failed-read -cf - 2> /dev/null | tar -C "$1" -xf -
}
