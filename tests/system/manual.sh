# The manual's pages, each typed in a fresh clone where the program is built:
#   manual.sh PROGRAM SOURCE_DIR [--all] [PAGE...]
# PAGE is such as tutorials/campaign.md; none for all. --all types blocks that are called slow, too (ten minutes).
. "$(dirname "$0")/lib.sh"
shift 2
everything=
[ "${1-}" != --all ] || { everything=--all; shift; }
build=$(dirname "$program")
manual=$source_dir/search/manual
fresh_clone clone || fail "git clone"
mkdir -p clone/build home
ln -s "$build" clone/build/release
pages=("$@")
[ $# -gt 0 ] || mapfile -t pages < <(cd "$manual" && grep -lE '^ *```(sh|python)' -r --include=*.md . | sort)

# typed PAGE FOLDER: types it there.
typed() {
  python3 "$source_dir/tests/system/typed.py" "$manual/$1" $everything > "$2.sh" || { fail "$1: its blocks"; return; }
  (cd "$2" && env -i HOME="$work/home" LC_ALL=C.UTF-8 PATH="$build:$PATH" PYTHONPATH="$build/python" \
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 bash "$2.sh") > "$2.log" 2>&1 < /dev/null
  if [ "$(grep -c '^\$ ' "$2.log")" != "$(grep -c '^type_it ' "$2.sh")" ] || grep '^LINE FAILED' "$2.log"; then
    fail "$1:"
    cat "$2.log"
  fi
}

# What the others ask for.
typed how-to/index.md "$work/clone"
[ -s clone/small.db ] || fail "how-to/index.md makes no small.db"
for page in "${pages[@]#./}"; do
  begin=$SECONDS
  cp -a clone typed
  typed "$page" "$work/typed"
  echo "$page: $((SECONDS - begin)) s"
  rm -rf typed
done
finish
