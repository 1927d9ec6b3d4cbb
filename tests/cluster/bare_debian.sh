#!/usr/bin/env bash
# The README's first command on a Debian that has nothing but its base system: from clone to report, then
# `cmake --install`, and what was installed is used. As root, by command:
#   bare_debian.sh SUITE [SECONDS]
# SUITE is bookworm, trixie or another that debootstrap knows; the run itself takes SECONDS (5). Prints how
# long each part took (results/bare-debian.md); the whole output is left in build/bare-SUITE.log.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/cluster/debian_world.sh
begin bare "$@"
seconds=${2:-5}
mount_world "$world"
clone_into "$world"
bare() { within "$world" "$1"; }
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
  / \[[0-9]+\/[0-9]+\] / && !found { last = $1 }
  /The best candidates/ && !found { found = $1; print "  to the first candidates", found - first, "s" }
  / (real|user|sys)\t/ { print "  " $2, $3 }
  END { print "  building", last - first, "s" }'
grep -E ': (stopped|complete|max_time), ' "$log" | sed 's/^[0-9]* /  /'
sed -n '/^== what was/,$p' "$log" | sed -nE 's/^[0-9]* (compiler|libraries|instruction set)/  \1/p'
