# scripts/house.py, on a tree of some lines: a number that is worse fails, and one that is better is kept by --write.
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
finish
