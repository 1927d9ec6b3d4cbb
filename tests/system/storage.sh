# Disks that fill up, quotas, directories that vanish, readers that never rest: a sentence, exit code 1,
# and what was committed is good.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
"$program" search $campaign --catalogue calm.db --draws 10000 --progress none > /dev/null 2>&1
expected=$(digest_of calm.db)

# stopped CODE WORDS: of the search before.
stopped() {
  local got=$?
  [ $got = 1 ] || { fail "$1: exit $got"; cat err; }
  grep -q "$2" err || { fail "$1: no '$2'"; cat err; }
}

# A full disk: a small one of its own, where that may be made.
mkdir small
if mount -t tmpfs -o size=600k tmpfs small 2> /dev/null; then
  trap 'umount "$work/small" 2> /dev/null; rm -rf "$work"' EXIT
  "$program" search $campaign --catalogue small/a.db --draws 10000 --unit-draws 100 --progress none > /dev/null 2> err
  stopped "a full disk" "disk is full"
  sound_so_far small/a.db
  [ "$(sql small/a.db 'SELECT sum(draws) FROM unit')" -gt 0 ] || fail "a full disk: nothing committed"
  mount -o remount,size=100m small
  "$program" search $campaign --catalogue small/a.db --draws 10000 --progress none > /dev/null 2>&1 || fail "room was made"
  [ "$(digest_of small/a.db)" = "$expected" ] || fail "a full disk: another digest"
  # So full that not even an empty catalogue fits: nothing is left.
  rm small/*
  head -c 99m /dev/zero > small/filler
  mount -o remount,size=99m small
  head -c 1m /dev/zero >> small/filler 2> /dev/null
  "$program" search $campaign --catalogue small/b.db --progress none > /dev/null 2> err
  stopped "no room for a new one" "full"
  ls small/b.db* 2> /dev/null && fail "an empty catalogue was left"
  rm small/filler
  # A catalogue that is joined there: nothing of it is kept, and it says so.
  rm -f small/*
  mount -o remount,size=600k small
  "$program" search $campaign --catalogue half.db --range 5000:12000 --progress none > /dev/null 2>&1
  "$program" merge small/all.db calm.db half.db > /dev/null 2> err
  stopped "no room to join" "^misalign: [^ ]*small/all.db: the disk is full.*; nothing was written: make room, then give the same command again$"
  [ -z "$(ls small)" ] || fail "left of a merge: $(ls small)"
  mount -o remount,size=100m small
  # Read-only from one moment to the next.
  mount -o remount,ro small
  "$program" search $campaign --catalogue small/c.db --progress none > /dev/null 2> err
  stopped "a read-only disk" "cannot be written"
else
  echo "not allowed to mount a small disk: left out"
fi

# A quota, as the largest size of a file.
(
  ulimit -f 6000 # kB; MPI's own files need 4 MB
  trap '' XFSZ
  "$program" search $campaign --catalogue quota.db --draws 20000 --unit-draws 500 --progress none > /dev/null 2> err
)
stopped "a quota" "what was committed is good"
sound_so_far quota.db
"$program" search $campaign --catalogue quota.db --draws 20000 --progress none > /dev/null 2>&1 || fail "the quota was lifted"
sound quota.db 20000

# The directory is removed, or moved away, while a campaign runs in it.
for how in "rm -rf gone" "mv gone elsewhere"; do
  mkdir gone
  "$program" search $campaign --catalogue gone/a.db --draws 10000000 --unit-draws 100 --progress none > /dev/null 2> err &
  search=$!
  begun gone/a.db unit
  $how
  wait $search
  stopped "$how" "was removed or replaced"
done
sound_so_far elsewhere/a.db
"$program" search $campaign --catalogue elsewhere/a.db --draws 10000 --progress none > /dev/null 2>&1
[ "$(digest_of elsewhere/a.db)" = "$expected" ] || fail "moved away: another digest"

# The index of the log is cut short while it is in use: a sentence, and the same command goes on.
for n in 1 2; do
  [ $n = 1 ] && alone=("$program") || alone=("${ranks[@]}" $n "$program")
  "${alone[@]}" search $campaign --catalogue cut-$n.db --draws 10000000 --unit-draws 100 --progress none > /dev/null 2> err &
  search=$!
  begun cut-$n.db unit
  truncate -s 0 cut-$n.db-shm
  wait $search
  stopped "an index cut short, $n ranks" "^misalign: a file in use was truncated .*the same command resumes"
  sound_so_far cut-$n.db
  "${alone[@]}" search $campaign --catalogue cut-$n.db --draws 10000 --progress none > /dev/null 2>&1 ||
    fail "after an index was cut short, $n ranks"
  [ "$(digest_of cut-$n.db)" = "$expected" ] || fail "an index cut short, $n ranks: another digest"
done

# On storage that machines share: no log, nobody reads meanwhile, and the same digest.
"${ranks[@]}" 2 "$program" search $campaign --catalogue shared.db --draws 10000 --storage network --progress none > /dev/null 2> err ||
  fail "--storage network"
grep -q "rollback journal and an exclusive lock" err || fail "--storage network: no sentence"
[ "$(digest_of shared.db)" = "$expected" ] || fail "--storage network: another digest"

# A search that is complete is asked for again: it has nothing to do, and its file keeps its bytes and its time.
mark() { md5sum < calm.db && stat -c %y calm.db; }
before=$(mark)
sleep 0.1
for n in 1 2; do
  "${ranks[@]}" $n "$program" search $campaign --catalogue calm.db --draws 10000 --progress none > out 2> err ||
    fail "complete: $(cat err)"
  grep -q "^calm.db: complete, 10000 draws, .* $expected$" out || fail "complete: $(cat out)"
  [ "$(mark)" = "$before" ] && [ -z "$(ls calm.db-* 2> /dev/null)" ] || fail "a complete search writes: $(ls calm.db*)"
done
"$program" search $campaign --catalogue calm.db --draws 10001 --progress none > /dev/null 2>&1 || fail "one draw more"
[ "$(mark)" != "$before" ] || fail "one draw more: nothing was written"

# A transaction that was killed half-way: readers refuse, and name what mends it; so do the verbs that write.
half_done() {  # FILE: a copy of the catalogue before, with a journal to roll back
  cp calm.db "$1"
  sqlite3 "$1" "PRAGMA cache_size = 1" "BEGIN" "UPDATE candidate SET stroke_max = 0" ".shell kill -KILL \$PPID" \
    > /dev/null 2>&1
  [ -s "$1-journal" ] || fail "no journal"
}
strokes() { sqlite3 -readonly "$1" 'SELECT total(stroke_max) FROM candidate'; }
half_done half.db 2> /dev/null
"$program" status half.db > out 2> err
stopped "a journal to roll back" "misalign status half.db --recover does it"
"$program" status half.db --recover > out 2> err || fail "--recover: $(cat err)"
[ "$(strokes half.db)" = "$(strokes calm.db)" ] && [ "$(ls half.db*)" = half.db ] || fail "--recover: $(ls half.db*)"
half_done tolerated.db 2> /dev/null
"$program" tolerance tolerated.db --best 1 --amplitude 0.001 --trials 10 > out 2> err || fail "tolerance: $(cat err)"
[ "$(sql tolerated.db 'SELECT count(*) FROM yield')" = 1 ] || fail "tolerance: no yield: $(cat err)"
half_done certified.db 2> /dev/null
"$program" certify certified.db --best 1 --to 5 > out 2> err || fail "certify: $(cat err)"
[ "$(strokes certified.db)" = "$(strokes calm.db)" ] || fail "certify: not rolled back"

# A copy of the file alone while a search writes: a catalogue, and what it lacks is said. One of a newborn file, which
# an older program began with its log, is no catalogue yet.
"$program" search $campaign --catalogue live.db --draws 100000000 --unit-draws 100 --progress none > /dev/null 2>&1 &
search=$!
begun live.db unit
cp live.db copy.db
"$program" merge backup.db live.db > /dev/null 2> err || fail "a backup: $(cat err)"
kill -TERM $search
wait $search
for k in 1 2; do
  "$program" status copy.db > out 2> err || fail "a copy: $(cat err)"
  grep -q "copy.db-wal, is missing" err || fail "a copy without its log, time $k: $(cat err)"
done
[ "$("$program" status copy.db --json 2> /dev/null | grep -c draws_in_ledger)" = 1 ] || fail "a copy: its ledger"
gives_1 backup.db 'SELECT count(*) > 0 FROM unit' || fail "a backup: no unit"
for file in live.db backup.db; do
  "$program" status $file 2>&1 | grep -q "is missing" && fail "$file: its log is not missing"
done
sqlite3 newborn.db "PRAGMA journal_mode = WAL" "VACUUM" > /dev/null
rm -f newborn.db-*
"$program" status newborn.db > out 2> err
[ $? = 3 ] && grep -q "newborn.db-wal, is missing" err || fail "a newborn copy: $(cat err)"

# Eight readers, a query a second each: no commit waits for them, and the log stays small.
"$program" search $campaign --catalogue read.db --draws 100000000 --unit-draws 1000 --max-time 5 --progress none > /dev/null 2>&1 &
search=$!
largest=0
for second in 1 2 3 4; do
  for reader in 1 2 3 4 5 6 7 8; do
    "$program" query read.db "SELECT avg(stroke_max), count(*) FROM candidates" > /dev/null 2> err-$reader ||
      { [ -s read.db ] && grep -v "no catalogue" err-$reader; } &
  done
  sleep 1
  size=$(stat -c %s read.db-wal 2> /dev/null || echo 0)
  [ "$size" -gt $largest ] && largest=$size
done
wait $search || fail "a search with readers"
wait
cost='SELECT printf("%d commits, %.1f %% of the time, the longest %.0f ms", commits, 100 * commit_s / 5, 1000 * longest_commit_s) FROM run'
echo "eight readers: $(sql read.db "$cost"); largest log $largest bytes"
[ $largest -lt $((64 << 20)) ] || fail "the log has $largest bytes"
sound_so_far read.db
finish
