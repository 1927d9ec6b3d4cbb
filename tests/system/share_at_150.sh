# The share of interior draws that deploy from 150 degrees on 6 x 6: 4.3 % by two other programs, over
# 10,000 draws. Standard error over 5,000 draws: sqrt(0.043 * 0.957 / 5000) = 0.29 %; three of them and
# the two errors together, sqrt(0.29^2 + 0.20^2) = 0.35 %, stay within the 0.9 % allowed.
. "$(dirname "$0")/lib.sh"
sed 's/"deploys_from_deg": 170/"deploys_from_deg": 150/' "$source_dir/search/campaigns/miura-6x6.json" > from_150.json
"${ranks[@]}" 2 "$program" search from_150.json --catalogue share.db --draws 5000 \
  --progress none > out 2> err || { fail "search"; cat err; }
sound share.db 5000
[ "$(sql share.db 'SELECT sum(undecided) FROM unit')" = 0 ] || fail "undecided draws"
share=$(sql share.db 'SELECT count(*) / 5000.0 FROM candidate WHERE deploys_from_deg >= 150')
echo "share that deploys from 150 deg: $share (0.043 +- 0.009)"
[ "$(sql share.db "SELECT abs($share - 0.043) <= 0.009")" = 1 ] || fail "share $share"

# model.md: 0.9 % from 160 degrees; standard error sqrt(0.009 * 0.991 / 5000) = 0.13 %.
from_160=$(sql share.db 'SELECT count(*) / 5000.0 FROM candidate WHERE deploys_from_deg >= 160')
echo "share that deploys from 160 deg: $from_160 (0.009 +- 0.004)"
[ "$(sql share.db "SELECT abs($from_160 - 0.009) <= 0.004")" = 1 ] || fail "share $from_160 from 160"

# Every stored metric within its bounds, and the exact sample as large as it must be.
[ "$(sql share.db 'SELECT count(*) FROM fault_sample')" = 5 ] || fail "fault_sample"
[ "$(sql share.db 'SELECT max(isometry_error_mm) <= 1e-9 FROM candidate')" = 1 ] || fail "isometry"
[ "$(sql share.db 'SELECT max(residual_max) <= 1e-12 FROM candidate')" = 1 ] || fail "residual"
finish
