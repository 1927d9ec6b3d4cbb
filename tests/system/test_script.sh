# scripts/test.sh, with stand-ins for what it starts: when a test fails, nothing that ran beside the tests is left.
. "$(dirname "$0")/lib.sh"
mkdir -p scripts bin build
cp "$source_dir/scripts/test.sh" scripts
echo 'need_packages() { :; }; build_packages= test_packages= hosts_packages=' > scripts/packages.sh
echo ':' > scripts/check.sh
# A compiler of the sanitizers' build, which writes down its number and works for an hour.
cat > bin/cmake << 'END'
#!/usr/bin/env bash
case "$*" in *"--build --preset asan"*) sleep 3000 & echo $! > compiler; wait ;; esac
END
# Tests that fail once that build is under way.
cat > bin/ctest << 'END'
#!/usr/bin/env bash
until [ -s compiler ]; do sleep 0.05; done
exit 8
END
chmod +x bin/* scripts/*.sh
PATH=$work/bin:$PATH scripts/test.sh > out 2>&1
code=$?
[ $code = 8 ] || fail "exit $code: $(cat out)"
[ -s compiler ] || fail "no compiler was started: $(cat out)"
is_gone() { ! kill -0 "$(cat compiler)" 2> /dev/null; }
eventually "a compiler is left" is_gone || kill "$(cat compiler)"
finish
