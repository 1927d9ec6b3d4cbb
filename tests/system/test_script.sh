# scripts/test.sh, with stand-ins for what it starts: without an option it starts what is quick and says what --all adds;
# with it, when a test fails, nothing that ran beside the tests is left.
. "$(dirname "$0")/lib.sh"
mkdir -p scripts bin build
cp "$source_dir/scripts/test.sh" scripts
echo 'need_packages() { :; }; build_packages= quick_packages= test_packages= hosts_packages=' > scripts/packages.sh
echo 'echo check.sh "$@" >> calls' > scripts/check.sh
# A compiler of the sanitizers' build, which writes down its number and works for an hour.
cat > bin/cmake << 'END'
#!/usr/bin/env bash
echo "cmake $*" >> calls
case "$*" in *"--build --preset asan"*) sleep 3000 & echo $! > compiler; wait ;; esac
END
# Tests that fail once that build is under way; those that are quick do not wait for it.
cat > bin/ctest << 'END'
#!/usr/bin/env bash
echo "ctest $*" >> calls
case "$*" in *"-L quick"*) exit 0 ;; esac
until [ -s compiler ]; do sleep 0.05; done
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
[ -s compiler ] || fail "no compiler was started: $(cat out)"
is_gone() { ! kill -0 "$(cat compiler)" 2> /dev/null; }
eventually "a compiler is left" is_gone || kill "$(cat compiler)"

scripts/test.sh --ever > out 2>&1
[ $? = 2 ] && grep -q '^usage: ' out || fail "--ever: $(cat out)"
finish
