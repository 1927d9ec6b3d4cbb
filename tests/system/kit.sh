# Kits to cut, as readers of DXF and SVG have them, beside the sheet of the FOLD export: lengths, kerf,
# areas, numbers, bores, beds. KIT_LONG=1: five patterns in every form, with what was measured.
. "$(dirname "$0")/lib.sh"
patterns=$source_dir/search/patterns
for python in /usr/bin/python3 python3 none; do
  "$python" -c 'import ezdxf' 2> /dev/null && break
done
[ "$python" != none ] || { fail "no Python has ezdxf (python3-ezdxf)"; finish; }

# check NAME WISHES OPTION...: both formats of a kit with these options, to be looked at with all others
# below; what the check is told of them.
kits=0
check() {
  local name=$1 wishes=$2 format
  shift 2
  kits=$((kits + 1))
  for format in dxf svg; do
    "$program" export "$name" --format $format --kit "$@" --output kit$kits > /dev/null || fail "$name $*: $format"
  done
  echo "$sheet $wishes ${KIT_LONG:+--numbers}" kit$kits/* >> checks
}

# A draw of a catalogue, and pattern files: one with eight loose panels, and those of other families.
"$program" search "$source_dir/search/campaigns/miura-4x4.json" --catalogue a.db --draws 200 --progress none \
  > /dev/null || fail "search"
draw=$(sql a.db 'SELECT min(draw) FROM candidate')
"$program" export a.db --draw "$draw" --format fold --output sheets > names || fail "export fold"
mv "$(cat names)" sheets/draw.fold
"$program" export a.db --draw "$draw" --output sheets > names && mv "$(cat names)" draw.json
echo '{ "family": "miura", "rows": 8, "columns": 8, "panel_width_mm": 80, "panel_height_mm": 80,
  "zigzag_offset_mm": 40, "displacements_mm": { "A11": [0.4, -0.4], "A30": [-0.4, 0.0] } }' > 8x8.json
files=(draw.json 8x8.json "$patterns/table1.json")
[ -n "${KIT_LONG-}" ] && files+=("$patterns/miura-graded-6x6.json" "$patterns/turned-quads-6x6.json" \
  "$patterns/double-corrugation-6x6.json")
bores="--joint-bore 1.2 --spring-bore 1.5"
for file in "${files[@]}"; do
  sheet=sheets/$(basename "$file" .json).fold
  [ -e "$sheet" ] || "$program" export "$file" --format fold --output sheets > /dev/null || fail "$file: fold"
  check "$file" ""
  [ -n "${KIT_LONG-}" ] || [ "$file" != draw.json ] || continue
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.2 $bores" --kerf 0.2 $bores
  [ -n "${KIT_LONG-}" ] || [ "$file" = 8x8.json ] || continue
  check "$file" "--kerf 0.2 --crease cut" --kerf 0.2 --crease cut
  check "$file" "--kerf 0.2 --crease dash --dash 3 1.5" --kerf 0.2 --crease dash --dash-mm 3,1.5
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.1 --bed 300 420 $bores" --kerf 0.1 --bed 300x420 $bores
done
# On a narrow bed pieces are turned.
sheet=sheets/draw.fold
check draw.json "--bed 200 400" --bed 200x400
grep -q 'rotate(-90 ' kit$kits/*.svg || fail "nothing is turned on a narrow bed"
# The catalogue's draw and its exported candidate are one kit.
"$program" export a.db --draw "$draw" --format svg --kit --output one > names || fail "kit of a draw"
"$program" export draw.json --format svg --kit --output other > other_names || fail "kit of a candidate"
diff <(grep -v 'misalign' "$(cat names)") <(grep -v 'misalign' "$(cat other_names)") > /dev/null ||
  fail "a draw and its exported candidate are two kits"

# What sees nothing wrong must be able to.
sheet=sheets/table1.fold
# shellcheck disable=SC2086
"$program" export "$patterns/table1.json" --format dxf --kit $bores --output spoilt > names
echo "$sheet $bores $(cat names) --spoil open twice corner crease valley number swapped label opening knot hatch gauge
  shift bore bores far scale" | tr -d '\n' >> checks
echo >> checks
"$program" export "$patterns/table1.json" --format dxf --kit --kerf 0.23 --output kerf > names
echo "$sheet --wrong --kerf 0.2 $(cat names)" >> checks
"$program" export "$patterns/table1.json" --format dxf --kit --crease dash --output dash > names
echo "$sheet --wrong --crease dash --dash 4.1 1 $(cat names)" >> checks
# A crease pattern as DXF is that of the SVG.
for format in dxf svg; do
  "$program" export "$patterns/table1.json" --format $format --output plain > /dev/null || fail "plain $format"
done
echo "$sheet --plain plain/table1.dxf plain/table1.svg" >> checks
"$python" -B "$source_dir/tests/system/kit_check.py" < checks || fail "kits"

# One sentence, exit code 2, and no file, for what cannot be cut.
while IFS='|' read -r words meant; do
  # shellcheck disable=SC2086
  "$program" export "$patterns/table1.json" $words --output refused > out 2> err
  [ $? = 2 ] && [ "$(wc -l < err)" = 1 ] && [ ! -s out ] || fail "$words: $(cat err)"
  grep -q -- "$meant" err || fail "no '$meant' for: $words: $(cat err)"
done << 'END'
--format obj --kit|--kit has no meaning without --format svg or dxf
--format svg --kerf 0.2|--kerf has no meaning without --kit
--format dxf --kit --dash-mm 3,1|--dash-mm has no meaning without --crease dash
--format dxf --kit --bore-edge 3|--bore-edge has no meaning without --joint-bore or --spring-bore
--format dxf --kit --crease dash --dash-mm 0.1,1 --kerf 0.2|no longer than the kerf
--format dxf --kit --kerf 90 --gap 100|too wide for the contours
--format dxf --kit --kerf 1 --gap 0.5|less than the kerf
--format dxf --kit --joint-bore 0.2 --kerf 0.2|no larger than the kerf
--format dxf --kit --joint-bore 40 --spring-bore 30|would fit
--format dxf --kit --bed 130x130|does not fit, turned neither
--format dxf --kit --bed 120x500|too small for the title and a gauge
--format dxf --kit --bed 600|is no width and height in mm
--format dxf --kit --crease fold|'fold' is none of cut, score, dash
END
[ -e refused ] && [ -n "$(ls refused)" ] && fail "a refused kit leaves files: $(ls refused)"
finish
