#!/bin/sh
# make_manual.sh PROGRAM FOLDER: writes the manual pages of the program and its verbs into the folder, by
# help2man out of --help.
set -eu
program=$1 folder=$2
version=$("$program" --version)

# page VERB...: the page of the verb, and those of the verbs below it.
page() {
  help=$("$program" "$@" --help)
  name=$(echo domefall "$@" | tr ' ' '-')
  help2man --no-info --locale=C --manual="Domefall Manual" --source="$version" \
    --version-string="$version" --name="$(echo "$help" | head -n 1)" \
    --include="$(dirname "$0")/sections.h2m" "$program $*" |
    sed "s/^domefall \\\\- /$name \\\\- /" >"$folder/$name.1"
  [ -s "$folder/$name.1" ]
  for verb in $(echo "$help" | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
    page "$@" "$verb"
  done
}
rm -rf "$folder"
mkdir -p "$folder"
page
