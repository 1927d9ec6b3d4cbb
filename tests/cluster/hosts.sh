# Two hosts that speak TCP, played by two network namespaces with a switch between them: the same digest as
# one process, and what is left of a run whose link goes silent, and of the campaign after that.
hosts_script=$(realpath "$0")
if [ "${3:-}" != inside ]; then
  . "$2/scripts/packages.sh"
  need_packages $hosts_packages
  # A process tree, a network and mounts of its own: whatever happens, all of it ends with this process.
  world=(unshare --net --pid --fork --kill-child --mount-proc)
  [ "$(id -u)" = 0 ] || world+=(--map-root-user)
  if ! why=$("${world[@]}" sh -c 'mount -t tmpfs none /run && ip netns add host &&
    ip link add switch type bridge && ip link add port type veth peer name eth0 netns host' 2>&1); then
    echo "SKIPPED: network namespaces cannot be made here (${why%%$'\n'*})"
    exit 0
  fi
  exec timeout --foreground -s KILL 5000 "${world[@]}" bash "$hosts_script" "$1" "$2" inside
fi
. "$(dirname "$hosts_script")/../system/lib.sh"
unset OMPI_MCA_pml OMPI_MCA_btl  # here there is a network
trap 'exit 1' INT TERM
export TMPDIR=$work  # for what mpirun and orted leave behind when they are killed

mount -t tmpfs none /run
ip link set lo up  # without any interface not even a single rank starts
ip link add switch type bridge
ip link set switch up
for n in 1 2; do
  ip netns add host$n
  ip link add port$n type veth peer name eth0 netns host$n
  ip link set port$n master switch up
  ip -n host$n link set lo up
  ip -n host$n address add 10.77.0.$n/24 dev eth0
  ip -n host$n link set eth0 up
done
printf '%s\n' '10.77.0.1 slots=2' '10.77.0.2 slots=1' > hostfile

# Run on HOST: sh -c "$on" HOST COMMAND...
on='exec ip netns exec "$0" unshare --uts sh -c "hostname \$0; exec \"\$@\"" "$0" "$@"'
# In place of ssh, to host2, which has none of the files in $work/host1. It leaves at once: what ends on one
# host is seen on the other through the link alone.
cat > agent <<EOF
#!/bin/sh
shift
setsid sh -c '$on' host2 sh -c "mount -t tmpfs none '$work/host1'; \$*" > /dev/null 2>&1 < /dev/null &
EOF
chmod +x agent
across=(sh -c "$on" host1 mpirun --hostfile "$work/hostfile" --bind-to none
  --mca plm_rsh_agent "$work/agent" --mca btl tcp,self
  --mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24)
# A silent host is given up after 5 + 2 * 5 seconds.
keepalive=(--mca oob_tcp_keepalive_time 5 --mca oob_tcp_keepalive_intvl 5 --mca oob_tcp_keepalive_probes 2)

mkdir host1
cd host1 || exit 1
campaign=quick.json
quick_campaign $campaign
placed=$("${across[@]}" -n 3 sh -c 'echo $(hostname): $(ls)' | sort | xargs)
[ "$placed" = "host1: quick.json host1: quick.json host2:" ] || { fail "ranks and files are on $placed"; finish; }

search=("$program" search $campaign --unit-draws 50 --progress none)
draws=20000
"${search[@]}" --draws $draws --catalogue calm.db > /dev/null 2>&1
expected=$(digest_of calm.db)

sent_by_host2() { ip -s link show port2 | awk '/RX:/ { getline; print $1 }'; }

# Undisturbed: the same digest, and the candidates of host2 came over the link.
sent_before=$(sent_by_host2)
"${across[@]}" -n 3 "${search[@]}" --draws $draws --catalogue across.db > across.log 2>&1 || fail "across two hosts: $(cat across.log)"
sound across.db "$draws"
[ "$(digest_of across.db)" = "$expected" ] || fail "across two hosts: another digest"
found_by_host2=$(sql across.db 'SELECT coalesce(sum(length(displacements_mm)), 0) FROM candidate, unit
  WHERE draw >= lo AND draw < hi AND worker = 2')
[ "$found_by_host2" -gt 0 ] || fail "host2 found nothing"
[ $(($(sent_by_host2) - sent_before)) -gt "$found_by_host2" ] || fail "host2's candidates went another way"

# Two runs, and no packet of either arrives any more: the interfaces stay up, no connection is closed.
# Without an end, so that the link is cut before it.
"${across[@]}" -n 3 "${search[@]}" --draws 1000000000 --catalogue plain.db > plain.log 2>&1 &
"${across[@]}" "${keepalive[@]}" -n 3 "${search[@]}" --draws 1000000000 --catalogue keepalive.db > keepalive.log 2>&1 &
for run in plain keepalive; do
  eventually "$run: three workers" gives_1 $run.db 'SELECT count(DISTINCT worker) = 3 FROM unit'
done
ip link set port2 nomaster
cut=$SECONDS

ranks_of() { pgrep -f "^$program search .*--catalogue $1.db"; }
launchers_of_keepalive() {
  pgrep -f "^mpirun .*--catalogue keepalive.db"
  pgrep -f '^orted .*oob_tcp_keepalive_time'
}

# ended NAME COMMAND...: waits until COMMAND, which prints process ids, prints none: sooner than without those
# options, a quarter of an hour.
ended() {
  local name=$1
  shift
  none_left() { [ "$("$@" | wc -l)" = 0 ]; }
  eventually "$name linger" none_left "$@"
  echo "$name: none left $((SECONDS - cut)) s after the cut"
}
[ "$(ranks_of '(plain|keepalive)' | wc -l)" = 6 ] || fail "two runs of three ranks were to be cut"
ended "ranks, keepalive" ranks_of keepalive
ended "mpirun and orted, keepalive" launchers_of_keepalive
# Without those options mpirun and orted wait for a quarter of an hour: only the ranks must have ended.
ended "ranks, no options" ranks_of plain
[ "$(grep -c '^misalign: ' plain.log)" -gt 1 ] || fail "no rank said why it ended: $(cat plain.log)"

left=$(pgrep -x 'mpirun|orted'; ranks_of '(plain|keepalive)')
[ -z "$left" ] || kill -KILL $left
wait 2> /dev/null
ip link set port2 master switch
# On to where both of them have been.
draws=$(for run in plain keepalive; do sql $run.db 'SELECT max(hi) + 1000 FROM unit'; done | sort -n | tail -1)
"${search[@]}" --draws "$draws" --catalogue further.db > /dev/null 2>&1
expected=$(digest_of further.db)
for run in plain keepalive; do
  "$program" status $run.db --check > /dev/null
  [ $? = 75 ] || fail "$run: status --check after the cut"
  "${across[@]}" "${keepalive[@]}" -n 3 "${search[@]}" --draws "$draws" --catalogue $run.db > $run-resumed.log 2>&1 ||
    fail "$run: resume: $(cat $run-resumed.log)"
  sound $run.db "$draws"
  [ "$(digest_of $run.db)" = "$expected" ] || fail "$run: cut and resumed: another digest"
done
finish
