#!/usr/bin/env bash
# The Debian packages, from sources to removal. As root, by command:
#   try_deb.sh SUITE [FOLDER]
# SUITE is bookworm, trixie or another that debootstrap knows. In a Debian that has nothing but its base system
# scripts/package.sh makes the packages and lintian looks at them; FOLDER takes those that are there instead. In a
# second, just as bare, apt installs them, and what was installed is used: doctor, a campaign on two ranks, the report,
# and solver/example is built. Prints how long each part took (results/package.md); the whole output is left in
# build/deb-SUITE.log, the packages in build/debs-SUITE.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/cluster/debian_world.sh
begin deb "$@"
debs=$PWD/build/debs-$suite
user=$world maker=$(mktemp -d)
worlds+=("$maker")
rm -rf "$debs"
mkdir -p "$debs"

if [ $# -lt 2 ]; then
  cp -a "$user/." "$maker"
  mount_world "$maker"
  clone_into "$maker"
  timed "packages to build with" within "$maker" 'cd misalign
    . scripts/packages.sh
    need_packages $build_packages dpkg-dev file lintian ${CCACHE_DIR:+ccache}'
  timed "scripts/package.sh" within "$maker" 'cd misalign && time scripts/package.sh'
  timed "the same bytes again" within "$maker" 'cd misalign/build/package
    sha256sum packages/*.deb | tee before
    touch -d 1990-01-01 misalign  # as if it had been made another day
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) cpack > /dev/null || exit 1
    sha256sum -c before'
  # No errors and no warnings; the initial upload to Debian that it misses is none of ours.
  timed "lintian" within "$maker" 'lintian --allow-root --fail-on error,warning \
    --suppress-tags initial-upload-closes-no-bugs misalign/build/package/packages/*.deb'
  cp "$maker/root/misalign/build/package/packages/"*.deb "$debs"
else
  cp "$2"/*.deb "$debs"
fi

mount_world "$user"
mkdir "$user/root/debs"
cp "$debs"/*.deb "$user/root/debs"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
timed "apt-get install ./misalign_*.deb" within "$user" 'apt-get update -qq
  apt-get install -y --no-install-recommends ./debs/misalign_*.deb
  ldd /usr/bin/misalign | { ! grep "not found"; }'
timed "what was installed" within "$user" 'export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  mkdir results
  misalign --version
  misalign doctor results
  misalign search /usr/share/misalign/campaigns/miura-6x6.json --ranks 2 --draws 200000
  misalign status results/*.db --json | grep digest
  misalign query results/*.db best --no-pager
  misalign verify results/*.db --sample 3
  misalign report results/*.db --output report.html
  grep -q "</html>" report.html
  test -s /usr/share/man/man1/misalign-search.1.gz
  test -s /usr/share/bash-completion/completions/misalign'
timed "the example" within "$user" 'apt-get install -y --no-install-recommends ./debs/libmisalign-dev_*.deb \
    cmake g++ make > /dev/null
  cmake -S /usr/share/doc/libmisalign-dev/examples -B example
  cmake --build example
  example/fold_sheet | tee said
  misalign fold /usr/share/misalign/patterns/table1.json | grep -F "156"
  grep -qx "deploys from 156 deg" said'
if compgen -G "$debs/python3-misalign_*" > /dev/null; then
  timed "the Python module" within "$user" 'apt-get install -y --no-install-recommends ./debs/python3-misalign_*.deb \
      python3-pandas > /dev/null
    cd /tmp
    python3 -c "import glob, os, misalign
catalogue = misalign.Catalogue(glob.glob(os.path.expanduser(\"~/results/*.db\"))[0])
print(len(catalogue.candidates()), \"candidates\")"'
fi
timed "removal" within "$user" 'apt-get purge -y misalign libmisalign-dev "python3-misalign*" > /dev/null
  ! find / -xdev -path /proc -prune -o -path /root -prune -o -iname "*misalign*" -print | grep .'
echo
show_log
