# Kits to cut, as readers of DXF and SVG have them, beside the sheet of the FOLD export: lengths, kerf,
# areas, numbers, bores, tabs, springs, beds, gaps of outlines; and the page of each. KIT_LONG=1: five patterns in every form, with what was measured.
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
  for format in ${formats:-dxf svg}; do
    "$program" export "$name" --format $format --kit "$@" --output kit$kits > /dev/null 2> err$kits ||
      fail "$name $*: $format"
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
bores="--joint-bore 1.2 --spring-bore 1.5" panel="--spring-at panel"
for file in "${files[@]}"; do
  sheet=sheets/$(basename "$file" .json).fold
  "$program" export "$file" --format fold --step 1 --output sheets > /dev/null || fail "$file: fold"
  check "$file" ""
  [ -n "${KIT_LONG-}" ] || [ "$file" != draw.json ] || continue
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.2 --against 0 $bores" --kerf 0.2 $bores
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.2 $bores $panel" --kerf 0.2 $bores $panel
  [ -n "${KIT_LONG-}" ] || [ "$file" = 8x8.json ] || continue
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.2 --crease cut $bores" --kerf 0.2 --crease cut $bores
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.2 --crease dash --dash 3 1.5 $bores" --kerf 0.2 --crease dash --dash-mm 3,1.5 $bores
  # shellcheck disable=SC2086
  check "$file" "--kerf 0.1 --bed 300 420 $bores" --kerf 0.1 --bed 300x420 $bores
done
# Springs of five sheets, at the vertices and in panels: Table 1, of other panels, one that is not shifted (no
# diagonal of it does anything), a graded one, a mesh. In panels they contradict the verdict, and it is said first.
echo '{ "name": "8x6", "pattern": { "family": "miura", "rows": 8, "columns": 6, "panel_width_mm": 60,
  "panel_height_mm": 90, "zigzag_offset_mm": 20 }, "misalignment": { "amplitude_mm": 0.4 },
  "accept": { "deploys_from_deg": 120 }, "seed": 1 }' > 8x6-campaign.json
"$program" search 8x6-campaign.json --catalogue w.db --draws 100 --progress none > /dev/null || fail "search 8x6"
"$program" export w.db --draw "$(sql w.db 'SELECT min(draw) FROM candidate')" --output drawn > names &&
  mv "$(cat names)" 8x6.json
echo '{ "family": "miura", "rows": 6, "columns": 6, "panel_width_mm": 80, "panel_height_mm": 80,
  "zigzag_offset_mm": 40 }' > unshifted.json
[ -n "${KIT_LONG-}" ] || formats=dxf
for name in miura-graded-6x6 turned-quads-6x6; do
  "$program" export "$patterns/$name.json" --output plain > /dev/null || fail "$name: plain"
  "$python" - $name << 'END'
import json, sys
with open(f"plain/{sys.argv[1]}.json", encoding="utf8") as file:
    sheet = json.load(file)
ends = sorted({d[end] for d in sheet["diagonals"] for end in ("from", "to")})
shifts = {label: [0.1 * ((7 * k) % 9 - 4), 0.1 * ((5 * k) % 7 - 3)] for k, label in enumerate(ends)}
with open(f"shifted-{sys.argv[1]}.json", "w", encoding="utf8") as file:
    json.dump(sheet["pattern"] | {"displacements_mm": shifts}, file)
END
done
for file in "$patterns/table1.json 8 16" "8x6.json 12 24" "unshifted.json 16 16" \
  shifted-miura-graded-6x6.json shifted-turned-quads-6x6.json; do
  read -r file against springs <<< "$file"
  sheet=sheets/$(basename "$file" .json).fold
  "$program" export "$file" --format fold --step 1 --output sheets > /dev/null || fail "$file: fold"
  # shellcheck disable=SC2086
  check "$file" "--against 0 $bores" $bores
  [ ! -s err$kits ] || fail "$file, springs at vertices: $(cat err$kits)"
  # shellcheck disable=SC2086
  check "$file" "${against:+--against $against} $bores $panel" $bores $panel
  words="${against:-[1-9]} of ${springs:-16} springs contradict the verdict"
  [ "$(wc -l < err$kits)" = 1 ] && grep -q "$words" err$kits ||
    fail "$file, springs in panels: $(cat err$kits)"
done
formats=
# A pattern that says where its springs end: there are the bores, and the verdict is about these springs.
sed 's/"holes"/"springs": { "attach": { "inset_mm": 12 } }, "holes"/' "$patterns/table1.json" > attached.json
sheet=sheets/attached.fold
"$program" export attached.json --format fold --step 1 --output sheets > /dev/null || fail "attached.json: fold"
# shellcheck disable=SC2086
check attached.json "--kerf 0.2 --against 0 --attached $bores $panel" --kerf 0.2 $bores
[ ! -s err$kits ] || fail "springs where the pattern has them: $(cat err$kits)"
# Two of them at points of their own, on the panels beside the hole.
points='{ "hole": [1, 2], "vertex": "A10", "panel": [0, 2], "from_vertex_mm": [20, 4, 0] },
  { "hole": [1, 2], "vertex": "A11", "panel": [1, 3], "from_vertex_mm": [20, -4, 0] }'
sed "s/\"inset_mm\": 12/&, \"points\": [ ${points//$'\n'/} ]/" attached.json > points.json
sheet=sheets/points.fold
"$program" export points.json --format fold --step 1 --output sheets > /dev/null || fail "points.json: fold"
# shellcheck disable=SC2086
check points.json "--kerf 0.2 --against 0 --attached --point A10 r0c2 --point A11 r1c3 $bores $panel" --kerf 0.2 $bores
# shellcheck disable=SC2086
"$program" export attached.json --format dxf --kit $bores $panel --output never > /dev/null 2> err &&
  fail "--spring-at though the pattern says it"
grep -q "the pattern says where its springs end" err || fail "--spring-at: $(cat err)"
# Plates keep to the bed, too.
"$program" export draw.json --format dxf --kit --bed 300x420 --fill '{"kind": "plate"}' --output rubber > /dev/null || fail "plates on a bed"
[ -n "$(ls rubber | grep -e '-kit-plates-1')" ] || fail "plates on a bed: $(ls rubber)"

# On a narrow bed pieces are turned.
sheet=sheets/draw.fold
check draw.json "--bed 200 400 --turned" --bed 200x400
# Inches; a grain; an angle of use, at which tables end.
# shellcheck disable=SC2086
check draw.json "--units in --kerf 0.2 $bores" --units in --kerf 0.2 $bores
# shellcheck disable=SC2086
check draw.json "--grain --crease cut $bores" --grain --crease cut $bores
# shellcheck disable=SC2086
check draw.json "--from 60 $bores" --from 60 $bores
# Options override the design in the guide: 2 mm of 2.7 g/cm3, springs of 30 N/mm, a latch, hinges of a named kind.
"$program" export draw.json --format svg --kit --output own > /dev/null || fail "the design's kit"
"$program" export draw.json --format svg --kit --thickness 2 --stiffness 30 --hold-flat --material "birch plywood" \
  --output typed > /dev/null || fail "overrides of a kit"
grep -q "2.00 mm thick" typed/draw-kit.html && grep -q "30 N/mm" typed/draw-kit.html && grep -q birch typed/draw-kit.html &&
  grep -q "Add the stop, latch or frame" typed/draw-kit.html && ! grep -q "score_" typed/draw-kit.svg ||
  fail "overrides are not in the guide"
grep -q " mm thick\|Add the stop\|30 N/mm" own/draw-kit.html && fail "a guide of another design"
# A design's angle of use that the sheet does not reach is no fault of its kit: the guide says so, and ends at D.
"$program" export "$patterns/dome-6x6.json" --format svg --kit --output unreached > /dev/null || fail "a kit that does not deploy"
grep -q "lies beyond D = 0°" unreached/dome-6x6-kit.html || fail "the guide of a sheet that does not deploy"
# Parts lie close together: the length they take of a strip is at most 35 % above the bound by their area.
for nest in "$patterns/table1.json" 8x6.json "$patterns/turned-quads-6x6.json"; do
  "$program" export "$nest" --format dxf --kit --crease cut --gap 3 --bed 600x2000 --output "nest-$(basename "$nest" .json)" \
    > names || fail "$nest: nest"
  grep 'dxf$' names | sort -V | PYTHONPATH=$source_dir/tests/system xargs "$python" -B \
    "$source_dir/tests/system/nest_measure.py" 1.35 5 > nested || fail "$nest is nested loosely: $(cat nested)"
  [ -z "${KIT_LONG-}" ] || echo "$nest: $(cat nested)"
done
# The catalogue's draw and its exported candidate are one kit.
"$program" export a.db --draw "$draw" --format svg --kit --output one > names || fail "kit of a draw"
"$program" export draw.json --format svg --kit --output other > other_names || fail "kit of a candidate"
diff <(grep -v 'misalign' "$(head -1 names)") <(grep -v 'misalign' "$(head -1 other_names)") > /dev/null ||
  fail "a draw and its exported candidate are two kits"

# What sees nothing wrong must be able to.
sheet=sheets/table1.fold
# shellcheck disable=SC2086
"$program" export "$patterns/table1.json" --format dxf --kit $bores --output spoilt > names
echo "$sheet $bores $(tr '\n' ' ' < names) --spoil open twice corner crease valley number swapped label opening knot mark
  shift bore bores far scale tab history way" | tr '\n' ' ' >> checks
echo >> checks
# shellcheck disable=SC2086
"$program" export "$patterns/table1.json" --format dxf --kit $bores $panel --output spoilt-panel > names 2> /dev/null
echo "$sheet $bores $panel $(tr '\n' ' ' < names) --spoil bore bores history way warning" >> checks
"$program" export "$patterns/table1.json" --format dxf --kit --kerf 0.23 --output kerf > names
echo "$sheet --wrong --kerf 0.2 $(tr '\n' ' ' < names)" >> checks
"$program" export "$patterns/table1.json" --format dxf --kit --crease cut --gap 4.9 --output near > names
echo "$sheet --wrong --crease cut $(tr '\n' ' ' < names)" >> checks
"$program" export "$patterns/table1.json" --format dxf --kit --crease dash --output dash > names
echo "$sheet --wrong --crease dash --dash 4.1 1 $(tr '\n' ' ' < names)" >> checks
# A crease pattern as DXF is that of the SVG.
for format in dxf svg; do
  "$program" export "$patterns/table1.json" --format $format --output plain > /dev/null || fail "plain $format"
done
echo "$sheet --plain plain/table1.dxf plain/table1.svg" >> checks
# With --only-cut nothing is left that is hidden or not cut, and what is cut stays as it is.
for format in dxf svg; do
  "$program" export "$patterns/table1.json" --format $format --only-cut --output only > /dev/null || fail "--only-cut $format"
  # shellcheck disable=SC2086
  "$program" export "$patterns/table1.json" --format $format --kit --only-cut --crease dash $bores --output only > /dev/null ||
    fail "--kit --only-cut $format"
  # shellcheck disable=SC2086
  "$program" export "$patterns/table1.json" --format $format --kit --crease dash $bores --output plain > /dev/null
done
grep -q 'display:none\|<text\|springs\|labels' only/table1.svg && fail "hidden layers in --only-cut"
grep -q '^SPRINGS\|^LABELS\|^ENGRAVE\|^NOTE\|^HATCH' only/*.dxf && fail "layers that are not cut in --only-cut"
PYTHONPATH=$source_dir/tests/system "$python" -B - << 'END' || fail "--only-cut"
from kit_drawing import Drawing
for name, cuts in (("table1", ["cut", "mountain", "valley"]),
                   ("table1-kit", ["bore", "cut", "dash_mountain", "dash_valley", "opening", "registration"])):
    for ending in ("dxf", "svg"):
        only, plain = (Drawing(f"{folder}/{name}.{ending}") for folder in ("only", "plain"))
        assert sorted({*only.paths, *only.circles, *only.texts}) == cuts, (name, ending, only.paths.keys())
        for kind in ("paths", "circles"):
            for layer, drawn in getattr(only, kind).items():
                assert drawn == getattr(plain, kind)[layer], (name, ending, layer)
END
"$python" -B "$source_dir/tests/system/kit_check.py" < checks || fail "kits"

# The page to build it by: forces are those of `actuators`, hinges as long as the FOLD file's creases.
"$program" export "$patterns/table1.json" --format svg --kit --guide --from 120 --output guide > names || fail "--guide"
[ "$(tail -1 names)" = guide/table1-kit.html ] || fail "--guide writes $(cat names)"
"$program" actuators "$patterns/table1.json" --from 120 --json > actuators.json || fail "actuators"
"$python" -B - guide/table1-kit.html actuators.json sheets/table1.fold << 'END' || fail "the page"
import html, json, math, re, sys
page, actuators, sheet = (open(name, encoding="utf8").read() for name in sys.argv[1:])
actuators, sheet = json.loads(actuators), json.loads(sheet)
rows = [[html.unescape(cell) for cell in re.findall(r"<td[^>]*>(.*?)</td>", line)] for line in page.split("<tr>")]
springs = {row[0]: row for row in rows if row and re.fullmatch(r"s\d+", row[0])}
assert len(springs) == len(actuators["forces"]) == 16, len(springs)
for force in actuators["forces"]:
    name, ends, does, enough, free, flat, folded, stroke, printed = springs[f"s{force['diagonal']}"]
    assert ends == f"{force['from']}-{force['to']}", ends
    assert does == ("pulls" if force["force_n"] > 0 else "pushes"), name
    assert math.isclose(float(printed), abs(force["force_n"]), rel_tol=6e-3), (printed, force)
    assert abs(50 * abs(float(folded) - float(free)) - float(printed)) < 0.5 + 6e-3 * float(printed), name
    assert abs(float(free) - force["free_mm"]) < 6e-3 and free == flat, name
    assert (enough == "yes") == (ends in actuators["few"]["diagonals"]), name
coordinates = sheet["vertices_coords"]
for kind, letter in (("mountain", "M"), ("valley", "V")):
    length = sum(math.dist(coordinates[a], coordinates[b])
                 for (a, b), k in zip(sheet["edges_vertices"], sheet["edges_assignment"]) if k == letter)
    said = [row for row in rows if row and row[0].startswith(f"hinges, {kind}")]
    assert len(said) == 1 and abs(float(said[0][2].split()[0]) - length) <= 0.5, (said, length)
assert page.count("<svg") == 1 + 6 + 1 + 3 and "pilot" in page.lower()  # sheet, rows, assembled, folded
# Printed letters: a capital is 0.72 of a size, and at least 2.5 mm high in every picture and in the text.
sizes = {"wide": (184, 105), "half": (90, 75), "third": (59, 60)}  # of figures on A4 with margins of 12 mm
for kind, box, size in re.findall(r'<figure class="(\w+)"><svg viewBox="([^"]+)" font-size="([\d.]+)"', page):
    width, height = (float(n) for n in box.split()[2:])
    assert 0.72 * float(size) * min(sizes[kind][0] / width, sizes[kind][1] / height) > 2.5, (kind, box, size)
for size in re.findall(r"font(?:-size)?:([\d.]+)pt", page):
    assert 0.72 * float(size) * 25.4 / 72 > 2.5, size
assert "@page{size:A4" in page
for table in re.findall(r'<table class="beside">(.*?)</table>', page, re.S):
    assert table.count("<tr>") <= 25, "a table that a page divides"
# Hinges: the sharpest fold up to the angle of use, by normals of the folded panels.
def normal(at, face):
    u, v = ([at[face[k]][i] - at[face[0]][i] for i in range(3)] for k in (1, 2))
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    return [x / math.hypot(*n) for x in n]
def folds(at, letter):
    for edge, kind in zip(sheet["edges_vertices"], sheet["edges_assignment"]):
        if kind == letter:
            one, other = (normal(at, face) for face in sheet["faces_vertices"] if set(edge) <= set(face))
            yield edge, math.degrees(math.acos(max(-1, min(1, sum(x * y for x, y in zip(one, other))))))
used = [at for at in (frame["vertices_coords"] for frame in sheet["file_frames"])
        if dict((tuple(sorted(edge)), fold) for edge, fold in folds(at, "V"))[1, 8] < 120.5]  # of the pilot, A2-A9
assert len(used) >= 120, len(used)
for kind, letter in (("mountain", "M"), ("valley", "V")):
    largest = max(fold for at in used for _, fold in folds(at, letter))
    (said,) = [row for row in rows if row and row[0] == kind]
    assert abs(float(said[1].rstrip("°")) - largest) < 0.06, (said, largest)
    assert abs(float(said[2].split()[0]) - math.tan(math.radians(largest / 2))) < 0.02, (said, largest)
# Hinges on faces would not meet, round the whole vertex of one valley or one mountain by as much as that turns at least.
def odd_creases():
    for v in range(len(coordinates)):
        at = [(edge, kind) for edge, kind in zip(sheet["edges_vertices"], sheet["edges_assignment"]) if v in edge and kind in "MV"]
        yield from (edge for edge, kind in at if len(at) == 4 and sum(other == kind for _, other in at) == 1)
odd_ones = list(odd_creases())
odd = max(2 * math.sin(math.radians(fold / 2)) for at in used for letter in "MV" for edge, fold in folds(at, letter)
          if edge in odd_ones)
(missed,) = re.findall(r"would leave a gap of ([\d.]+) mm per mm of thickness round", page)
assert float(missed) > odd - 0.006, (missed, odd)
assert "butted" not in page and "looks up" not in page
END

# It has the colours of the report's page; so has a guide with a warning.
for guide in guide/table1-kit.html unreached/dome-6x6-kit.html; do
  "$python" -B "$source_dir/tests/system/card_page.py" "$source_dir/schema/report/page.css" $guide || fail "colours of $guide"
done

# Layers in the order of the machine, in colours of LightBurn's palette.
"$python" -B - guide/table1-kit.svg << 'END' || fail "layers of a kit"
import re, sys
with open(sys.argv[1], encoding="utf8") as file:
    groups = re.findall(r'<g id="(\w+)"[^>]*stroke="(#\w+)"', file.read())
assert groups == [("registration", "#00e0e0"), ("engrave", "#00e000"), ("score_mountain", "#ff0000"),
                  ("score_valley", "#0000ff"), ("opening", "#ff8000"), ("cut", "#000000")], groups
END
# What to cut first: squares with half the kerf round them, bores on their diagonals; a tab's bore on the corner, a disc
# round it, and the square above cut clear of the disc.
for crease in score cut dash; do
  "$program" export "$patterns/table1.json" --format dxf --kit --kerf 0.2 $bores --crease $crease --test-piece \
    --output first-$crease > names || fail "--test-piece"
  grep -qx first-$crease/table1-kit-test.dxf names || fail "--test-piece writes $(cat names)"
  "$python" - first-$crease/table1-kit-test.dxf $crease << 'END' || fail "the test piece, $crease"
import math, sys
import ezdxf
drawing, crease = ezdxf.readfile(sys.argv[1]).modelspace(), sys.argv[2]
cuts = [[(p[0], p[1]) for p in line.get_points()] for line in drawing.query('LWPOLYLINE[layer=="CUT"]')]
bores = [(c.dxf.center.x, c.dxf.center.y, c.dxf.radius) for c in drawing.query('CIRCLE[layer=="BORE"]')]
box = lambda ring: [f(p[k] for p in ring) for f in (min, max) for k in (0, 1)]
parts = sorted(cuts, key=lambda ring: box(ring)[1])
assert len(parts) == (3 if crease == "cut" else 2), len(parts)
lower, upper, third = parts[0], parts[-2], parts[-1]
b, t = box(lower), box(third)
assert abs(t[2] - t[0] - 30.2) < 1e-6 and abs(t[3] - t[1] - 30.2) < 1e-6 and len(third) == 4, t
# From the right side of the lower square: its lower left corner, and the tab's middle.
x, y = b[2] - 30.1, b[1] + 30.1
(tab,) = [c for c in bores if math.dist(c[:2], (x, y)) < 1e-6]
assert abs(tab[2] - 0.65) < 1e-9  # 1.5 mm less the kerf
disc = [p for p in lower if math.dist(p, (x, y)) < 3.5]
assert len(disc) > 20 and all(2.75 <= math.dist(p, (x, y)) + 0.01 and math.dist(p, (x, y)) < 2.86 for p in disc
                              if p[0] < x or p[1] > y + 0.1), "a disc of 1.5 / 2 + 2 mm, and half the kerf"
corner = (box(upper)[2] - 0.1, box(upper)[3] - 0.1)
at = (corner[0] - 30, corner[1] - 30)  # the upper square's lower left corner, cut clear
clear = [p for p in upper if 3.6 < math.dist(p, at) < 4.2 and p[0] > at[0] + 0.1 and p[1] > at[1] + 0.2]
assert len(clear) > 10 and all(abs(math.dist(p, at) - 3.85) < 0.01 for p in clear), "clear by 2.75 + 1 + kerf, less half"
joint = sorted(c for c in bores if c != tab)
assert len(joint) == 2 and all(abs(c[2] - 0.5) < 1e-9 for c in joint), joint
for (u, v, _), (p, q), way in zip(joint, (corner, (t[0] + 0.1, t[1] + 0.1)), (-1, 1)):
    assert abs(u - p - way * 2.6) < 1e-6 and abs(v - q - way * 2.6) < 1e-6, (u, v, p, q)
lines = drawing.query('*[layer=="SCORE_VALLEY"]') or drawing.query('*[layer=="DASH_VALLEY"]')
assert bool(lines) == (crease != "cut")
END
done

# One sentence, exit code 2, and no file, for what cannot be cut.
while IFS='|' read -r words meant; do
  # shellcheck disable=SC2086
  "$program" export "$patterns/table1.json" $words --output refused > out 2> err
  [ $? = 2 ] && [ "$(wc -l < err)" = 1 ] && [ ! -s out ] || fail "$words: $(cat err)"
  grep -q -- "$meant" err || fail "no '$meant' for: $words: $(cat err)"
done << 'END'
--format obj --kit|--kit has no meaning without --format svg, dxf, stl or 3mf
--format svg --kerf 0.2|--kerf has no meaning without --kit
--format dxf --kit --dash-mm 3,1|--dash-mm has no meaning without --crease dash
--format dxf --kit --bore-edge 3|--bore-edge has no meaning without --joint-bore or --spring-bore
--format dxf --kit --crease dash --dash-mm 0.1,1 --kerf 0.2|no longer than the kerf
--format dxf --kit --kerf 90 --gap 100|too wide for the contours
--format dxf --kit --kerf 1 --gap 0.5|less than the kerf
--format dxf --kit --joint-bore 0.2 --kerf 0.2|no larger than the kerf
--format dxf --kit --joint-bore 40 --spring-bore 30|would fit
--format dxf --kit --joint-bore 40 --spring-bore 30 --spring-at panel|would fit
--format dxf --kit --spring-bore 80|no room for a tab at A
--format dxf --kit --spring-bore 1 --bore-edge 0|nothing would be left of a tab
--format dxf --kit --spring-bore 1 --spring-at edge|'edge' is none of vertex, panel
--format dxf --kit --spring-at vertex|--spring-at has no meaning without --spring-bore
--format dxf --kit --joint-bore 1 --spring-at panel|--spring-at has no meaning without --spring-bore
--format dxf --spring-at panel|has no meaning without
--format dxf --kit --bed 130x130|does not fit, turned or not
--format dxf --kit --bed 40x30|does not fit, turned or not
--format dxf --grain|--grain has no meaning without --kit
--format dxf --kit --units cm|'cm' is none of mm, in
--format dxf --hinge tape|--hinge has no meaning without --kit
--format dxf --thickness 2|--thickness has no meaning without --format stl, mjcf or inp, or --kit
--format dxf --kit --bed 600|is no width and height in mm
--format dxf --guide|--guide has no meaning without --kit
--format dxf --test-piece|--test-piece has no meaning without --kit
--format dxf --kit --guide --from 175|lies beyond D
--format dxf --kit --crease fold|'fold' is none of cut, score, dash
END
[ -e refused ] && [ -n "$(ls refused)" ] && fail "a refused kit leaves files: $(ls refused)"
finish
