#!/usr/bin/env bash
# What the system may refuse to whoever writes a file, one refusal at a time: what can be another way on another
# machine or a minute later is 75, what can never be is 2, and what can be done without does not matter. The old
# file stays, and nothing else.
source "$(dirname "$0")/common.bash"
refusing=$here/refuse_calls.py
export LC_ALL=C
write_grid_show tiny.yaml
exits 0 "$DOMEFALL" stars import csv "$DOMEFALL_SOURCE/shows/assets/stars_to_8.csv" --faintest 6 --out few.stars
plot=("$DOMEFALL" states tiny.yaml --frames 0 --plot)
stars=("$DOMEFALL" stars import csv "$DOMEFALL_SOURCE/shows/assets/stars_to_8.csv" --faintest 5 --out)
build=("$DOMEFALL" sky build --stars few.stars --fainter-than 5 --blur 4 --size 32 --out)
still=("$DOMEFALL" preview tiny.yaml --size 64x36 --out)
# An error's name leads to what the system says of it.
declare -A words
while IFS=$'\t' read -r name text; do words[$name]=$text; done < <(
  python3 -c 'import errno, os; [print(n, os.strerror(e), sep="\t") for e, n in errno.errorcode.items()]')
words[EOPNOTSUPP]=${words[ENOTSUP]}  # the same number
nothing_else() { [ -z "$(find . -name '.*.tmp')" ] || fail "left: $(find . -name '.*.tmp')"; }
count=0

# refused CODE CALL "ERRNO..." FILE COMMAND...: the command, which writes FILE, ends with this code.
refused() {
  local code=$1 call=$2 errors=$3 file=$4 error
  shift 4
  for error in $errors; do
    echo old >"$file"
    exits "$code" "$refusing" "$call" "$error" "$@"
    if [ "$code" -ne 0 ]; then
      says "^$file: ${words[$error]}\$"
      [ "$(cat "$file")" = old ] || fail "$call, $error: the old file is gone"
    elif [ "$(head -c 4 "$file")" = "old" ]; then
      fail "$call, $error: there is no new file"
    fi
    nothing_else
    count=$((count + 1))
  done
}

"$refusing" lock ENOLCK true 2>/dev/null || [ $? -ne 77 ] || { echo "no filter of system calls here"; exit 77; }
refused 75 create "ENOENT ENOTDIR EACCES EPERM EROFS ENOSPC EDQUOT EIO EMFILE ENFILE ENOMEM ESTALE ETIMEDOUT EBUSY" \
  plot.svg "${plot[@]}" plot.svg
refused 2 create "ENAMETOOLONG ELOOP EISDIR" plot.svg "${plot[@]}" plot.svg
refused 75 write "ENOSPC EDQUOT EIO EFBIG" plot.svg "${plot[@]}" plot.svg
refused 75 flush "EIO ENOSPC EDQUOT" plot.svg "${plot[@]}" plot.svg
refused 0 flush "EINVAL EOPNOTSUPP" plot.svg "${plot[@]}" plot.svg
refused 75 rename "EACCES EPERM EROFS ENOENT ESTALE EBUSY EXDEV" plot.svg "${plot[@]}" plot.svg
refused 2 rename "EISDIR" plot.svg "${plot[@]}" plot.svg
refused 0 lock "ENOLCK EOPNOTSUPP ENOSYS" plot.svg "${plot[@]}" plot.svg
for call in create write flush rename; do
  refused 75 $call EDQUOT many.stars "${stars[@]}" many.stars
  refused 75 $call EROFS still.png "${still[@]}" still.png
done
for call in create reserve map rename; do
  refused 75 $call "ENOSPC EDQUOT" light.sky "${build[@]}" light.sky
done
refused 0 reserve EOPNOTSUPP light.sky "${build[@]}" light.sky

# Frames, and folders.
for call in write flush rename; do
  for error in ENOSPC EACCES ESTALE; do
    exits 75 "$refusing" $call $error "$DOMEFALL" render tiny.yaml --frames 0-1 --out frames
    says "^frames/(linear|graded)/tiny_0000[01].*: ${words[$error]}\$"
    [ -z "$(find frames -type f)" ] || fail "$call, $error: left $(find frames -type f)"
    count=$((count + 1))
  done
done
for error in ENOSPC EDQUOT EROFS EACCES; do
  exits 75 "$refusing" folder $error "$DOMEFALL" report --quick --out report
  says ": ${words[$error]}\$"
  exits 0 "$refusing" folder $error "$DOMEFALL" check tiny.yaml
  count=$((count + 2))
done
echo "$count refusals"

# The same of real file systems, in a mount namespace of their own.
real() {
  mkdir small few locked frozen
  mount -t tmpfs -o size=64k none small
  mount -t tmpfs -o nr_inodes=2 none few
  touch few/the_last
  mount --bind locked locked
  mount -o remount,bind,ro locked
  exits 75 "${plot[@]}" small/plot.svg
  says '^small/plot.svg: No space left on device$'
  exits 75 "${plot[@]}" few/plot.svg
  says '^few/plot.svg: No space left on device$'
  exits 75 "$DOMEFALL" report --quick --out few/report
  says '^few/report: No space left on device$'
  exits 75 "${plot[@]}" locked/plot.svg
  says '^locked/plot.svg: Read-only file system$'
  if chattr +i frozen 2>stderr; then
    exits 75 "${plot[@]}" frozen/plot.svg
    says '^frozen/plot.svg: Operation not permitted$'
    chattr -i frozen
  fi
  [ "$(find small few locked frozen -type f)" = few/the_last ] || fail "left: $(find small few locked frozen)"
}
if unshare --mount true 2>stderr; then
  export -f real exits says fail
  export folder DOMEFALL
  # shellcheck disable=SC2016  # the inner shell expands
  unshare --mount bash -c 'set -euo pipefail; plot=("$DOMEFALL" states tiny.yaml --frames 0 --plot); real'
fi

# Another user, who may look and not write.
mkdir theirs
chmod 755 . theirs
as_nobody=()
[ "$(id -u)" -ne 0 ] || as_nobody=(setpriv --reuid 65534 --regid 65534 --clear-groups)
[ ${#as_nobody[@]} -gt 0 ] || chmod 555 theirs
if "${as_nobody[@]}" "$DOMEFALL" --version >/dev/null 2>&1; then
  exits 75 "${as_nobody[@]}" "${plot[@]}" theirs/plot.svg
  says '^theirs/plot.svg: Permission denied$'
fi
