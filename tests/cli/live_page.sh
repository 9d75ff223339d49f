#!/usr/bin/env bash
# domefall preview: its page in a real browser, driven as a user drives it (live_page.py).
source "$(dirname "$0")/common.bash"
write_show "$folder/fall.yaml"
# Debian's own Python, which knows Debian's selenium.
code=0
/usr/bin/python3 "$here/live_page.py" "$DOMEFALL" "$folder/fall.yaml" || code=$?
exit "$code"  # 77 where no browser can be started, in a container without its own processes
