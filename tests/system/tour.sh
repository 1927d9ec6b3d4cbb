# The README's shell blocks, typed line by line as printed by a stranger in a fresh clone with an empty
# HOME: as this user, and as root also as an ordinary one. Then what the README says of installing.
# Left out are scripts/test.sh, of which this is a part, and scripts/run.sh for a minute: the tour has it for a second.
# Nothing is compiled or fetched again: in the clone, where CMake calls compiler and linker, stand-ins give
# empty objects and the program under test, and npm gives the packages that the build has already.
. "$(dirname "$0")/lib.sh"
build=$(dirname "$program")
chmod 755 "$work"

python3 "$source_dir/tests/system/typed.py" "$source_dir/README.md" > all.sh || fail "README's blocks"
grep -vE "^type_it '?scripts/(test|run)\\.sh( *#.*)?'?\$" all.sh > typed.sh
grep -q "^type_it 'scripts/run.sh 1 " typed.sh || fail "no scripts/run.sh for a second in the README"
[ "$(grep -c "^type_it 'misalign " typed.sh)" -ge 13 ] || fail "too few lines: $(cat typed.sh)"

mkdir stand-ins
cat > stand-ins/compile << 'END'
#!/bin/sh
# COMPILER OPTION...: an empty object for what belongs to the program; CMake's own trials are compiled.
out= depends= previous=
for word; do
  case $previous in -o) out=$word ;; -MF) depends=$word ;; esac
  previous=$word
done
case $out in solver/* | schema/* | search/* | CMakeFiles/misalign*) ;; *) exec "$@" ;; esac
: > "$out"
[ -z "$depends" ] || : > "$depends"
END
cat > stand-ins/link << END
#!/bin/sh
# COMPILER OPTION...: the program under test, and the Python module beside it.
for word; do
  [ "\$previous" = -o ] && out=\$word
  previous=\$word
done
case \$out in misalign | first/misalign | python/misalign/_misalign.*) ;; *) exec "\$@" ;; esac
cp "$work/stand-ins/\$(basename "\$out")" "\$out"
END
cp "$program" stand-ins/misalign
[ ! -d "$build/python" ] || cp "$build"/python/misalign/_misalign.*.so stand-ins
if [ -d "$build/report/node_modules" ]; then
  cp -r "$build/report/node_modules" stand-ins/node_modules
  printf '#!/bin/sh\n[ "$1" = ci ] && cp -r "%s" .\n' "$work/stand-ins/node_modules" > stand-ins/npm
fi
chmod 755 stand-ins/*
chmod -R a+rX stand-ins

# tour NAME COMMAND...: all of it, started by COMMAND.
tour() {
  local name=$1 tree=$work/$1/misalign home=$work/$1/home start=$EPOCHSECONDS
  shift
  mkdir -p "$work/$name/tmp" "$home"
  fresh_clone "$tree" || { fail "$name: git clone"; return; }
  [ "$name" = user ] && chown -R nobody "$work/$name"
  (cd "$tree" && exec "$@" env -i HOME="$home" TMPDIR="$work/$name/tmp" LC_ALL=C.UTF-8 \
    PATH="$work/stand-ins:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin" \
    CMAKE_CXX_COMPILER_LAUNCHER="$work/stand-ins/compile" CMAKE_CXX_LINKER_LAUNCHER="$work/stand-ins/link" \
    bash "$work/typed.sh") > "$name.log" 2>&1 < /dev/null || fail "$name: the shell ended with $?"
  if [ "$(grep -c '^\$ ' "$name.log")" != "$(grep -c '^type_it ' typed.sh)" ] || grep '^LINE FAILED' "$name.log"; then
    fail "$name:"
    cat "$name.log"
  fi
  for page in results/report.html report.html; do
    grep -q '</html>' "$tree/$page" || fail "$name: no $page"
  done
  [ "$(find "$tree/found" -name '*.fold' | wc -l)" = 3 ] || fail "$name: $(ls "$tree/found")"
  # As the manual says, and nothing more was built for it.
  (cd "$tree" && exec "$@" env -i HOME="$home" PATH="$PATH" cmake --install build/release \
    --prefix "$home/.local") > install.log 2>&1 || { fail "$name: cmake --install"; cat install.log; }
  "$home/.local/bin/misalign" --version > /dev/null || fail "$name: what was installed does not start"
  [ -s "$home/.local/share/bash-completion/completions/misalign" ] || fail "$name: no completion"
  ! command -v help2man > /dev/null || [ -s "$home/.local/share/man/man1/misalign-search.1" ] ||
    fail "$name: no manual pages"
  echo "$name: $(grep -c '^type_it ' typed.sh) lines in $((EPOCHSECONDS - start)) s"
}

tour self
if [ "$(id -u)" = 0 ]; then
  # What takes much processor time and is the same for both.
  sed -i -E "/miura-6x6-flat|^type_it 'misalign (tolerance|verify|deploy|actuators|certify)/d" typed.sh
  tour user setpriv --reuid=nobody --regid=nogroup --clear-groups
fi
finish
