# Sourced, in the repository's folder: a Debian that has nothing but its base system, to try things in. The
# mirror, proxies, the npm registry and certificates are those that this machine is set up with. With CCACHE_DIR that
# cache is used inside as well, by who installs ccache there; what is said of times is then said of nothing.
. scripts/packages.sh

# begin KIND SUITE...: with mounts and processes of its own, which end with it, the script begins again. $suite; $log,
# build/KIND-SUITE.log; in $world such a Debian, not yet mounted. What is in worlds=() is removed at the end.
begin() {
  suite=${2:?which suite, such as bookworm} log=$PWD/build/$1-$2.log
  need_packages debootstrap git
  if [ "${OWN_MOUNTS:-}" != yes ]; then
    mkdir -p build
    OWN_MOUNTS=yes exec unshare --mount --pid --fork --kill-child --mount-proc bash "tests/cluster/${0##*/}" "${@:2}"
  fi
  world=$(mktemp -d)
  worlds=("$world")
  trap 'remove_worlds "${worlds[@]}"' EXIT
  : > "$log"
  make_world "$suite" "$world"
}

# timed NAME COMMAND...: its output, stamped with the seconds since it began, into $log.
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

# make_world SUITE FOLDER
make_world() {
  # As apt here is set up: the archive of Debian itself.
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -1)
  [ -n "$mirror" ] || { echo "apt knows no archive of Debian here; set one up in /etc/apt" >&2; exit 1; }
  eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
  export http_proxy=${http_proxy:-} https_proxy=${https_proxy:-}
  chmod 755 "$2"  # whoever apt downloads as looks into it
  timed "debootstrap, $1" debootstrap --variant=minbase "$1" "$2" "$mirror"
  cp -L /etc/resolv.conf "$2/etc/resolv.conf"
  echo force-unsafe-io > "$2/etc/dpkg/dpkg.cfg.d/unsafe-io"  # it need not survive a power cut
  apt-config dump Acquire | grep -i '::proxy' > "$2/etc/apt/apt.conf.d/90this-machine" || true
  if [ -r "${NODE_EXTRA_CA_CERTS:-}" ]; then
    cp -L "$NODE_EXTRA_CA_CERTS" "$2/usr/local/share/this-machine.pem"
  fi
}

mount_world() {
  mount --rbind /dev "$1/dev"
  mount --rbind /sys "$1/sys"
  mount -t proc proc "$1/proc"
  if [ -n "${CCACHE_DIR:-}" ]; then
    mkdir -p "$1/var/cache/ccache"
    mount --bind "$CCACHE_DIR" "$1/var/cache/ccache"
  fi
}

# remove_worlds FOLDER...
remove_worlds() {
  local world
  for world in "$@"; do
    umount -R "$world/dev" "$world/sys" "$world/proc" 2> /dev/null || true
    umount "$world/var/cache/ccache" 2> /dev/null || true
    rm -rf --one-file-system "$world"
  done
}

# within FOLDER COMMAND: by the shell of the system there, in root's home.
within() {
  local inside=(env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}")
  if command -v npm > /dev/null; then
    inside+=(npm_config_registry="$(npm config get registry 2> /dev/null)")
  fi
  if [ -r "$1/usr/local/share/this-machine.pem" ]; then
    inside+=(NODE_EXTRA_CA_CERTS=/usr/local/share/this-machine.pem)
    inside+=(npm_config_cafile=/usr/local/share/this-machine.pem)
  fi
  if mountpoint -q "$1/var/cache/ccache" && [ -x "$1/usr/bin/ccache" ]; then
    inside+=(CCACHE_DIR=/var/cache/ccache CCACHE_BASEDIR=/root CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  chroot "$1" "${inside[@]}" bash -e -o pipefail -c "cd; $2"
}

# clone_into FOLDER: what is committed here, as misalign in root's home there.
clone_into() {
  git bundle create -q "$1/root/misalign.bundle" HEAD
  timed "git, and the clone" within "$1" 'apt-get update -qq
    apt-get install -qq -y --no-install-recommends git > /dev/null
    git clone -q misalign.bundle misalign'
}

# show_log: of the log times, digests, and what the program says of itself.
show_log() {
  sed -nE 's/^[0-9]* (real|user|sys)\t/  \1 /p; s/^[0-9]* *"(digest)": /  \1 /p
    s/^[0-9]* (compiler|libraries|with|without|instruction set|installed:)/  \1/p' "$log"
}
