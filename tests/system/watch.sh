# The page of a campaign that runs: what it answers, whom it does not answer, and what becomes of it when its
# catalogue does not. With a third argument, the directory of tests/report with its packages, also in a browser.
. "$(dirname "$0")/lib.sh"
web=${3:-}
watchers=()
trap 'kill "${watchers[@]}" $search 2> /dev/null; rm -rf "$work"' EXIT
search=

# watched CATALOGUE OPTION...: begins to serve it; $url and $watcher.
watched() {
  : > url
  "$program" watch "$@" --port 0 > url 2> watch-err &
  watcher=$!
  watchers+=("$watcher")
  url_or_ended() { [ -s url ] || ! kill -0 $watcher 2> /dev/null; }
  eventually "watch $*" url_or_ended
  url=$(cat url)
  port=${url##*:}
  port=${port%/}
  [ -n "$url" ] || fail "watch $*: $(cat watch-err)"
}
ended() {  # by this signal: exit code 0
  kill "-$1" "$watcher"
  wait "$watcher"
  local got=$?
  [ $got = 0 ] || fail "ended by $1: exit $got: $(cat watch-err)"
}
get() { curl -sS --max-time $patience_s -o body -w '%{http_code}' "$@" 2> curl-err; }
# answers STATUS CURL_ARGUMENT...
answers() {
  local wanted=$1 got
  shift
  got=$(get "$@")
  [ "$got" = "$wanted" ] || fail "$*: $got, not $wanted: $(head -c 300 body)"
}
live() { field body "$1"; }
# says STATUS PATH SQL: whether ${url}PATH is answered with that, and SQL of its JSON j is 1. A catalogue is not
# looked at again at once: what becomes of it is said eventually.
says() {
  [ "$(get "$url$2")" = "$1" ] && [ "$(sqlite3 :memory: "SELECT $3 FROM (SELECT readfile('body') AS j)" 2> /dev/null)" = 1 ]
}
page_is() { [ "$(get "$url")" = "$1" ]; }
becomes() { eventually "$1: $2 with $3" says "$2" live "$3"; }  # WHAT STATUS SQL

quick_campaign quick.json

# Refused at the door: another address, a port that is no number, a place that is not there, what is no catalogue.
refused() {  # CODE SENTENCE ARGUMENT...
  local wanted=$1 sentence=$2
  shift 2
  timeout $patience_s "$program" watch "$@" > out 2> err
  local got=$?
  [ $got = "$wanted" ] && [ ! -s out ] || fail "watch $*: exit $got: $(cat out err)"
  grep -q -- "$sentence" err || fail "watch $*: no '$sentence': $(cat err)"
}
for address in 0.0.0.0 :: 10.0.0.1 example.com; do
  refused 2 "is no loopback address.*ssh -L" run.db --address "$address"
done
refused 2 "is not a whole number" run.db --port 65536
refused 3 "there is no such directory" nowhere/run.db
refused 3 "is no catalogue" quick.json

mkfifo pipe.db
ln -s circle.db circle.db
refused 3 "pipe.db: is a pipe" pipe.db
refused 3 "circle.db: is a link that leads nowhere (links go round in a circle)" circle.db
refused 3 "is a directory" .

# Waits for a catalogue that is not there yet, and serves it once a search has made it.
watched run.db
answers 503 "${url}live"
live problem | grep -q "there is no such file yet" || fail "a file that is not there yet: $(cat body)"
answers 503 "$url"
grep -q "there is no such file yet" body || fail "the page of a file that is not there yet"
"$program" search quick.json --catalogue run.db --draws 1000000000 --unit-draws 2000 --progress none > /dev/null 2>&1 &
search=$!
begun run.db candidate
becomes "a search" 200 "j ->> '$.writing' AND j ->> '$.state.draws' > 0 AND j ->> '$.total' > 0"
# Its numbers are those of `status`, and they move.
becomes "nothing moves" 200 "j ->> '$.state.draws' > $(live state.draws) AND j ->> '$.total' > $(live total)"
[ "$(live 'best.deploys_from_deg[0]')" = 30.0 ] || fail "the best of all: $(live best)"
[ "$(live 'angles[0][0]')" = 20.0 ] || fail "the first of the angles: $(live angles)"
[ "$(live faults.every)" = 1024 ] || fail "the fault sample"

# Any draw looked at closely, as `report` does.
"$program" report run.db --rows 0 --details 0 --draw 7 --output seven.html > /dev/null || fail "report --draw"
sed -n 's/.*id="report-data">\(.*\)<\/script>.*/\1/p' seven.html > seven.json
answers 200 "${url}sheet/7"
[ "$(live detail)" = "$(field seven.json 'details[0]')" ] || fail "draw 7: $(head -c 300 body)"
answers 404 "${url}sheet/9223372036854775808"
answers 403 -H "Sec-Fetch-Site: cross-site" "${url}sheet/7"

# The page, and whom it may ask.
eventually "the page of a search" page_is 200
answers 200 -D heads "$url"
for head in "Cache-Control: no-store" "Cross-Origin-Resource-Policy: same-origin" "Referrer-Policy: no-referrer" \
  "X-Content-Type-Options: nosniff" "X-Frame-Options: DENY" "script-src 'sha256-" "connect-src 'self'" "frame-ancestors 'none'"; do
  grep -qi "$head" heads || fail "no $head: $(cat heads)"
done
grep -qi "access-control" heads && fail "other sites may read it"
"$program" report run.db --rows 0 --details 0 --output plain.html > /dev/null || fail "report"
grep -q "connect-src 'none'" plain.html || fail "a page in a file may ask somebody"
grep -o '"watch":{[^}]*}' plain.html && fail "a page in a file is told to ask"

# Whom it does not answer.
answers 421 -H "Host: evil.example" "$url"
answers 421 -H "Host: evil.example:$port" "${url}live"
answers 421 -H "Host:" "$url"
answers 421 -H "Host: 127.0.0.1:1" "$url"
answers 200 -H "Host: localhost:$port" "${url}live"
answers 403 -H "Origin: http://evil.example" "${url}live"
answers 403 -H "Origin: null" "${url}live"
answers 403 -H "Sec-Fetch-Site: cross-site" "${url}live"
answers 403 -H "Sec-Fetch-Site: same-site" "$url"
answers 200 -H "Sec-Fetch-Site: same-origin" -H "Origin: ${url%/}" "${url}live"
answers 405 -d x=1 "${url}live"
answers 405 -X DELETE "$url"
answers 405 -X OPTIONS -H "Origin: ${url%/}" "$url"
answers 416 -H "Range: bytes=0-9,20-29" "$url"
for path in ../../../etc/passwd %2e%2e/%2e%2e/etc/passwd run.db live/ "live%00" favicon.ico; do
  answers 404 --path-as-is "$url$path"
done
answers 200 -I "$url"
# On no other address than its own.
for address in $(hostname -I 2> /dev/null); do
  case $address in *:*) continue ;; esac
  get "http://$address:$port/" > /dev/null && fail "it answers on $address"
done

# Those who say nothing, or too slowly, are in nobody's way.
for slow in 1 2 3 4 5 6 7 8; do
  { exec 3<> "/dev/tcp/127.0.0.1/$port" && printf 'GET / HT' >&3 && exec sleep infinity; } 2> /dev/null &
  watchers+=($!)
done
answers 200 "${url}live"
# More of them than there are threads, each saying a byte now and then: none gets its request whole.
cat > loris.py << 'END'
import socket, sys, time
open_now = [socket.create_connection(("127.0.0.1", int(sys.argv[1]))) for _ in range(40)]
request = iter("GET / HTTP/1.1\r\nHost: x\r\nX: " + 1000 * "a")
while open_now:
    byte = next(request).encode()
    for one in list(open_now):
        try:
            one.sendall(byte)
        except OSError:
            open_now.remove(one)
    open(sys.argv[2], "a").close()
    time.sleep(0.3)
END
python3 loris.py "$port" slow-ones &
watchers+=($!)
slow_ones=$!
eventually "slow ones" test -e slow-ones
answers 200 "${url}live"
wait $slow_ones  # until each was left
printf 'NONSENSE\r\n\r\n' > "/dev/tcp/127.0.0.1/$port"
answers 200 "${url}live"

# A second one finds another port, unless it is told which.
refused 1 "cannot listen on port $port" run.db --port "$port"

if [ -n "$web" ]; then
  node "$web/watch_test.mjs" campaign "$url" || fail "the page in a browser"
fi

# Ends with the search under way, and afterwards says that none is.
kill -INT $search
wait $search
search=
becomes "after the search" 200 "NOT j ->> '$.writing' AND NOT j ->> '$.state.complete'"
[ "$(live state.draws)" = "$("$program" status run.db --json > status.json; field status.json draws)" ] || fail "other draws than status"
sound_so_far run.db
# The file of a search that has ended is one plain file, with the page open or not.
"$program" search quick.json --catalogue run.db --draws 1000 --progress none > /dev/null 2>&1 || fail "a search that is done"
becomes "that it is complete" 200 "j ->> '$.state.complete'"

# Locked by another program: a sentence as long as that lasts.
mkfifo to-lock
sqlite3 run.db < to-lock > locked &
watchers+=($!)
locker=$!
exec 8> to-lock
echo "PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE; SELECT count(*) FROM run; SELECT 'held';" >&8
eventually "a lock" grep -q held locked
touch run.db  # so that it is looked at again
becomes "locked" 503 "j ->> '$.problem' GLOB '*locked*'"
exec 8>&-
wait $locker
becomes "unlocked" 200 "j ->> '$.state.complete'"

# Texts of a file that is not ours are texts.
cp run.db odd.db
hostile='</script><script>alert(1)</script><img src=x onerror=alert(2)>'
sqlite3 odd.db "UPDATE campaign SET name = '$hostile' || char(27) || ']0;x'; UPDATE fault_sample SET \"where\" = '$hostile';
  UPDATE fault_sample SET first_fault = '$hostile' WHERE first_fault = 'not_monotone'" || fail "no odd catalogue"
run_url=$url run_watcher=$watcher
watched odd.db
answers 200 "$url"
grep -q 'alert(1)' body || fail "the texts of the catalogue are missing"
grep -q '</script><script>alert\|<img' body && fail "a text of the catalogue becomes a part of the page"
answers 200 -D heads "${url}live"
[ "$(live 'faults.rows[0].where')" = "$hostile" ] || fail "a text of the catalogue: $(live 'faults.rows[0]')"
grep -qi "^content-type: application/json" heads || fail "data that are no JSON: $(cat heads)"
[ -z "$web" ] || node "$web/watch_test.mjs" hostile "$url" || fail "hostile texts in a browser"
sqlite3 odd.db "UPDATE campaign SET configuration = json_set(configuration, '\$.name', '$hostile')"
eventually "a page of a hostile name" page_is 503
grep -q 'alert(1)' body || fail "the page says nothing of a hostile name: $(head -c 300 body)"
grep -q '</script><script>alert\|<img' body && fail "a sentence becomes a part of the page"
[ -z "$web" ] || node "$web/watch_test.mjs" problem "$url" || fail "a hostile sentence in a browser"
ended INT
url=$run_url watcher=$run_watcher

# Damaged, replaced, gone, back: a sentence each, and the server stays.
identity=$(field status.json identity)
mv run.db away.db
becomes "gone" 503 "j ->> '$.problem' GLOB '*there is no such file*'"
head -c 5000 /dev/urandom > run.db
becomes "another file" 503 "j ->> '$.problem' GLOB '*is no catalogue*'"
{ head -c 30000 away.db; head -c 60000 /dev/urandom; } > run.db
becomes "damaged" 503 "j ->> '$.problem' NOT GLOB '*is no catalogue*'"
eventually "the page of a damaged one" page_is 503
cp "$source_dir/tests/fixtures/catalogue-7-from-1.db" run.db
becomes "replaced by an older one" 200 "j ->> '$.state.identity' != '$identity'"
says 200 sheet/0 "j ->> '$.identity' = '$(live state.identity)' AND j ->> '$.detail.draw' = '0'" ||
  fail "a sheet does not say of which campaign it is: $(head -c 300 body)"
rm -f run.db
mv away.db run.db
becomes "back again" 200 "j ->> '$.state.identity' = '$identity'"
ended INT

# A sheet that takes minutes: /live does not wait for it, nobody's request goes on, and the end comes at once.
echo '{ "name": "large", "pattern": { "family": "miura", "rows": 32, "columns": 32 }, "accept": { "deploys_from_deg": 150 } }' > large.json
"$program" search large.json --catalogue large.db --draws 1 --progress none > /dev/null 2>&1 || fail "search of large sheets"
watched large.db
page_is 200 || fail "the page of large sheets"
folds() { pgrep -P "$watcher" > /dev/null; }
is_idle() { ! folds; }
for draw in 1 2 3; do
  get "${url}sheet/$draw" > /dev/null &
  asking=$!
  eventually "sheet $draw is folded" folds
  kill $asking $(pgrep -P $asking)
  wait $asking 2> /dev/null
  eventually "nobody waits for sheet $draw" is_idle
done
for draw in $(seq 40); do
  curl -s "${url}sheet/$draw" > /dev/null 2>&1 &
  watchers+=($!)
done
eventually "a sheet is folded" folds
answers 200 "${url}live"
ended TERM
is_idle || fail "a sheet is folded for nobody"

# Where readers would keep the writer waiting it is not even opened.
cat > statfs.c << 'END'
#include <sys/vfs.h>
int statfs(const char* path, struct statfs* found) { (void)path; found->f_type = 0x6969; return 0; }
int statfs64(const char* path, struct statfs64* found) { (void)path; found->f_type = 0x6969; return 0; }
END
cc -D_GNU_SOURCE -shared -fPIC -o statfs.so statfs.c || fail "no statfs of our own"
LD_PRELOAD=$PWD/statfs.so refused 2 "is on shared storage (nfs" run.db
"$program" search quick.json --catalogue net.db --storage network --draws 1000000000 --progress none > /dev/null 2>&1 &
search=$!
net_is_written() { [ -s net.db ] && [ -e net.db-journal ]; }
eventually "a search without a log" net_is_written
refused 4 "is being written without a log" net.db
kill $search
wait $search
search=
# Where it had to leave in the middle of a transaction the same search rolls that back.
"$program" search quick.json --catalogue net.db --storage network --draws 1 --progress none > /dev/null 2>&1 ||
  fail "the search of net.db does not go on"
watched net.db
answers 200 "${url}live"
ended TERM
[ -s watch-err ] || fail "nothing is said on standard error"
finish
