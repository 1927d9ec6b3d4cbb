# The README's shell blocks, typed line by line as printed by a stranger in a fresh clone with an empty
# HOME: as this user, and as root also as an ordinary one. Then what the README says of installing.
# Left out are scripts/test.sh, of which this is a part, and scripts/run.sh for a minute: the tour has it for a second.
# Nothing is compiled or fetched again: in the clone, where CMake calls compiler and linker, stand-ins give
# empty objects and the program under test, and npm gives the packages that the build has already.
. "$(dirname "$0")/lib.sh"
build=$(dirname "$program")
chmod 755 "$work"

# One command a line.
awk '/^```/ { inside = $0 == "```sh"; if (inside) block++; next } inside { print block "\t" $0 }' \
  "$source_dir/README.md" | sed -e ':join' -e '/\\$/{N;s/\\\n[0-9]*\t */ /;b join' -e '}' > blocks
cut -f2 blocks | grep -vE '^(scripts/test\.sh|scripts/run\.sh)( *#.*)?$' | grep . > lines
grep -qx 'scripts/run.sh 1 .*' lines || fail "no scripts/run.sh for a second in the README"
[ "$(grep -c '^misalign ' lines)" -ge 13 ] || fail "too few lines: $(cat lines)"
grep -E '^```(bash|shell|console)' "$source_dir/README.md" && fail "shell blocks that are not called sh"

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
case \$out in misalign | python/misalign/_misalign.*) ;; *) exec "\$@" ;; esac
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

# The lines, and after each whether it did what it says.
write_typed() {
  while IFS= read -r line; do
    printf 'printf "%%s\\n" %q\n%s\n' "\$ $line" "$line"
    printf 'code=$?; [ $code = 0 ] || echo "LINE FAILED: exit $code:" %q\n' "$line"
  done < lines > typed.sh
}
write_typed

# tour NAME COMMAND...: all of it, started by COMMAND.
tour() {
  local name=$1 tree=$work/$1/misalign home=$work/$1/home start=$EPOCHSECONDS
  shift
  mkdir -p "$work/$name/tmp" "$home"
  # Whoever owns the source folder; what was changed there and not committed comes along.
  printf '[safe]\n\tdirectory = *\n' > gitconfig
  export GIT_CONFIG_GLOBAL=$work/gitconfig
  git clone -q "$source_dir" "$tree" || { fail "$name: git clone"; return; }
  git -C "$source_dir" ls-files -z --modified --others --exclude-standard |
    tar -C "$source_dir" --null --files-from=- --ignore-failed-read -cf - 2> /dev/null | tar -C "$tree" -xf -
  unset GIT_CONFIG_GLOBAL
  [ "$name" = user ] && chown -R nobody "$work/$name"
  (cd "$tree" && exec "$@" env -i HOME="$home" TMPDIR="$work/$name/tmp" LC_ALL=C.UTF-8 \
    PATH="$work/stand-ins:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin" \
    CMAKE_CXX_COMPILER_LAUNCHER="$work/stand-ins/compile" CMAKE_CXX_LINKER_LAUNCHER="$work/stand-ins/link" \
    bash "$work/typed.sh") > "$name.log" 2>&1 < /dev/null || fail "$name: the shell ended with $?"
  if [ "$(grep -c '^\$ ' "$name.log")" != "$(wc -l < lines)" ] || grep '^LINE FAILED' "$name.log"; then
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
  echo "$name: $(wc -l < lines) lines in $((EPOCHSECONDS - start)) s"
}

tour self
if [ "$(id -u)" = 0 ]; then
  # What takes much processor time and is the same for both.
  sed -i -E '/miura-6x6-flat|^misalign (tolerance|verify|deploy|actuators|contact|stress)/d' lines
  write_typed
  tour user setpriv --reuid=nobody --regid=nogroup --clear-groups
fi
finish
