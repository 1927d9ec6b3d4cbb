# No rejection test turns a draw away that deploys: 50,000 draws, each followed on its full path too (results/level.md has
# the long form).
. "$(dirname "$0")/lib.sh"

for name in miura-4x4 miura-6x6; do
  "$program" bench "$source_dir/search/campaigns/$name.json" --rejections 25000 > "$name" 2> err ||
    fail "$name: $(cat "$name" err)"
  grep -q '^25000 draws: 0 of [0-9]* decisions differ' "$name" || fail "$name: $(cat "$name")"
done

finish
