# Every verb on a real catalogue, and what it says against the catalogue itself.
. "$(dirname "$0")/lib.sh"
campaign=$source_dir/search/campaigns/miura-4x4.json
"$program" search "$campaign" --draws 1200 > summary 2> log || fail "search"
file=$(ls results/miura-4x4-*.db)
[ -s "$file" ] || fail "the default catalogue"
grep -q "1200 draws" summary || fail "the summary"
[ "$(wc -l < summary)" = 1 ] || fail "more than the summary on stdout"

"$program" --help | grep -q replay || fail "--help"
for verb in $("$program" --help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
  "$program" $verb --help | grep -q Example || fail "$verb --help has no example"
done
"$program" --version | grep -q "^compiler" || fail "--version"
for library in SUNDIALS FLINT dxflib matio FCL cpp-httplib; do  # tests are built with all of them
  "$program" --version | grep -q "^with .*\b$library\b" || fail "--version: $library"
done

"$program" status "$file" --json > status.json || fail "status"
[ "$(sqlite3 :memory: "SELECT json_extract(readfile('status.json'), '\$.draws')")" = 1200 ] ||
  fail "status --json"
"$program" status "$file" --at 170 > /dev/null || fail "status --at"
"$program" status "$file" --at 120 > /dev/null 2> err
[ $? = 2 ] || fail "status --at below the threshold"

# A candidate again: replay, export and fold of what was exported give the same verdict.
draw=$(sql "$file" 'SELECT draw FROM candidates ORDER BY goes_back, deploys_from_deg DESC, miscut_margin_mm DESC, slope_min_mm_per_deg DESC LIMIT 1')
deploys=$(sql "$file" "SELECT deploys_from_deg FROM candidate WHERE draw = $draw")
"$program" replay "$file" "$draw" --json > replay.json || fail "replay"
[ "$(field replay.json verdict.accepted)" = 1 ] || fail "replay: accepted"
[ "$(field replay.json verdict.deploys_from_deg)" = "$deploys" ] || fail "replay: verdict"
"$program" export "$file" --best 1 --output out > exported || fail "export"
[ "$(cat exported)" = "out/miura-4x4-$draw.json" ] || fail "export's names"
[ "$(field "$(cat exported)" metrics.deploys_from_deg)" = "$deploys" ] || fail "export: metrics"
sqlite3 :memory: "SELECT json_extract(readfile('$(cat exported)'), '\$.pattern')" > pattern.json
"$program" fold pattern.json --json > fold.json || fail "fold of an exported pattern"
[ "$(field fold.json verdict.deploys_from_deg)" = "$deploys" ] || fail "fold: verdict"
[ "$(field fold.json 'diagonals[0].length_mm[99]')" = \
  "$(field replay.json 'diagonals[0].length_mm[99]')" ] || fail "fold and replay differ"
"$program" export "$file" --draw "$draw" --format csv --output out > /dev/null || fail "export csv"
head -1 "out/miura-4x4-$draw.csv" | grep -q "^draw,pilot_deg,diagonal," || fail "csv header"
"$program" export "$file" --where "stroke_max > 0.01" --output out > exported || fail "export --where"
[ "$(wc -l < exported)" = "$(sql "$file" 'SELECT count(*) FROM candidate WHERE stroke_max > 0.01')" ] ||
  fail "export --where: count"

# A sheet by construction goes its whole path, and what cannot be had is refused.
"$program" construct "$source_dir/search/patterns/table1.json" --amplitude 4 --output made.json > /dev/null ||
  fail "construct"
"$program" fold made.json --to 179 --json > made-fold.json || fail "fold of a constructed sheet"
[ "$(field made-fold.json verdict.deploys_from_deg)" = 179.0 ] || fail "construct: verdict"
"$program" construct "$source_dir/search/patterns/table1.json" --stroke 0.5 2> err
[ $? = 2 ] || fail "construct out of reach"
"$program" construct "$source_dir/search/patterns/turned-quads-6x6.json" 2> err
[ $? = 3 ] || fail "construct of a base without the family"

# A rejected draw can be looked at too.
rejected=$(sql "$file" 'WITH RECURSIVE n(d) AS (SELECT 0 UNION ALL SELECT d + 1 FROM n WHERE d < 1199)
  SELECT d FROM n WHERE d NOT IN (SELECT draw FROM candidate) LIMIT 1')
"$program" replay "$file" "$rejected" --json > rejected.json || fail "replay of a rejected draw"
[ "$(field rejected.json verdict.accepted)" = 0 ] || fail "replay: a rejected draw"
"$program" replay "$file" 9223372036854775806 > /dev/null || fail "replay of a draw never made"

"$program" tolerance "$file" "$draw" --amplitude 0.05 --trials 20 > /dev/null || fail "tolerance"
for name in best stroke strongest tolerant yields simplest acceptance rejections; do
  for style in "" --json --csv; do
    "$program" query "$file" $name $style > rows || fail "query $name $style"
    [ -s rows ] || fail "query $name $style is empty"
  done
done

"$program" fold "$source_dir/search/patterns/table1.json" --json > table1.json || fail "fold table1"
[ "$(field table1.json verdict.deploys_from_deg)" = 156.0 ] || fail "table1: deploys from"
[ "$(field table1.json unknowns)" = 55 ] || fail "table1: unknowns"
"$program" fold "$source_dir/search/patterns/table1.json" --to 90 --step 0.5 --json > half.json
[ "$(field half.json 'samples_deg[#-1]')" = 90.0 ] || fail "fold --to"
[ "$(sqlite3 :memory: "SELECT json_array_length(readfile('half.json'), '\$.samples_deg')")" = 180 ] ||
  fail "fold --step"

# Perforations: those of a sheet with even sides can be folded, odd sides have none.
pattern() { echo "{ \"family\": \"miura\", \"rows\": $1, \"columns\": $2 ${3:-} }" > p.json; }
pattern 4 4 && "$program" perforations p.json > list || fail "perforations"
[ "$(head -3 list | tail -2 | tr -s ' ' | cut -c2-)" = "19 18 18 [[1,1],[2,2]]
19 18 18 [[1,2],[2,1]]" ] || fail "perforations of 4 x 4: $(cat list)"
tail -1 list | grep -q "^2 leave one degree of freedom; 0 more" || fail "perforations: the last line"
for holes in $(sed -n 's/.*\(\[\[.*\)/\1/p' list); do
  pattern 4 4 ", \"holes\": $holes" && "$program" fold p.json > /dev/null || fail "fold with $holes"
done
pattern 5 6 && "$program" perforations p.json > list || fail "perforations of 5 x 6"
[ "$(cat list)" = "0 leave one degree of freedom; 2 more count to 1 by (2.1) but are not 1: 2 of rank 40 with 42 equations" ] ||
  fail "perforations of 5 x 6: $(cat list)"
"$program" perforations p.json --json > list.json || fail "perforations --json"
[ "$(field list.json 'count_to_one_only[1].degrees_of_freedom')" = 3 ] || fail "perforations --json"
"$program" perforations "$source_dir/search/patterns/double-corrugation-6x6.json" --json > list.json
[ "$(field list.json 'perforations[0].holes[0][1]')" = 1 ] || fail "perforations of a FOLD mesh"

# A finished catalogue can be read where nobody may write: one plain file, no -wal beside it.
[ "$(ls results)" = "$(basename "$file")" ] || fail "files beside the finished catalogue: $(ls results)"
"$program" fold "$source_dir/search/patterns/table1.json" --to 56.3 --json > part.json
[ "$(field part.json fold_limit_deg)" = 56.3 ] || fail "fold --to between samples"

"$program" config --default > default.json && "$program" config --check default.json > /dev/null ||
  fail "config"
for shipped in "$source_dir"/search/campaigns/*.json; do
  "$program" config --check "$shipped" > /dev/null || fail "config --check $shipped"
done
# The reference judges by what the campaign accepts: of these 60 draws 21 go back between two samples.
echo '{"pattern": {"family": "miura", "rows": 4, "columns": 4}, "misalignment": {"amplitude_mm": 2},
       "path": {"sample_deg": 10}, "accept": {"deploys_from_deg": 150, "between_samples": true}}' > bumps.json
"$program" bench bumps.json --agree 60 > agreement || fail "bench forgets accept.between_samples: $(cat agreement)"
sed 's/"between_samples": true/"between_samples": "exact"/' bumps.json > exact.json
"$program" bench bumps.json --rejections 500 > agreement && grep -q ' 0 of [0-9]* decisions differ' agreement ||
  fail "bench --rejections: $(cat agreement)"
"$program" bench exact.json --agree 20 > agreement ||
  fail "another verdict between the samples than the reference's: $(cat agreement)"

# Every verb that writes JSON writes nothing else on standard output, with all that there is to warn of on the other one:
# an angle beyond D, a certificate that is not what it proves, a yield that is not kept since another program writes there.
cp "$file" other.db
"$program" certify other.db "$draw" > /dev/null || fail "certify"
sqlite3 other.db "UPDATE certificate SET certified_deg = certified_deg - 1" || fail "no certificate to spoil"
cat > locked.py << 'END'
import fcntl, subprocess, sys
with open(sys.argv[1], "r+b") as catalogue:
    fcntl.lockf(catalogue, fcntl.LOCK_EX, 1, 1 << 62)
    sys.exit(subprocess.run(sys.argv[2:]).returncode)
END
echo '{ "family": "miura", "rows": 4, "columns": 4, "design": { "from_deg": 60 },
  "free": { "amplitude_mm": [1, 1], "thickness_mm": { "of": [1] }, "one_a_hole": true, "rim": true } }' > wish.json
cat > json-calls << END
status $file
fold $source_dir/search/patterns/table1.json --to 20
perforations p.json
construct $source_dir/search/patterns/table1.json --amplitude 1
optimise $file $draw --steps 1
replay $file $draw
query $file best
verify $file --sample 2
certify other.db $draw
tolerance $file $draw --amplitude 0.05 --trials 5
doctor
actuators $file $draw
contact $file $draw
deploy $source_dir/search/patterns/table1.json --from 156.3
card $file $draw --from 60
report $source_dir/search/patterns/table1.json
shape $source_dir/search/patterns/dome-6x6.json
design wish.json --draws 0 --trials 5
bench --agree 5
config --materials
END
for verb in $("$program" --help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
  "$program" "$verb" --help | grep -q -- "^  --json" || continue
  case $verb in stress) continue ;; esac  # needs another program: tests/system/stress.sh
  grep -q "^$verb\b" json-calls || fail "$verb --json: is called nowhere here"
done
said() {  # LEVEL WORD...
  local level=$1 lock=()
  shift
  [ "$1" != tolerance ] || lock=(python3 locked.py "$file")
  "${lock[@]}" "$program" "$@" --json --log-level "$level" > out.json 2> err
  case $?:$1 in 0:* | 6:card | 6:design) ;; *) fail "$* --json: $(cat err)" ;; esac
  json_test out.json "json_valid(j)" || fail "$* --json: $(head -c 200 out.json)"
}
while read -r -a words; do
  said debug "${words[@]}"
  case ${words[0]} in
    deploy) grep -q "^misalign: .*beyond D = 156 deg" err ;;
    certify) grep -q "^misalign: .*its certificate is made again" err ;;
    tolerance) grep -q "^misalign: this is not kept in the catalogue" err ;;
  esac || fail "no warning of ${words[*]}: $(cat err)"
  said off "${words[@]}"
  [ ! -s err ] || fail "${words[*]} --log-level off: $(cat err)"
done < json-calls

finish
