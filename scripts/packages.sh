# Sourced: makes sure that what a script needs is installed, on Debian and Ubuntu as root or with sudo;
# elsewhere says what is missing and stops.

# What the preset core needs, and what a build with everything needs.
core_packages="g++ cmake ninja-build git libeigen3-dev libopenmpi-dev openmpi-bin libsqlite3-dev
  libsqlitecpp-dev nlohmann-json3-dev libspdlog-dev libfmt-dev libcli11-dev librandom123-dev
  libxxhash-dev libboost-math-dev libxsimd-dev"
build_packages="$core_packages libfcl-dev libsundials-dev libflint-dev pkg-config libmatio-dev
  libdxflib-dev libcpp-httplib-dev pybind11-dev python3-dev python3-numpy help2man"
# Arb, until it became part of FLINT 3.
if [ "$(. /etc/os-release 2> /dev/null && echo "${VERSION_CODENAME:-}")" = bookworm ]; then
  build_packages+=" libflint-arb-dev"
fi
# Node.js for the page of the report, unless a good one is there already (from elsewhere).
if ! node -e 'process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)' 2> /dev/null ||
  ! command -v npm > /dev/null; then
  build_packages+=" nodejs npm"
fi
# The manual as a site (scripts/site.sh), and the figures of its gallery.
site_packages="python3-sphinx python3-myst-parser python3-sphinx-gallery furo python3-numpy python3-pandas
  python3-matplotlib"
# What tests that are quick need beside a build, and the others.
quick_packages="libgtest-dev libbenchmark-dev libvalijson-dev libmpfi-dev libmujoco-dev sqlite3 clang-format
  hunspell hunspell-en-gb python3 octave"
test_packages="$site_packages calculix-ccx procps mandoc zsh chromium mypy python3-ezdxf curl
  clang-tidy"
hosts_packages="iproute2 mount"  # tests/cluster
slurm_packages="slurmctld slurmd slurm-client munge"  # tests/cluster

need_packages() {
  local missing=() package
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "This is no Debian or Ubuntu. Install the counterparts of these packages, then build with" >&2
    echo "cmake --preset release && cmake --build --preset release:" >&2
    echo "$@" | tr -s ' \n' ' ' >&2
    exit 1
  fi
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2> /dev/null | grep -q 'ok installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo > /dev/null; then
      echo "Missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y \
    --no-install-recommends "${missing[@]}" > /dev/null
}

# mpirun refuses root without these, and on one machine nothing is gained by binding.
if [ "$(id -u)" = 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
