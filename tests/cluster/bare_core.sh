#!/usr/bin/env bash
# The preset core on a Debian that has nothing but its base system and what the core needs, without any of the
# libraries that can be missing. As root, by command:
#   bare_core.sh SUITE
# SUITE is bookworm, trixie or another that debootstrap knows. From clone to build; then doctor, a campaign on two
# ranks, the rest of it on one, merge, verify, query, export, and a verb that says what it lacks. Prints how long each
# part took (results/package.md); the whole output is left in build/core-SUITE.log.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/cluster/debian_world.sh
begin core "$@"
mount_world "$world"
clone_into "$world"
timed "packages" within "$world" 'cd misalign
  . scripts/packages.sh
  need_packages $core_packages ${CCACHE_DIR:+ccache}
  dpkg-query -W -f "\${Status} \${Package} \${Installed-Size}\n" | awk "/^install ok/ { n++; kB += \$NF }
    END { print \"installed: \" n \" packages, \" int(kB / 1000) \" MB\" }"'
timed "configuring and building" within "$world" 'cd misalign
  cmake --preset core
  time cmake --build --preset core'
timed "what it does" within "$world" 'export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export PATH=~/misalign/build/core:$PATH
  misalign --version
  misalign doctor
  misalign search misalign/search/campaigns/miura-6x6.json --ranks 2 --range 0:150000 --catalogue low.db
  misalign search misalign/search/campaigns/miura-6x6.json --range 100000:200000 --catalogue high.db
  misalign merge all.db low.db high.db
  misalign status all.db --json | grep digest
  misalign verify all.db --sample 3
  misalign query all.db best --no-pager
  for format in json csv fold; do misalign export all.db --best 1 --format $format --output out; done
  code=0
  misalign deploy misalign/search/patterns/table1.json || code=$?
  [ $code = 1 ]'
echo
show_log
