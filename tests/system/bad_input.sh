# Bad input: one clear sentence on stderr, the contract's exit code, and nothing half-written.
. "$(dirname "$0")/lib.sh"
mkdir here && cd here || exit 1

# refused CODE WORDS ARGUMENT...: exit code, a message with these words, no output, no new file.
refused() {
  local code=$1 words=$2
  shift 2
  local before
  before=$(find . -type f | sort)
  "$program" "$@" > ../out 2> ../err
  local got=$?
  [ $got = "$code" ] || fail "exit $got, not $code: $*"
  grep -q -- "$words" ../err || { fail "no '$words' for: $*"; cat ../err; }
  [ -s ../out ] && fail "output on stdout: $*"
  [ "$before" = "$(find . -type f | sort)" ] || fail "files were left behind: $*"
}

# campaign SED-SCRIPT: the default campaign with one change, in ../campaign.json.
campaign() { "$program" config --default | sed "$1" > ../campaign.json; }

refused 3 "no such file" search missing.json
echo '{ "name": ' > ../broken.json
refused 3 "is not JSON" search ../broken.json
echo '[]' > ../list.json
refused 3 "must\|object" search ../list.json

while IFS='|' read -r script words; do
  campaign "$script"
  refused 3 "$words" search ../campaign.json
  refused 3 "$words" config --check ../campaign.json
done <<'CASES'
s/"seed"/"sead"/|sead (is not a key here)
s/"amplitude_mm": 0.4/"amplitude_mm": "big"/|amplitude_mm = "big" (must be a number)
s/"amplitude_mm": 0.4/"amplitude_mm": 45/|must be below .*, where a facet of this sheet can lose convexity
s/"rows": 6/"rows": 2/|rows = 2 (must be at least 3
s/"rows": 6/"rows": 5/|rows and columns must both be even for a checkerboard of holes, and are 5 and 6: .*has rank 40 with 43 unknowns and 42 equations.*make rows and columns even
s/"columns": 6/"columns": 7/|make rows and columns even
s/"rows": 6/"rows": 6.5/|must be a whole number
s/"seed": 1/"seed": -1/|seed = -1 (must be a whole number
s/"checkerboard-odd"/[[1,1],[1,2]]/|shares the edge
s/"checkerboard-odd"/[[0,0]]/|lies on the perimeter
s/"checkerboard-odd"/[[1,1]]/|too many constraints.*counting (2.1) gives -13
s/"checkerboard-odd"/[[1,2],[1,4],[2,1],[2,3],[3,2],[3,4],[4,1]]/|too many constraints.*gives -1
s/"checkerboard-odd"/[[9,9]]/|rows 0 to 5
s/"checkerboard-odd"/"chess"/|is no perforation
s/"sample_deg": 1.0/"sample_deg": 7/|whole multiple of sample_deg
s/"deploys_from_deg": 170.0/"deploys_from_deg": 190/|must be from
s/"draws": 1000000/"draws": 1.5/|stop.draws = 1.5
s/"interior"/["A9", "A99"]/|"A99" (is no vertex
s/"panel_width_mm": 80.0/"panel_width_mm": 1e308/|panel_width_mm
s/"name": "miura-6x6"/"name": "..\/x"/|named after it
CASES

# Nested to exhaust a stack, and a key twice.
printf '{"name": %s%s}' "$(printf '[%.0s' {1..9999})" "$(printf ']%.0s' {1..9999})" > ../deep.json
refused 3 "levels deep" config --check ../deep.json
echo '{"seed": 1, "seed": 2}' > ../twice.json
refused 3 "seed occurs twice" config --check ../twice.json

# All faults at once.
campaign 's/"seed": 1/"seed": -1/; s/"ternary"/"many"/; s/"amplitude_mm"/"amplitud_mm"/'
refused 3 "3 faults" search ../campaign.json
for words in "seed = -1" '"many"' "amplitud_mm"; do
  grep -q "$words" ../err || fail "one of three faults is missing: $words"
done

# Usage.
refused 2 "see misalign --help" serch
refused 2 "required" search
refused 2 "--range" search "$source_dir/search/campaigns/miura-4x4.json" --range 5:5
refused 2 "draws" search "$source_dir/search/campaigns/miura-4x4.json" --draws -3

refused 2 "is not a number" fold "$source_dir/search/patterns/table1.json" --to nan
refused 2 "is not a number" search "$source_dir/search/campaigns/miura-4x4.json" --max-time nan

# Patterns.
echo '{ "family": "miura", "rows": 6, "columns": 6, "displacements_mm": { "A99": [0, 0] } }' > ../p.json
refused 3 "A99 (is no vertex" fold ../p.json
echo '{ "family": "miura", "rows": 6, "columns": 6, "displacements_mm": { "A9": [90, 0] } }' > ../p.json
refused 3 "no convex quadrilateral" fold ../p.json

# FOLD meshes: mesh SED-SCRIPT makes ../p.json of a good one with one change.
mesh() {
  sed "$1" "$source_dir/search/patterns/turned-quads-6x6.fold" > ../mesh.fold
  echo '{ "family": "fold", "file": "mesh.fold" }' > ../p.json
}
mesh ''
"$program" fold ../p.json > ../out 2> ../err || { fail "the mesh without a change"; cat ../err; }
while IFS='|' read -r script words; do
  mesh "$script"
  refused 3 "$words" fold ../p.json
  refused 3 "$words" perforations ../p.json
  echo '{ "name": "x", "pattern": { "family": "fold", "file": "mesh.fold" } }' > ../campaign.json
  refused 3 "$words" search ../campaign.json
done <<'CASES'
s/\[\[0.0, 0.0\]/[[NaN, 0.0]/|mesh.fold: is not JSON
s/\[\[0.0, 0.0\]/[[1e999, 0.0]/|mesh.fold: is not JSON
s/\[\[0.0, 0.0\]/[[1e308, 0.0]/|vertex A1 = .1e+308,0.0. (lies farther out
s/\[\[0.0, 0.0\]/[[0.0, 0.0, 2]/|vertex A1 lies .* off the plane of the others
s/"mm"/"furlong"/|frame_unit = "furlong" (is no unit
s/\[\[0, 1, 8, 7\]/[[0, 1, 8]/|face 0 = .0,1,8. (must be four vertices
s/\[\[0, 1, 8, 7\]/[[0, 8, 1, 7]/|is no convex quadrilateral
s/\[1, 2, 9, 8\], //|edge A2-A3 (belongs to no face
s/"vertices_coords": .*/"vertices_coords": [],/|vertices_coords (must be a list that is not empty
s/"V"/"F"/|is "F" (must be a mountain or a valley
CASES
mesh 's/90.697145317, /95.697145317, /'
"$program" fold ../p.json > ../out 2> ../err || fail "a mesh that does not fold rigidly: $(cat ../err)"
grep -q "its base is the nearest sheet found that does, off by at most [0-9.]* mm" ../err ||
  fail "how far off the base is: $(cat ../err)"
refused 3 "mesh.fold (does not fold rigidly, and the nearest sheet found that does is off by [0-9.]* mm" \
  search ../campaign.json
printf 'not { JSON' > ../mesh.fold
refused 3 "mesh.fold: is not JSON, FOLD or OBJ" fold ../p.json
rm ../mesh.fold
refused 3 "mesh.fold: cannot be opened" fold ../p.json

# Simulators.
table1=$source_dir/search/patterns/table1.json
refused 2 "fold limit at 156.34" export "$table1" --format mjcf --from 157 --output o
refused 2 "has no meaning without --format json" export "$table1" --format csv --from 30 --output o
refused 2 "has no meaning without --format inp" export "$table1" --format mjcf --mesh 2 --output o
refused 2 "is not a number from" export "$table1" --format mjcf --friction -1 --output o
refused 2 "is not a whole number from 2" export "$table1" --format inp --mesh 1 --output o
refused 2 "is not a number from" stress "$table1" --disc -1 --output o
refused 2 "required" stress "$table1"
echo '{ "e_gpa": -1, "poison": 0.3 }' > ../material.json
refused 3 "e_gpa = -1" export "$table1" --format inp --material ../material.json --output o
grep -q "poison (is not a key here)" ../err || fail "a key of a material: $(cat ../err)"

# An output that is an input: under its name, another, through a link, in a directory.
cp "$table1" ../t1.json
ln -s t1.json ../link.json
mkdir ../o
for typed in "card ../t1.json --output ../t1.json" "construct ../t1.json --output ../link.json" \
  "optimise ../link.json --goal deploys_from_deg --output ../o/../t1.json" "export ../t1.json --format json --output .."; do
  # shellcheck disable=SC2086
  refused 2 "it would be lost\|would replace the one that is read" $typed
  cmp -s "$table1" ../t1.json || fail "its input was replaced: $typed"
done
refused 2 "is not a number from" bench --seconds 0x10

# A design that names what the sheet has not.
campaign 's/"hold": null/"hold": [1, 2]/'
for verb in "config --check" search; do
  # shellcheck disable=SC2086
  refused 3 "hold = \[1, 2\] (is no panel" $verb ../campaign.json
done
campaign 's/"preloads_n": null/"preloads_n": {"A1-A2": 2}/'
refused 3 "preloads_n.A1-A2 (is no diagonal" config --check ../campaign.json

# Catalogues.
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws 50 --catalogue ../held.db \
  --progress none > /dev/null 2>&1 || fail "a catalogue to hold"
cp ../held.db ../copy.db
refused 5 "holds another campaign.*seed" \
  search "$source_dir/search/campaigns/miura-4x4.json" --seed 7 --catalogue ../held.db
[ "$(sql ../held.db 'SELECT count(*) FROM run')" = 1 ] || fail "the refused run left a trace"
echo "just text, long enough to be no header of a database of any kind that SQLite would know" > ../t.db
cp ../t.db ../t.copy
refused 3 "is no catalogue" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../t.db
cmp -s ../t.db ../t.copy || fail "a file that is no database was changed"
for verb in "status ../t.db" "query ../t.db best" "replay ../t.db 1" "export ../t.db --best 1 --output o"; do
  # shellcheck disable=SC2086
  refused 3 "is no catalogue" $verb
done
refused 3 "no such file" status ../nowhere.db
sqlite3 ../other.db 'CREATE TABLE t (x)'
refused 3 "is no catalogue" status ../other.db
refused 3 "is no catalogue" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../other.db
cp ../held.db ../newer.db
sqlite3 ../newer.db 'PRAGMA user_version = 99' > /dev/null
refused 5 "schema version 99" status ../newer.db

# A build that gave other verdicts.
cp ../held.db ../mixed.db
sqlite3 ../mixed.db "UPDATE run SET golden_verdicts = 'other'"
refused 5 "other verdicts" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../mixed.db

# A second search on a catalogue in use.
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../busy.db --progress none \
  > /dev/null 2>&1 &
busy=$!
begun ../busy.db
refused 4 "another search" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../busy.db
kill -TERM $busy
wait $busy

# A directory that cannot be written; root may write anywhere but in the kernel's own.
refused 1 "cannot be written" \
  search "$source_dir/search/campaigns/miura-4x4.json" --catalogue /sys/misalign.db
refused 1 "cannot be written" \
  search "$source_dir/search/campaigns/miura-4x4.json" --catalogue ../no/such/directory.db
refused 1 "cannot be made" export ../held.db --best 1 --output /sys/misalign

# Standard output that takes nothing.
"$program" fold "$source_dir/search/patterns/table1.json" --json > /dev/full 2> ../err
[ $? = 1 ] || fail "a full standard output"

# SQL that is none, or would write.
refused 2 "refused" query ../held.db "SELEC 1"
for sql_text in "DELETE FROM candidate" "DROP TABLE unit" "ATTACH 'x.db' AS x" "SELECT 1; SELECT 2" \
  "PRAGMA journal_mode = DELETE" "VACUUM INTO 'y.db'" "" "SELECT load_extension('x')"; do
  refused 2 "refused" query ../held.db "$sql_text"
done
refused 2 "is no column" export ../held.db --best 1 --by nothing --output o
cmp -s ../held.db ../copy.db || fail "the catalogue was changed"

# Under mpirun: one sentence, not one for each rank.
mpirun --oversubscribe --bind-to none -n 3 "$program" search missing.json > ../out 2> ../err
[ "$(grep -c 'no such file' ../err)" = 1 ] || fail "one sentence under mpirun"
finish
