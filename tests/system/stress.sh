# Elastic panels by CalculiX: a 4 x 4 sheet of stiff panels goes flat, one of the paper's for its first steps.
. "$(dirname "$0")/lib.sh"

table1=$source_dir/search/patterns/table1.json
# shellcheck disable=SC2123
(PATH=/nowhere; "$program" stress "$table1" --output none > out 2> err
 echo $? > code)
[ "$(cat code)" = 1 ] || fail "without ccx: exit code $(cat code)"
grep -q "there is no ccx in PATH" err || fail "without ccx: $(cat err)"
[ -e none ] && fail "without ccx a directory was made"
"$program" stress "$table1" --from 157 --output none > out 2> err
[ $? = 2 ] && grep -q "fold limit at 156.34" err || fail "beyond the fold limit: $(cat err)"
"$program" stress "$table1" --rest-deg 157 --output none > out 2> err
[ $? = 2 ] && grep -q -e "--rest-deg 157: table1 has its fold limit at 156.34" err || fail "rest beyond the fold limit: $(cat err)"
cp "$table1" table1.dat
if command -v ccx > /dev/null; then
  "$program" stress table1.dat --output . > out 2> err
  [ $? = 2 ] && cmp -s "$table1" table1.dat || fail "a file that is read would be replaced: $(cat err)"
fi
if ! command -v ccx > /dev/null; then
  echo "SKIPPED: ccx (calculix-ccx) is not installed"
  finish
fi

"$program" search "$source_dir/search/campaigns/miura-4x4.json" --range 1112:1113 --catalogue a.db \
  --progress none > /dev/null || fail "search"
echo '{ "name": "stiff", "e_gpa": 7000 }' > stiff.json
"$program" stress a.db 1112 --from 6 --stiffness 5000 --material stiff.json --time-step 4e-3 --time-limit 0.2 \
  --output run > out || fail "stress"
result=run/miura-4x4-1112-stress.json
[ "$(tail -1 out)" = "$PWD/$result" ] || fail "the result's name: $(tail -1 out)"
holds() { [ "$(sqlite3 :memory: "SELECT $2 FROM (SELECT readfile('$result') AS j)")" = 1 ] || fail "$1"; }
holds "deployed" "j ->> 'outcome' = 'deployed' AND j ->> 'draw' = 1112 AND j ->> '\$.motion.widest_deg[#-1]' < 5"
grep -q "^deployed: every crease within 5 deg after" out || fail "the text: $(cat out)"
holds "energy only goes away" "j ->> '\$.motion.springs_n_mm[#-1]' + j ->> '\$.motion.bending_n_mm[#-1]' +
  j ->> '\$.motion.kinetic_n_mm[#-1]' < j ->> '\$.motion.springs_n_mm[0]' + j ->> '\$.motion.bending_n_mm[0]' +
  j ->> '\$.motion.kinetic_n_mm[0]'"
holds "stresses" "j ->> '\$.largest_outside_discs.stress_mpa' > 0.1 AND json_array_length(j, '\$.panels') = 14 AND
  j ->> '\$.largest_anywhere_mesh_dependent.stress_mpa' >= j ->> '\$.largest_outside_discs.stress_mpa' AND
  j ->> '\$.largest_outside_discs.stress_mpa' = (SELECT max(value ->> 'outside_discs_mpa') FROM json_each(j, '\$.panels'))"

# Springs relaxed on the way: there it comes to rest, if something damps.
echo '{ "e_gpa": 700000 }' > rigid.json
"$program" stress a.db 1112 --from 25 --rest-deg 30 --stiffness 5000 --material rigid.json --damping 150 \
  --time-step 8e-3 --time-limit 0.1 --output run > out || fail "stress with a stop"
holds "comes to rest" "j ->> 'outcome' = 'time_limit' AND j ->> 'rest_deg' = 30 AND j ->> 'damping_per_s' = 150 AND
  abs((j ->> '\$.motion.pilot_deg[#-1]') - 30) < 0.1 AND j ->> '\$.motion.kinetic_n_mm[#-1]' < 1e-3"
grep -q "^springs are relaxed at 30 deg: after 0.1000 s the pilot is at 30.0" out || fail "the text of a stop: $(cat out)"
finish
