#!/usr/bin/env bash
# The README's first command on a Debian that has nothing but its base system: from clone to report, then
# `cmake --install`, and what was installed is used. As root, by command:
#   bare_debian.sh SUITE [SECONDS]
# SUITE is bookworm, trixie or another that debootstrap knows; the run itself takes SECONDS (5). The mirror,
# proxies, the npm registry and certificates are those that this machine is set up with. Prints how long
# each part took (results/bare-debian.md); the whole output is left in build/bare-SUITE.log.
set -euo pipefail
cd "$(dirname "$0")/../.."
suite=${1:?which suite, such as bookworm}
seconds=${2:-5}
log=$PWD/build/bare-$suite.log
. scripts/packages.sh
need_packages debootstrap git

if [ "${BARE_DEBIAN_INSIDE:-}" != yes ]; then
  mkdir -p build
  # Mounts and processes of its own, which end with it.
  BARE_DEBIAN_INSIDE=yes exec unshare --mount --pid --fork --kill-child --mount-proc bash tests/cluster/bare_debian.sh "$@"
fi
world=$(mktemp -d)
chmod 755 "$world"  # whoever apt downloads as looks into it
trap 'umount -R "$world/dev" "$world/proc" 2> /dev/null; rm -rf --one-file-system "$world"' EXIT

# As apt here is set up: the archive of Debian itself.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -1)
[ -n "$mirror" ] || { echo "apt knows no archive of Debian here; set one up in /etc/apt" >&2; exit 1; }
eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
export http_proxy=${http_proxy:-} https_proxy=${https_proxy:-}

: > "$log"
# timed NAME COMMAND...: its output, stamped with the seconds since it began, into the log.
timed() {
  local name=$1 start=$EPOCHSECONDS code=0
  shift
  echo "== $name" >> "$log"
  "$@" 2>&1 | while IFS= read -r line; do echo "$((EPOCHSECONDS - start)) $line"; done >> "$log" || code=$?
  if [ $code != 0 ]; then
    echo "FAILED: $name; the end of $log:" >&2
    tail -30 "$log" >&2
    exit 1
  fi
  printf '%-36s %4d s\n' "$name" $((EPOCHSECONDS - start))
}

timed "debootstrap, $suite" debootstrap --variant=minbase "$suite" "$world" "$mirror"
cp -L /etc/resolv.conf "$world/etc/resolv.conf"
echo force-unsafe-io > "$world/etc/dpkg/dpkg.cfg.d/unsafe-io"  # it need not survive a power cut
apt-config dump Acquire | grep -i '::proxy' > "$world/etc/apt/apt.conf.d/90this-machine" || true
mount --rbind /dev "$world/dev"
mount -t proc proc "$world/proc"

inside=(env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8
  http_proxy="$http_proxy" https_proxy="$https_proxy")
if command -v npm > /dev/null; then
  inside+=(npm_config_registry="$(npm config get registry 2> /dev/null)")
  if [ -r "${NODE_EXTRA_CA_CERTS:-}" ]; then
    cp -L "$NODE_EXTRA_CA_CERTS" "$world/usr/local/share/this-machine.pem"
    inside+=(NODE_EXTRA_CA_CERTS=/usr/local/share/this-machine.pem)
    inside+=(npm_config_cafile=/usr/local/share/this-machine.pem)
  fi
fi
# bare COMMAND: by the shell of the bare system, in root's home.
bare() { chroot "$world" "${inside[@]}" bash -e -o pipefail -c "cd; $1"; }

git bundle create -q "$world/root/misalign.bundle" HEAD
timed "git, which a clone needs" bare \
  'apt-get update -qq && apt-get install -qq -y --no-install-recommends git > /dev/null'
timed "clone" bare 'git clone -q misalign.bundle misalign'
timed "scripts/run.sh $seconds" bare "cd misalign && time scripts/run.sh $seconds"
timed "cmake --install" bare 'cmake --install misalign/build/release --prefix ~/.local'
timed "what was installed" bare 'export PATH=~/.local/bin:$PATH
  misalign --version
  misalign query misalign/results/miura-6x6-*.db acceptance
  misalign doctor misalign/results
  test -s ~/.local/share/man/man1/misalign-search.1
  test -s ~/.local/share/bash-completion/completions/misalign
  grep -q "</html>" misalign/results/report.html'
echo
sed -n '/^== scripts/,/^== cmake/p' "$log" | awk '
  / \[[0-9]+\/[0-9]+\] / && !first { first = $1; print "  packages and configuring", first, "s" }
  / \[[0-9]+\/[0-9]+\] / { last = $1 }
  / (real|user|sys)\t/ { print "  " $2, $3 }
  END { print "  building", last - first, "s" }'
grep -E ': (stopped|complete|max_time), ' "$log" | sed 's/^[0-9]* /  /'
sed -n '/^== what was/,$p' "$log" | sed -nE 's/^[0-9]* (compiler|libraries|instruction set)/  \1/p'
