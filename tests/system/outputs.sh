# Files that are written: they appear whole or not at all, nothing that was there before is touched under any
# name, what is private stays private, and what a killed program has left goes away.
. "$(dirname "$0")/lib.sh"
campaign=quick.json
quick_campaign $campaign
search() { "$program" search $campaign --progress none "$@" > /dev/null 2>&1; }
search --catalogue a.db --range 0:300 --unit-draws 100 || fail "0:300"
search --catalogue b.db --range 300:600 --unit-draws 100 || fail "300:600"
umask 022
of() { sha256sum < "$1"; }
# alone NAME...: these are the only files in here beside the inputs.
alone() {
  [ "$(ls -A | grep -vxE "$campaign|[ab]\.db|out|err" | xargs)" = "$*" ] || fail "left: $(ls -A | xargs)"
}

# Inputs whose names other programs give to what they write.
for name in all.db.partial all.db.part all.db.tmp; do
  cp a.db $name
  "$program" merge all.db b.db $name > out 2> err || { fail "merge of $name"; cat err; }
  [ "$(of $name)" = "$(of a.db)" ] || fail "merge: $name is not what it was"
  rm -f all.db $name
done
# A journal's name beside the output: SQLite would take it for the output's own.
for name in all.db-wal all.db-journal; do
  cp a.db $name
  "$program" merge all.db b.db $name > out 2> err
  [ $? = 2 ] && grep -q "$name" err || { fail "merge beside $name"; cat err; }
  [ "$(of $name)" = "$(of a.db)" ] || fail "merge: $name is not what it was"
  rm -f $name
done
alone

# Text files: links and FIFOs beside the output are not theirs, and a database is not replaced.
echo precious > precious
ln -s precious page.html.part
timeout $patience_s "$program" report a.db --output page.html > out 2> err || { fail "report beside a link"; cat err; }
[ "$(cat precious)" = precious ] && [ -h page.html.part ] || fail "report followed a link beside it"
rm -f page.html page.html.part
mkfifo page.html.part
timeout $patience_s "$program" report a.db --output page.html > out 2> err || { fail "report beside a FIFO"; cat err; }
[ -s page.html ] && [ -p page.html.part ] || fail "report and a FIFO beside it"
rm -f page.html page.html.part
mkfifo page.html
timeout $patience_s "$program" report a.db --output page.html > out 2> err
[ $? = 1 ] && grep -q "no file" err || { fail "report into a FIFO"; cat err; }
rm -f page.html
ln -s one page.html
ln -s two one
"$program" report a.db --output page.html > out 2> err || { fail "report through links"; cat err; }
[ -h page.html ] && [ -h one ] && [ -s two ] && [ ! -h two ] || fail "a link to a link was not followed to its end"
rm -f page.html one two
for name in b.db b.db-wal; do
  before=$(of b.db)
  "$program" report a.db --output $name > out 2> err
  [ $? = 2 ] && grep -q "database" err || { fail "a report instead of $name"; cat err; }
  [ "$(of b.db)" = "$before" ] || fail "a report replaced a catalogue"
done
rm -f precious
# Where a file without a name cannot be had, it has one that nobody can foresee.
if unshare -m true 2> /dev/null; then
  echo old > page.html
  unshare -m sh -c 'mount -t tmpfs none /proc && exec "$0" report a.db --output page.html' "$program" > out 2> err ||
    { fail "report without /proc"; cat err; }
  grep -q "</html>" page.html || fail "report without /proc: not written"
  rm -f page.html
fi
alone

# Whose files may be read by nobody else: neither may what is made of them; a replaced file keeps its own.
mode_of() { stat -c %a "$1"; }
chmod 600 a.db
"$program" merge all.db b.db a.db > /dev/null || fail "merge of a private catalogue"
[ "$(mode_of all.db)" = 600 ] || fail "mode $(mode_of all.db)"
rm -f all.db
cp "$source_dir/tests/fixtures/catalogue-7.db" old.db
chmod 640 old.db
sqlite3 old.db 'SELECT configuration FROM campaign' > old.json
"$program" search old.json --catalogue old.db --draws 1 --allow-mixed-builds > /dev/null 2> err || { fail "an older schema"; cat err; }
[ "$(mode_of old.db.version-7)" = 640 ] || fail "the copy of an older schema has mode $(mode_of old.db.version-7)"
chmod 644 a.db
"$program" merge all.db a.db b.db > /dev/null || fail "merge"
[ "$(mode_of all.db)" = 644 ] || fail "mode $(mode_of all.db)"
echo old > page.html
chmod 600 page.html
"$program" report a.db --output page.html > /dev/null || fail "report replaces"
[ "$(mode_of page.html)" = 600 ] || fail "a replaced file has mode $(mode_of page.html)"
rm -f old.db* old.json all.db page.html
alone

# Two at once into one file: one of them makes it, the other says so.
for round in 1 2 3; do
  "$program" merge all.db a.db b.db > out1 2> err1 &
  "$program" merge all.db b.db a.db > out2 2> err2
  second=$?
  wait $!
  first=$?
  case "$first $second" in "0 2" | "0 4" | "2 0" | "4 0") ;; *) fail "two merges at once: $first, $second" ;; esac
  sound all.db 600
  "$program" verify all.db --sample 10 > /dev/null || fail "two merges at once: verify"
  rm -f all.db out1 out2 err1 err2
done
alone

# Killed at any moment: no output, or a whole one; what was left is gone after the next.
# From its start to a little after the end of one that is left alone.
undisturbed_us=$(date +%s%6N)
"$program" merge all.db a.db b.db > out 2> err || { fail "before the kills"; cat err; }
undisturbed_us=$(($(date +%s%6N) - undisturbed_us))
rm -f all.db
for part in {0..11}; do
  delay_us=$((undisturbed_us * part / 10))
  "$program" merge all.db a.db b.db > out 2> err &
  merge=$!
  sleep "$(printf '%d.%06d' $((delay_us / 1000000)) $((delay_us % 1000000)))"
  kill -KILL $merge
  wait $merge 2> /dev/null
  [ -e all.db ] && sound all.db 600
  rm -f all.db
done
"$program" merge all.db a.db b.db > out 2> err || { fail "after the kills"; cat err; }
sound all.db 600
alone all.db
finish
