#!/bin/sh
# man_pages.sh PROGRAM HELP2MAN VERSION DATE COMMON FOLDER: misalign.1 and misalign-VERB.1 into FOLDER,
# from what --help says. DATE as 2026-11-21; COMMON holds the sections that all pages have.
set -eu
program=$1 help2man=$2 version=$3 date=$4 common=$5 folder=$6
mkdir -p "$folder"
export LC_ALL=C
PATH=$(dirname "$program"):$PATH  # help2man takes its first argument to pieces at blanks

# "VERB description", one a line.
verbs=$("$program" --help | awk '
  /^[A-Z]/ { within = $0 == "Verbs:" }
  within && /^  [a-z]/ { if (line) print line; sub(/^ */, ""); line = $0; next }
  within && /^    / { sub(/^ */, ""); line = line " " $0 }
  END { if (line) print line }' | tr -s ' ')

# page NAME DESCRIPTION SEE-ALSO [VERB]
page() {
  also=$folder/.$1.h2m
  printf '[SEE ALSO]\n%s\n' "$3" > "$also"
  # help2man takes a verb for an argument of the program, and runs the lines of examples together.
  "$help2man" --no-info --manual=misalign --source="misalign $version" \
    --version-string="$version" --name="$2" --include="$common" --include="$also" \
    "$(basename "$program")${4:+ $4}" > "$folder/$1.raw"
  sed -e "s/^\.TH [^ ]* \"1\" \"[^\"]*\"/.TH $(echo "$1" | tr a-z- A-Z-) \"1\" \"$date\"/" \
    -e "/^\.SH NAME/{n;s/.* \\\\- /$(echo "$1" | sed 's/-/\\\\-/g') \\\\- /;}" \
    -e "/^\.B misalign\$/{N;s/\n\\\\fI\\\\,${4:-VERB} \\\\\/\\\\fR/${4:+ $4}\\n/;}" \
    -e '/^\.SH EXAMPLES/,$s/^\.IP$/.nf/' -e 's/^\.SH "SEE ALSO"/.fi\n&/' \
    "$folder/$1.raw" > "$folder/$1.1.part"
  mv "$folder/$1.1.part" "$folder/$1.1"
  rm "$also" "$folder/$1.raw"
}

all=
while read -r verb description; do
  all="$all${all:+,
}.BR misalign-$verb (1)"
  page "misalign-$verb" "$description" '.BR misalign (1)' "$verb"
done << END
$verbs
END
page misalign "find origami that simple springs deploy" "$all,
.BR mpirun (1),
.BR sqlite3 (1)"
