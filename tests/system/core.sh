# The preset core, configured and built in build/core as if none of the libraries were there that can be missing: it
# searches as the whole program does, and says in one sentence what it lacks. By command, and by scripts/test.sh --all:
#   core.sh PROGRAM SOURCE_DIR [OPTION...]
# PROGRAM is a whole build; the options go to CMake.
. "$(dirname "$0")/lib.sh"
whole=$program
shift 2
core=$source_dir/build/core/misalign
cmake -S "$source_dir" --preset core "$@" > configured || { cat configured; exit 1; }
cmake --build "$source_dir/build/core" > built || { tail -40 built; exit 1; }

# What is in it.
"$core" --version > version || fail "--version"
grep -qx "with      none" version || fail "--version: $(grep with version)"
missing=$(sed -n 's/^without   //p' version)
[ "$missing" = "$("$whole" --version | sed -n 's/^with      //p')" ] || fail "--version: without $missing"
ldd "$core" | grep -E "sundials|flint|dxf|matio|fcl|ccd|octomap|httplib|python" && fail "what it is linked to"
"$core" doctor > doctor || fail "doctor"
[ "$(echo "$missing" | tr -d ' ' | tr , '\n' | while read -r library; do grep -c "without.*$library" doctor; done | sort -u)" = 1 ] ||
  fail "doctor: $(grep libraries doctor)"

# The same verdicts.
golden() { "$1" doctor --json | grep -A3 '"golden verdicts"'; }
[ -n "$(golden "$core")" ] && [ "$(golden "$core")" = "$(golden "$whole")" ] || fail "golden verdicts"
campaign=$source_dir/search/campaigns/miura-6x6.json
"$whole" search "$campaign" --catalogue whole.db --draws 20000 > /dev/null || fail "search of the whole program"
"${ranks[@]}" 2 "$core" search "$campaign" --catalogue low.db --range 0:12000 > /dev/null || fail "search on two ranks"
"$core" search "$campaign" --catalogue high.db --range 8000:20000 --ranks 2 > /dev/null || fail "search --ranks 2"
"$core" merge core.db low.db high.db > /dev/null || fail "merge"
# Draws are made better there too, to the same sheets.
driven=$source_dir/search/campaigns/miura-6x6-driven.json
for build in "$whole" "$core"; do
  "$build" search "$driven" --range 2448:2449 --progress none --catalogue "driven-$(basename "$(dirname "$build")").db" > /dev/null || fail "search of $driven"
done
[ "$(digest_of driven-core.db)" = "$(digest_of "driven-$(basename "$(dirname "$whole")").db")" ] || fail "the core ends at another sheet"
program=$core
sound core.db 20000
[ -n "$(digest_of whole.db)" ] && [ "$(digest_of core.db)" = "$(digest_of whole.db)" ] || fail "the digest"
for file in whole core; do
  "$core" query $file.db "SELECT * FROM candidates ORDER BY draw" --csv > $file.csv || fail "query"
done
[ "$(wc -l < whole.csv)" -gt 3 ] && cmp -s whole.csv core.csv || fail "candidates differ"

# Panels are not looked at, everything else is.
"$core" verify core.db --all --json > verified.json || fail "verify"
"$whole" verify core.db --all --json > verified-whole.json || fail "verify by the whole program"
[ "$(field verified.json panels_checked)$(field verified-whole.json panels_checked)" = 01 ] || fail "panels_checked"
for key in good candidates worst fault_samples 'checked[0].contact'; do
  [ "$(field verified.json "$key")" = "$(field verified-whole.json "$key")" ] || fail "verify: $key"
done
[ "$("$core" verify core.db | grep -c "panels were not checked.*libfcl-dev")" = 1 ] || fail "verify says nothing of panels"
pattern=$source_dir/search/patterns/table1.json
"$core" verify "$pattern" --json > pattern.json || fail "verify of a pattern"
[ "$(field pattern.json good)$(field pattern.json panels_checked)" = 10 ] || fail "verify of a pattern: panels_checked"

# The same files, but for what comes of letting a sheet go.
for format in json csv fold svg obj; do
  "$whole" export core.db --best 2 --format $format --output whole > /dev/null || fail "export $format"
  "$core" export core.db --best 2 --format $format --output core > /dev/null 2> said || fail "export $format by the core"
  case $format in
    json | fold) grep -q "no deployment.*SUNDIALS" said || fail "export $format says nothing of deployments" ;;
    *) [ ! -s said ] || fail "export $format: $(cat said)" ;;
  esac
done
for file in whole/*; do
  case $file in
    *.json | *.fold)
      for side in whole core; do
        sqlite3 :memory: "SELECT json_remove(readfile('$side/${file#whole/}'), '\$.deployment',
          '\$.\"misalign:data\".deployment')" > $side.json
      done
      [ -s core.json ] && cmp -s whole.json core.json || fail "$file differs" ;;
    *) cmp -s "$file" "core/${file#whole/}" || fail "$file differs" ;;
  esac
done
[ "$(ls whole)" = "$(ls core)" ] || fail "names of files"

# What is missing: one sentence, with the package, and exit code 1.
draw=$("$core" query core.db "SELECT min(draw) FROM candidate" --csv | tail -1 | tr -d '\r')
"$core" certify core.db "$draw" > /dev/null || fail "certify"
"$whole" certify core.db "$draw" --check > /dev/null || fail "the core's certificate does not hold"
"$core" certify "$pattern" --json > certified.json || fail "certify of a pattern"
lacks() {  # LIBRARY PACKAGE ARGUMENT...
  local library=$1 package=$2 code=0
  shift 2
  "$core" "$@" > out 2> said || code=$?
  [ $code = 1 ] || fail "$*: exit code $code"
  [ "$(wc -l < said)" = 1 ] || fail "$*: $(cat said)"
  grep -q "needs $library (this program was built without it); install it (Debian: $package)" said || fail "$*: $(cat said)"
  [ ! -s out ] || fail "$*: results on standard output"
}
lacks FLINT libflint-dev certify core.db --check
lacks FLINT libflint-dev certify core.db --check --ranks 2
lacks FLINT libflint-dev certify certified.json --check
lacks SUNDIALS libsundials-dev deploy "$pattern"
lacks SUNDIALS libsundials-dev query core.db "SELECT deploy_time_s(draw) FROM candidate"
lacks SUNDIALS libsundials-dev export core.db --where "landing_rate_deg_per_s(draw) > 0" --output none
# What follows from energies needs no motion.
for file in whole core; do
  program_of=${!file}
  "$program_of" query core.db --csv "SELECT draw, critical_friction_n_mm_per_mm(draw), static_friction_n_mm_per_mm(draw) FROM
    (SELECT draw FROM candidate ORDER BY draw LIMIT 2)" > $file.csv || fail "friction by the $file program"
done
[ "$(wc -l < core.csv)" = 3 ] && cmp -s whole.csv core.csv || fail "friction differs"
lacks matio libmatio-dev export "$pattern" --format mat --output none
lacks matio libmatio-dev export core.db --best 1 --format mat --output none
lacks dxflib libdxflib-dev export "$pattern" --format dxf --kit --output none
lacks Node.js "nodejs npm" report core.db --output none
lacks cpp-httplib libcpp-httplib-dev watch core.db
[ ! -e none ] || fail "something was written all the same"

# What is installed asks for none of them either.
cmake --install "$source_dir/build/core" --prefix "$work/prefix" > /dev/null || fail "install"
cmake -S "$source_dir/solver/example" -B example -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON -DCMAKE_DISABLE_FIND_PACKAGE_FLINT=ON > configured &&
  cmake --build example > built && example/fold_sheet > folded || { cat configured built; fail "the installed solver"; }
grep -qx "deploys from 156 deg" folded || fail "the installed solver: $(cat folded)"
finish
