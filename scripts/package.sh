#!/usr/bin/env bash
# Debian packages for the system that this runs on, into build/package/packages: misalign, libmisalign-dev, and
# python3-misalign where the sources have it. The same commit gives the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $build_packages dpkg-dev file

SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2> /dev/null || stat -c %Y CHANGELOG.md)}
export SOURCE_DATE_EPOCH
cmake --preset package "$@" > /dev/null
cmake --build --preset package
rm -rf build/package/packages
cpack --preset package > build/package/cpack.log || { cat build/package/cpack.log >&2; exit 1; }
ls build/package/packages/*.deb
