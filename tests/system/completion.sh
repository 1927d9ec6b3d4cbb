# Completion offers every option that --help shows, in bash and (where there is one) zsh.
. "$(dirname "$0")/lib.sh"
"$program" completion bash > misalign.bash || fail "completion bash"
"$program" completion zsh > _misalign || fail "completion zsh"

verbs=$("$program" --help | awk '/^[A-Z]/ { in_verbs = /^Verbs:/ } in_verbs && /^  [a-z]/ { print $1 }')
[ "$(echo "$verbs" | wc -l)" -ge 14 ] || fail "verbs in --help: $verbs"

# options [VERB]: those that its --help shows, one a line.
options() {
  "$program" "$@" --help | sed -nE 's/^  (((-[a-z]|--[a-z-]+), )?--[a-z-]+).*/\1/p' | tr -d , | tr ' ' '\n' | sort
}

# in_bash WORD...: what is offered for the last of the words.
in_bash() {
  bash --norc -c 'source ./misalign.bash
    COMP_WORDS=(misalign "$@") COMP_CWORD=$#
    _misalign
    [ ${#COMPREPLY[@]} = 0 ] || printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort
}

# expect FUNCTION "WORDS" OFFERED: those and no others.
expect() {
  local offered
  # shellcheck disable=SC2086
  offered=$($1 $2 "${4-}" | tr '\n' ' ')
  [ "$offered" = "${3:+$3 }" ] || fail "$1 $2 ${4-}: '$offered', not '$3'"
}

touch campaign.json other.txt found.db
mkdir folder
[ "$(in_bash '')" = "$(echo "$verbs" | sort)" ] || fail "bash: verbs: $(in_bash '')"
[ "$(in_bash -)" = "$(options)" ] || fail "bash: options of the program: $(in_bash -)"
for verb in $verbs; do
  [ "$(options "$verb" | wc -l)" -ge 4 ] || fail "options in $verb --help"
  [ "$(in_bash "$verb" -)" = "$(options "$verb")" ] || fail "bash: options of $verb: $(in_bash "$verb" -)"
done
expect in_bash "search --storage" "local network"
expect in_bash "search --storage =" "local network"
expect in_bash "search --storage = " "local" l
expect in_bash "--log-level" "debug" d
expect in_bash "export --format" "json" js
expect in_bash "search" "campaign.json folder"
expect in_bash "search --draws 3" "campaign.json folder"
expect in_bash "search --draws" ""
expect in_bash "fold" "campaign.json folder"
expect in_bash "status" "folder found.db"
expect in_bash "merge a.db b.db" "folder found.db"
expect in_bash "doctor" "folder"
expect in_bash "query found.db" "best" b
expect in_bash "config --check" "campaign.json folder"
expect in_bash "completion" "bash zsh"
expect in_bash "deploy --hinge" 'printed\ pin\ hinge' pr
# Names with spaces, as typed with a backslash or within quotes, and files.
[ "$(in_bash deploy --material 'aluminium\ 5')" = 'aluminium\ 5052-H32' ] || fail "bash: $(in_bash deploy --material 'aluminium\ 5')"
[ "$(in_bash deploy --material '"birch p')" = 'birch\ plywood' ] || fail "bash: $(in_bash deploy --material '"birch p')"
[ "$(in_bash deploy --material c | tr '\n' ' ')" = 'campaign.json carbon\ laminate cardboard ' ] || fail "bash: $(in_bash deploy --material c)"
mkdir lines && cd lines || exit 1
cp ../misalign.bash .
touch 'plain.json' $'a\nb.json'
expect in_bash "fold" "plain.json"
cd .. || exit 1
for query in "$source_dir"/schema/queries/*.sql; do
  in_bash query found.db '' | grep -qx "$(basename "$query" .sql)" || fail "bash: $query"
done

if ! command -v zsh > /dev/null; then
  echo "no zsh: its completion is not tried"
  finish
fi
# A shell in a terminal of its own, in which what compadd gets is written down.
cat > try.zsh << 'END'
zmodload zsh/zpty
zpty shell zsh -f -i
# What it shows up to a mark that a command prints.
settle() { zpty -w shell "print -r -- '<'done'>'"; zpty -r shell shown "*<done>*" }
zpty -w shell "PROMPT= RPROMPT=; unsetopt zle_bracketed_paste; autoload -U compinit; compinit -D -u"
zpty -w shell "source ./_misalign"
zpty -w shell 'compadd() {
  local -a offered; local -A parsed
  builtin compadd -O offered "$@"
  print -rl -- $offered >> ./offered
  return 1 }'
zpty -w shell 'finished() { : > ./finished; zle kill-buffer }; zle -N finished; bindkey "^F" finished'
settle
while IFS= read -r line; do
  rm -f finished; : > offered
  zpty -w -n shell $'\C-u'"$line"$'\t\C-f'
  while [[ ! -e finished ]]; do sleep 0.01; done
  print -r -- "$line: ${(j: :)${(ou)${(f)"$(<offered)"}}}"
done
zpty -d shell
END
{
  echo "misalign "
  for verb in $verbs; do echo "misalign $verb --"; done
  printf '%s\n' "misalign search --storage " "misalign search --storage=l" "misalign query found.db " \
    "misalign status " "misalign deploy --hinge " "misalign deploy --material "
} | timeout $patience_s zsh -f try.zsh > offers 2> err || fail "zsh: $(cat err)"
# offers_for LINE: what zsh offered.
offers_for() { grep -F -- "$1: " offers | head -1 | sed 's/^[^:]*: //' | tr ' ' '\n' | sed 's/=$//' | sort -u; }
for verb in $verbs; do
  offers_for "misalign " | grep -q "^$verb" || fail "zsh: $verb: $(offers_for 'misalign ')"
  [ "$(offers_for "misalign $verb --")" = "$(options "$verb" | grep -- --)" ] ||
    fail "zsh: options of $verb: $(offers_for "misalign $verb --")"
done
[ "$(offers_for "misalign search --storage " | tr '\n' ' ')" = "local network " ] || fail "zsh: --storage"
offers_for "misalign search --storage=l" | grep -qx local || fail "zsh: --storage=l"
offers_for "misalign query found.db " | grep -qx best || fail "zsh: named queries"
offers_for "misalign deploy --hinge " | grep -qx textile || fail "zsh: --hinge: $(offers_for "misalign deploy --hinge ")"
offers_for "misalign deploy --material " | grep -qx cardboard || fail "zsh: --material"
offers_for "misalign deploy --material " | grep -qx campaign.json || fail "zsh: files of --material"
offers_for "misalign status " | grep -qx found.db || fail "zsh: catalogues"
finish
