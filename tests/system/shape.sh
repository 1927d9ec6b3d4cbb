# A sheet is shaped to its target: the file that is written is an ordinary one, rests at the shape by every verb, and its
# vertices lie on the target. Whoever asks for the impossible is told so.
. "$(dirname "$0")/lib.sh"
dome="$source_dir/search/patterns/dome-6x6.json"
"$program" shape "$dome" --output dome.json --json > shaped.json 2> err || fail "shape: $(cat err)"
"$program" export dome.json --format obj --output obj > out 2>&1 || fail "obj: $(cat out)"
# By coordinates alone: distances from the two spheres about the centre that fits best, found by ever smaller steps.
cat > off.py <<'PY'
import json, math
shaped = json.load(open("shaped.json"))
half = shaped["half_depth_mm"]
lines = [line.split() for line in open("obj/dome-090deg.obj")]
points = [[float(x) for x in words[1:4]] for words in lines if words and words[0] == "v"]
# Vertices of the rim, which cuts panels, lie between the levels; the others change levels from column to column.
inner = [(point, k % 7 % 2) for k, point in enumerate(points) if 0 < k % 7 < 6 and 0 < k // 7 < 6]
def off(centre, side):
    return sum((math.dist(p, centre) - 1440 - side * (half if odd else -half)) ** 2 for p, odd in inner) / len(inner)
def best(below, side):
    at, step = [sum(p[k] for p, _ in inner) / len(inner) for k in range(3)], 64.0
    at[2] += 1440 * below
    while step > 1e-6:
        trials = [[at[k] + (step * sign if k == axis else 0) for k in range(3)] for axis in range(3) for sign in (-1, 1)]
        better = min(trials, key=lambda trial: off(trial, side))
        if off(better, side) < off(at, side): at = better
        else: step /= 2
    return off(at, side)
print(f"{math.sqrt(min(best(below, side) for below in (-1, 1) for side in (-1, 1))):.6f}")
PY
rms=$(python3 off.py) || fail "off.py"
awk "BEGIN { exit !($rms < 0.03) }" || fail "inner vertices are off the spheres by $rms mm"
[ "$(field shaped.json wells.wells)" = 1 ] || fail "wells: $(field shaped.json wells)"
"$program" fold dome.json --json > folding.json 2> err || fail "fold: $(cat err)"
awk "BEGIN { exit !($(field folding.json verdict.deploys_from_deg) >= 107) }" || fail "D: $(field folding.json verdict)"
for from in 107 5; do
  "$program" deploy dome.json --from $from --damping 0.05 > out 2>&1 || fail "deploy from $from: $(cat out)"
  grep -Eq "comes to rest at (89.9|90.0|90 )" out || fail "from $from: $(cat out)"
done
"$program" report dome.json --output page.html > out 2>&1 || fail "report: $(cat out)"
"$program" card dome.json --no-remedies > out 2>&1
[ $? = 6 ] && grep -q "fails 1 of 7 requirements" out && grep -q "^FAIL  Spring clearance" out || fail "card: $(cat out)"

# The picture has a polygon for each part of the surface, each panel and each part of the bar of colours.
python3 -c 'import sys, xml.dom.minidom as xml; print(len(xml.parse("dome-shape.svg").getElementsByTagName("polygon")))' > out
[ "$(cat out)" = $((16 * 16 + 28 + 24)) ] || fail "the picture: $(cat out) polygons"

# Copies without errors stop where the sheet does, with its shape; friction holds them up to where slow motion stalls; with
# play they stop nearby.
"$program" tolerance dome.json --amplitude 1e-6 --trials 3 --json > stops.json 2> err || fail "stops: $(cat err)"
for key in rms max; do
  awk "BEGIN { off = $(field stops.json "stops.quantiles[3].shape_${key}_mm") / $(field shaped.json "${key}_mm");
    exit !(off > 0.99 && off < 1.01) }" || fail "$key: $(field stops.json stops.quantiles)"
done
"$program" tolerance dome.json --amplitude 1e-6 --trials 3 --friction 0.002 --json > held.json 2> err || fail "held: $(cat err)"
stalls=$("$program" deploy dome.json --friction 0.002 2> err | sed -n 's/^quasi-static motion would stall at \([0-9.]*\) deg/\1/p')
awk "BEGIN { off = $(field held.json stops.own.stops_at_deg) - ${stalls:-0}; exit !(off > -0.05 && off < 0.05) }" ||
  fail "stalls at $stalls: $(field held.json stops.own)"
awk "BEGIN { exit !($(field held.json stops.own.held_from_deg) < 89) }" || fail "held from: $(field held.json stops.own)"
"$program" tolerance dome.json --backlash 0.002 --trials 10 --json > loose.json 2> err || fail "play: $(cat err)"
awk "BEGIN { at = $(field loose.json 'stops.quantiles[3].stops_at_deg'); exit !(at > 85 && at < 95 && at != 90) }" ||
  fail "play: $(field loose.json stops)"

# Springs relaxed flat rest at the shape too.
"$program" shape "$dome" --target '{"surface": "saddle", "radius_mm": 1440}' --kind bistable --from 99 --barrier 2.5 \
  --output saddle.json > out 2>&1 || fail "bistable: $(cat out)"
grep -q "flat is a well, too" out || fail "bistable: $(cat out)"
"$program" deploy saddle.json --from 99 --damping 0.05 2> err | grep -Eq "comes to rest at (89.9|90.0|90 )" || fail "saddle"
"$program" shape "$dome" --kind energy --hold-rim --amplitude 12 > out 2>&1 || fail "energy, rim held: $(cat out)"
grep -q "shifts     up to" out || fail "energy: $(cat out)"

# A floor that is out of reach is named with what is missing, however cheap it is.
"$program" shape "$dome" --from 105 --subject-to "rest_stiffness_n_mm_per_rad >= 5000" > out 2>&1 || fail "stiff: $(cat out)"
grep -q "^not reached" out && grep -Eq "floor rest_stiffness.* violated by 4[.][0-9]+e[+]03 unit" out || fail "stiff: $(cat out)"

refuses() { # CODE WORDS ARGUMENTS...
  local code=$1 words=$2
  shift 2
  "$program" shape "$@" > out 2> err
  [ $? = "$code" ] && grep -q "$words" err && [ ! -e none.json ] || fail "shape $*: $(cat err)"
}
refuses 3 'has no "target"' "$source_dir/search/patterns/table1.json" --output none.json
refuses 3 "is no surface that is known" "$dome" --target '{"surface": "cube"}' --output none.json
refuses 2 "is stowed beyond" "$dome" --from 80 --output none.json
refuses 2 "is an upper bound" "$dome" --subject-to "stroke_max <= 0.1" --output none.json
refuses 2 "is a number of miscut copies" "$dome" --subject-to "yield >= 0.9" --output none.json
refuses 2 "has no value" "$dome" --subject-to "critical_friction_n_mm_per_mm >= 5" --output none.json
refuses 3 "is no file name" "$dome" --target '{"surface": "mesh", "file": ""}' --output none.json
refuses 2 "number that can be limited" "$dome" --subject-to "softness >= 1" --output none.json
finish
