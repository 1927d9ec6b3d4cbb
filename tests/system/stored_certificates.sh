# Certificates that a catalogue keeps: filtered and sorted by, exported and checked without it, joined,
# and found where they were changed.
. "$(dirname "$0")/lib.sh"
search() {  # FILE DRAWS: a catalogue of the 4 x 4 sheet
  "$program" search "$source_dir/search/campaigns/miura-4x4.json" --draws "$2" --catalogue "$1" --progress none \
    > /dev/null 2>&1 || fail "search $1"
}
digest() { "$program" status "$1" 2> /dev/null | sed -n 's/^digest *//p'; }

search a.db 120
before=$(digest a.db)
"$program" certify a.db --all > /dev/null 2>&1 || fail "certify --all"
[ -n "$before" ] && [ "$(digest a.db)" = "$before" ] || fail "certificates are part of the digest"
count=$(sql a.db 'SELECT count(*) FROM candidate')
[ "$count" -gt 20 ] && [ "$(sql a.db 'SELECT count(*) FROM certificate')" = "$count" ] || fail "certificates of a.db"

# By what they say candidates are chosen.
"$program" query a.db "SELECT draw FROM candidates WHERE certified_deg >= 160 ORDER BY draw" --csv | tail -n +2 > far
sql a.db "SELECT draw FROM certificate WHERE certified_deg >= 160 ORDER BY draw" | cmp -s - far || fail "certified_deg >= 160"
[ -s far ] || fail "none is certified up to 160 degrees"
"$program" export a.db --where "certified_deg < deploys_from_deg" --best 1 --by certified_deg --output out > names ||
  fail "export --by certified_deg"
file=$(cat names)
draw=$(field "$file" draw)
[ "$draw" = "$(sql a.db "SELECT draw FROM candidates WHERE certified_deg < deploys_from_deg ORDER BY certified_deg DESC LIMIT 1")" ] ||
  fail "export --by certified_deg: another draw"

# An export carries it whole, and is checked by itself; a FOLD file has none.
for pair in certified_deg=certified_deg asked_deg=asked_deg end=ended where=place contact=contact intervals=intervals hash=hash; do
  [ "$(field "$file" "certificate.${pair%=*}")" = "$(sql a.db "SELECT ${pair#*=} FROM certificate WHERE draw = $draw")" ] ||
    fail "the exported certificate: ${pair%=*}"
done
field "$file" certificate.proof | base64 -d > proof || fail "the exported proof"
[ "$(od -An -v -tx1 proof | tr -d ' \n')" = "$(sql a.db "SELECT lower(hex(proof)) FROM certificate WHERE draw = $draw")" ] ||
  fail "the exported proof is another one"
"$program" certify "$file" --check > /dev/null 2>&1 || fail "certify --check of the export"
"$program" export a.db --draw "$draw" --format fold --output out > /dev/null || fail "export fold"
grep -q '"certificate"' "out/miura-4x4-$draw.fold" && fail "a FOLD file with a certificate"
sed "s/\"intervals\": /&1/" "$file" > changed.json
cmp -s "$file" changed.json && fail "nothing was changed"
"$program" certify changed.json --check > /dev/null 2>&1
[ $? = 6 ] || fail "certify --check of an export that was changed"

# What was changed in the file is found, not exported, and not taken over.
cp a.db spoilt.db
sqlite3 spoilt.db "UPDATE certificate SET certified_deg = certified_deg + 0.001 WHERE draw = $draw"
"$program" verify a.db --sample 1 > out.txt || fail "verify a.db"
grep -q "^certificates $count of $count " out.txt || fail "verify a.db: $(cat out.txt)"
"$program" verify spoilt.db --sample 1 > out.txt
[ $? = 6 ] || fail "verify of a changed certificate"
grep -q "^draw $draw: its certificate is not as it was made" out.txt || fail "verify: $(cat out.txt)"
"$program" export spoilt.db --draw "$draw" --output nothing > /dev/null 2> err
[ $? = 3 ] && grep -q "the certificate of draw $draw is not as it was made" err || fail "export of a changed one: $(cat err)"
[ -e "nothing/miura-4x4-$draw.json" ] && fail "a changed certificate is exported"
"$program" merge joined.db spoilt.db > /dev/null 2> err || fail "merge of a changed one: $(cat err)"
grep -q "1 certificate not taken over" err || fail "merge says nothing: $(cat err)"
[ "$(sql joined.db 'SELECT count(*) FROM certificate')" = $((count - 1)) ] || fail "certificates of joined.db"

# Joined with who has certified nothing.
search b.db 200
"$program" merge all.db b.db a.db > /dev/null 2> err || fail "merge: $(cat err)"
[ -s err ] && fail "merge complains: $(cat err)"
[ "$(digest all.db)" = "$(digest b.db)" ] || fail "the digest of what was joined"
sql a.db "SELECT * FROM certificate ORDER BY draw" > of_a
sql all.db "SELECT * FROM certificate ORDER BY draw" | cmp -s - of_a || fail "certificates that were taken over"
finish
