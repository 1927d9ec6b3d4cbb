# The solver as `cmake --install` leaves it, for other programs: its example is configured by find_package, links, and
# says what `misalign fold` says.
. "$(dirname "$0")/lib.sh"
prefix=$work/prefix
cmake --install "$(dirname "$program")" --prefix "$prefix" --component dev > log 2>&1 ||
  { fail "cmake --install"; cat log; finish; }
headers=$prefix/include/misalign
[ "$(find "$prefix" -name '*.a' -exec basename {} +)" = libmisalign_solver.a ] || fail "libraries"
[ -e "$headers/solver/reference" ] && fail "the yardstick is installed"
grep -rlF "$source_dir" "$prefix" --include='*.cmake' && fail "it knows its source folder"

# The example, and every header, with nothing beside them but what the package file finds.
(cd "$headers" && find solver -name '*.hpp' | sort | sed 's/.*/#include "&"/') > headers.cpp
[ "$(wc -l < headers.cpp)" -gt 100 ] || fail "headers: $(wc -l < headers.cpp)"
cat > CMakeLists.txt << END
cmake_minimum_required(VERSION 3.25)
project(stranger LANGUAGES CXX)
add_subdirectory($source_dir/solver/example example)
find_package(misalign REQUIRED)
add_library(headers OBJECT headers.cpp)
target_link_libraries(headers PRIVATE misalign::solver)
END
if cmake -G Ninja -S . -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS=-O1 > log 2>&1 &&
  cmake --build build >> log 2>&1 && build/example/fold_sheet > said; then
  "$program" fold "$source_dir/search/patterns/table1.json" --json > folding
  sqlite3 :memory: "WITH folding(it) AS (SELECT CAST(readfile('folding') AS TEXT))
    SELECT printf('deploys from %d deg', it ->> '\$.verdict.deploys_from_deg') FROM folding
    UNION ALL SELECT printf('%s-%s %.9f %.9f mm', value ->> 'from', value ->> 'to', value ->> 'flat_mm',
      value ->> '\$.length_mm[#-1]') FROM folding, json_each(it, '\$.diagonals')" > expected
  [ "$(wc -l < expected)" = 17 ] || fail "misalign fold: $(cat expected)"
  diff said expected || fail "the example says something else"
else
  fail "the example"
  cat log
fi

# Later minor versions are for it, another major version is not.
printf 'find_package(misalign ${VERSION} QUIET CONFIG)\nmessage("${misalign_FOUND}")\n' > version.cmake
for version in 2 1.99 0.1; do
  found=$(cmake -DCMAKE_PREFIX_PATH="$prefix" -DVERSION=$version -P version.cmake 2>&1)
  [ "$found" = 0 ] || fail "find_package(misalign $version): $found"
done
finish
