# The manual as a site, and twenty tasks of strangers there, in a browser without a network. Called with a third
# argument: the directory of tests/report with its packages.
. "$(dirname "$0")/lib.sh"
web=$3
mkdir mine && touch mine/precious
"$source_dir/scripts/site.sh" "$(dirname "$program")" "$PWD/mine" > out 2> err
[ $? = 2 ] && [ -e mine/precious ] && grep -q 'no site that this script made' err || fail "a folder of somebody's: $(cat err)"
"$source_dir/scripts/site.sh" "$(dirname "$program")" "$work/site" || { fail "scripts/site.sh"; finish; }
[ -z "$(grep -lrE '(src|href)="https?://[^"]*\.(js|css|woff2?)' "$work/site/html")" ] || fail "pages that want a network"
node "$web/site_test.mjs" "$work/site/html" || fail "tasks of strangers"
finish
