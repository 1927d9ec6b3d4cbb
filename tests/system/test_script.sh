# scripts/test.sh, with stand-ins for what it starts: without an option it starts what is quick and says what --all adds;
# with it a failing test ends it with that code; sanitizers are --sanitized alone.
. "$(dirname "$0")/lib.sh"
mkdir -p scripts bin build
cp "$source_dir/scripts/test.sh" scripts
echo 'need_packages() { :; }; build_packages= quick_packages= test_packages= hosts_packages=' > scripts/packages.sh
echo 'echo check.sh "$@" >> calls' > scripts/check.sh
cat > bin/cmake << 'END'
#!/usr/bin/env bash
echo "cmake $*" >> calls
END
# Tests fail, but for those that are quick.
cat > bin/ctest << 'END'
#!/usr/bin/env bash
echo "ctest $*" >> calls
case "$*" in *"-L quick"*) exit 0 ;; esac
exit 8
END
chmod +x bin/* scripts/*.sh
PATH=$work/bin:$PATH

scripts/test.sh > out 2>&1 || fail "exit $?: $(cat out)"
[ "$(tail -1 out | cut -c1-27)" = "scripts/test.sh --all adds:" ] || fail "the last line: $(tail -1 out)"
grep -q 'ctest .*-L quick' calls || fail "no quick tests: $(cat calls)"
grep -qE 'asan|studies|--lint' calls && fail "it does what --all adds: $(cat calls)"

flags() { grep -oE 'DMISALIGN_\w+=\w+' "$1" | grep -v _TESTS= | sort; }
[ "$(flags calls)" = "$(flags "$source_dir/scripts/run.sh")" ] ||
  fail "after scripts/run.sh more than tests is compiled, with $(flags calls)"

rm calls
scripts/test.sh --all > out 2>&1
code=$?
[ $code = 8 ] || fail "exit $code: $(cat out)"
grep -q 'check.sh --lint' calls || fail "no ESLint: $(cat calls)"
grep -q asan calls && fail "it does what --sanitized does: $(cat calls)"

rm calls
mkdir -p build/asan/tests
for program in search solver schema certificate; do
  printf '#!/bin/sh\necho "$0 $GTEST_FILTER" >> ../../../ran\n' > build/asan/tests/${program}_test
done
chmod +x build/asan/tests/*
scripts/test.sh --sanitized > out 2>&1 || fail "--sanitized: $(cat out)"
[ "$(sort -u ran | wc -l)" = 4 ] && [ "$(wc -l < ran)" = 8 ] && grep -q "Slow" ran || fail "--sanitized ran: $(cat ran)"
grep -q 'build --preset asan' calls || fail "no sanitizers: $(cat calls)"
scripts/test.sh --ever > out 2>&1
[ $? = 2 ] && grep -q '^usage: ' out || fail "--ever: $(cat out)"
finish
