# `cmake --install` into a folder: everything is where a distribution expects it, and works from there.
. "$(dirname "$0")/lib.sh"
build=$(dirname "$program")
prefix=$work/prefix
cmake --install "$build" --prefix "$prefix" > log 2>&1 || { fail "cmake --install"; cat log; finish; }
share=$prefix/share

for file in share/doc/misalign/README.md share/doc/misalign/search/manual/index.md \
  share/doc/misalign/LICENSE share/misalign/schema/catalogue.sql \
  share/misalign/schema/campaign.schema.json share/misalign/schema/migrations/8.sql \
  share/misalign/patterns/table1.json share/bash-completion/completions/misalign \
  share/zsh/site-functions/_misalign; do
  [ -s "$prefix/$file" ] || fail "$file is not there"
done
for kind in schema/queries search/campaigns search/patterns; do
  [ "$(ls "$source_dir/$kind")" = "$(ls "$share/misalign/${kind#search/}")" ] || fail "$kind"
done
site=$share/doc/misalign/html
[ ! -d "$source_dir/build/site/html" ] || [ -s "$site/index.html" ] || fail "the site that was made is not installed"
strange=$(find "$prefix" ! -path "$site/*" \( -name '*.cpp' ! -path '*/examples/*' -o -name '*.hpp' \
  ! -path '*/include/misalign/*' -o -name '*.a' ! -name libmisalign_solver.a -o -name results -o -type d -empty \))
[ -z "$strange" ] || fail "what nobody installs: $strange"

# The program finds nothing but what it carries and what is beside it.
installed=$prefix/bin/misalign
strip -o stripped "$installed" && grep -qF "$source_dir" stripped && fail "the program knows its source folder"
"$installed" search "$share/misalign/campaigns/turned-quads-6x6.json" --draws 200 --progress none \
  > summary 2> err || { fail "search"; cat err; }
"$installed" query results/turned-quads-6x6-*.db acceptance > rows || fail "query"
for campaign in "$share"/misalign/campaigns/*.json; do
  "$installed" config --check "$campaign" > /dev/null || fail "$campaign"
done
for pattern in "$share"/misalign/patterns/*.json; do
  "$installed" fold "$pattern" --to 5 > /dev/null || fail "$pattern"
done
mkdir -p "$site"
touch "$site/index.html"
[ "$("$installed" help --site)" = "$(realpath "$site/index.html")" ] || fail "where the site is"
rm "$site/index.html"
"$installed" help --site > said 2> err
[ $? = 1 ] && [ ! -s said ] && grep -q scripts/site.sh err || fail "where there is no site: $(cat said err)"

"$installed" completion bash | cmp - "$share/bash-completion/completions/misalign" || fail "bash completion"
"$installed" completion zsh | cmp - "$share/zsh/site-functions/_misalign" || fail "zsh completion"

# The Python package, where it was built, with nothing but what was installed.
package=$(find "$prefix" -path '*/misalign/__init__.py')
if [ -n "$package" ]; then
  python=$(sed -n 's/^_*Python_EXECUTABLE:[A-Z]*=//p' "$build/CMakeCache.txt" | head -n 1)
  PYTHONPATH=${package%/misalign/__init__.py} "${python:-/usr/bin/python3}" -B -c "
import misalign
print(misalign.read('$share/misalign/patterns/table1.json').fold([90]).length_mm.shape)" > shape 2> err ||
    { fail "import misalign"; cat err; }
  [ "$(cat shape)" = "(1, 16)" ] || fail "what Python says: $(cat shape)"
fi

if [ ! -d "$build/man" ]; then
  echo "no help2man: no manual pages"
  finish
fi
pages=$share/man/man1
verbs=$("$program" --help | awk '/^[A-Z]/ { in_verbs = /^Verbs:/ } in_verbs && /^  [a-z]/ { print $1 }')
[ "$({ echo misalign.1; for verb in $verbs; do echo "misalign-$verb.1"; done; } | sort)" = "$(ls "$pages" | sort)" ] ||
  fail "pages: $(ls "$pages")"
for verb in "" $verbs; do
  name=misalign${verb:+-$verb}
  # Without the marks of roff.
  sed 's/\\f[BIR]//g; s/\\[,/]//g; s/\\-/-/g' "$pages/$name.1" > page
  # shellcheck disable=SC2086
  for option in $("$program" $verb --help | sed -nE 's/^  ((-[a-z], )?--[a-z-]+).*/\1/p' | tr -d ,); do
    grep -qE "^(-., )?$option( |,|\$)" page || fail "$name.1 has no $option"
  done
  title=$(sed -n '/^\.SH NAME/{n;p;}' page)
  case $title in
    "$name - "?*) ;;
    *) fail "$name.1: NAME $title" ;;
  esac
  grep -qiE "^\.TH $name \"?1\"? " page || fail "$name.1: $(grep '^\.TH' page)"
  for section in SYNOPSIS DESCRIPTION OPTIONS '"EXIT STATUS"' EXAMPLES '"SEE ALSO"'; do
    grep -qx "\.SH $section" page || fail "$name.1 has no $section"
  done
  for other in $(sed -nE 's/^\.BR (misalign[a-z-]*) \(1\),?$/\1/p' page); do
    [ -s "$pages/$other.1" ] || fail "$name.1 names $other(1), which is not there"
  done
  if command -v mandoc > /dev/null; then
    mandoc -T lint -W warning "$pages/$name.1" > lint || { fail "mandoc: $name.1"; cat lint; }
    mandoc -T utf8 "$pages/$name.1" | grep -q "$name" || fail "mandoc shows no $name.1"
  fi
done
finish
