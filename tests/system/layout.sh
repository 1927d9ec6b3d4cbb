# scripts/house.py, names.py and tidy.py, on a tree of some lines: a number that is worse fails, one that is better is kept
# by --write, a name that the code does not have is found where it stands, and clang-tidy sees what has changed.
. "$(dirname "$0")/lib.sh"
python=$source_dir/scripts
mkdir -p solver/pattern solver/linear schema search/draws scripts
printf '#pragma once\n#include "solver/linear/b.hpp"\nstruct A {\n};\n' > solver/linear/a.hpp
printf '#pragma once\n#include "solver/linear/a.hpp"\nclass B final : A {\n};\n' > solver/linear/b.hpp
printf '#include "solver/linear/a.hpp"\n// In kLines.\nint kLines() {\n  assert(1);\n  return 1;\n}\n' > search/draws/draw_evaluator.cpp
house() { python3 "$python/house.py" "$@" . > out 2>&1; }
held() { python3 -c 'import json, sys; print(json.load(open("scripts/house.json"))[sys.argv[1]])' "$1"; }
expect() { [ "$(held "$1")" = "$2" ] || fail "$1: $(held "$1"), not $2"; }

# The numbers, counted by hand.
house --write || fail "--write: $(cat out)"
expect 'lines of C++' 14
expect 'public types: solver' 2
expect 'circles of includes' 1
expect 'files that `draw_evaluator.cpp` reaches by includes' 3
expect 'functions over 70 lines' 0
expect '`assert`' 1
house --check || fail "as it was written: $(cat out)"
[ ! -s out ] || fail "as it was written it says: $(cat out)"

# Worse: a sentence each, and --write keeps the file's.
long=$(printf '  ++i;\n%.0s' {1..70})
printf 'struct C {\n};\n  void f() {\n%s\n  }\n' "$long" >> solver/linear/b.hpp
sed -i /assert/d search/draws/draw_evaluator.cpp
house --check && fail "worse numbers pass"
for sentence in 'lines of C++: 87, and 14 in' 'public types: solver: 3, and 2 in' 'functions over 70 lines: 1, and 0 in' \
  '`assert`: 0, and 1 in'; do
  grep -qF "$sentence scripts/house.json" out || fail "no “$sentence”: $(cat out)"
done
[ "$(wc -l < out)" = 4 ] || fail "more than four sentences: $(cat out)"
house --write
expect 'lines of C++' 14
expect '`assert`' 1

# Better: it passes, says so and is kept.
printf '#pragma once\nclass B final {\n  void f() { assert(1), assert(2); }\n};\n' > solver/linear/b.hpp
house --check || fail "better numbers fail: $(cat out)"
grep -q 'circles of includes: 0, better than the 1 in .*--write keeps it' out || fail "better: $(cat out)"
house --write
expect 'circles of includes' 0
expect '`assert`' 2

# Too long, and an include of a later room.
yes '//' | head -351 > solver/pattern/c.cpp
printf '#include "solver/linear/a.hpp"\n' > solver/pattern/d.cpp
house --check && fail "a long file and an include upwards pass"
grep -q 'solver/pattern/c.cpp: 351 lines' out || fail "no long file: $(cat out)"
grep -q 'd.cpp includes solver/linear/a.hpp, which is in a later room' out || fail "no include upwards: $(cat out)"

# Names: what code has is none, nor what stands in a changelog; the others are found with their lines.
git init -q .
printf 'The `kLines` of `linear/a`, and `solver/linear/`.\nNot `kNone`, `NoType`, `no_such()` or `linear/z`; `X_json` is.\n' > README.md
printf 'There was `kNone`.\n' > CHANGELOG.md
printf '// NoType, in tests/none_test.cpp: kLines are in solver/linear/a.hpp.\n' > solver/linear/e.cpp
printf 'X_json\n' > words.json
git add README.md CHANGELOG.md solver/linear search words.json
python3 "$python/names.py" . > out 2>&1 && fail "names of nothing pass"
cut -d: -f1-3 out | sort > found
sort > expected << 'END'
README.md:2: kNone
README.md:2: NoType
README.md:2: no_such
README.md:2: linear/z
solver/linear/e.cpp:1: NoType
solver/linear/e.cpp:1: tests/none_test.cpp
END
diff expected found || fail "names: $(cat out)"

# clang-tidy, which has no objection to any but e.cpp: what was clean is not looked at until it or its headers change.
mkdir -p bin build/tidy
cp "$python/tidy.py" scripts
echo > .clang-tidy
cat > bin/clang-tidy << 'END'
#!/usr/bin/env bash
[ "$1" != --version ] || exit 0
echo "${@: -1}" >> called
[[ $* != *e.cpp ]] || { echo "e.cpp:1: an objection"; exit 1; }
END
chmod +x bin/clang-tidy
PATH=$work/bin:$PATH
unit() { echo "{\"file\": \"$work/$1\", \"command\": \"c++ $1\"}"; }
draws=search/draws/draw_evaluator.cpp fold=solver/linear/e.cpp
echo "[$(unit $draws), $(unit $fold)]" > build/tidy/compile_commands.json
tidy() {  # with options, that many objections, and of these files
  touch called
  python3 scripts/tidy.py build/tidy "${@:3}" > out
  [ $? = "$1" ] || fail "tidy ${*:3}: not exit $1: $(cat out)"
  for file in $2; do echo "$work/$file"; done | sort | diff - <(sort called) || fail "tidy ${*:3}: not of these alone: $2"
  rm called
}
tidy 1 "$draws $fold"
grep -q 'an objection' out || fail "no objection: $(cat out)"
tidy 1 $fold
tidy 0 "" draws
tail -1 out | grep -q '0 of 1 units looked at, 1 clean since before, 0 for another time' || fail "$(cat out)"
tidy 0 "" --for 0
grep -q '1 for another time' out || fail "--for 0: $(cat out)"
echo '// Another line.' >> solver/linear/b.hpp  # by a.hpp
tidy 1 "$draws $fold"
finish
