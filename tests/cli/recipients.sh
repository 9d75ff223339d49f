#!/usr/bin/env bash
# What becomes of a delivery with those who get it: what their systems leave in its folders, and the
# shells and settings under which its script runs.
source "$(dirname "$0")/common.bash"
write_flat_show fall.yaml 32 1
exits 0 "$DOMEFALL" render fall.yaml --out made
exits 0 "$DOMEFALL" deliver fall.yaml --from made --out sent

# ---- what systems leave behind is told apart, and is no fault ----
cp -r sent got
for file in Thumbs.db frames/THUMBS.DB desktop.ini frames/Desktop.ini $'Icon\r' $'Icon\xef\x80\x8d' .DS_Store \
  ._README.txt frames/._fall_00001.png .directory README.txt:Zone.Identifier; do
  echo >"got/$file"
done
for left in "\$RECYCLE.BIN" 'System Volume Information' .Trashes .Spotlight-V100 .fseventsd frames/@eaDir \
  lost+found '#recycle' __MACOSX .Trash-1000 FOUND.000; do
  mkdir -p "got/$left/deeper"
  echo >"got/$left/deeper/file"
  ln -s /nowhere "got/$left/link"
done
echo >"got/.hidden
name"
chmod 0 'got/System Volume Information' got/lost+found
exits 0 "$DOMEFALL" deliver --check got
grep -q '^got: complete, and as it was delivered$' stdout || fail "$(cat stdout)"
grep -qxF '  left by a system or a file manager, which is no fault: frames/@eaDir/' stdout || fail "$(cat stdout)"
grep -qxF '  left by a system or a file manager, which is no fault: Icon\r' stdout || fail "$(cat stdout)"
exits 0 sh got/verify.sh
for line in 'frames/THUMBS.DB' 'frames/@eaDir/' "\$RECYCLE.BIN/" '.DS_Store' 'Icon?' \
  'README.txt:Zone.Identifier'; do
  grep -qxF "left by a system or a file manager: $line" stdout || fail "not told: $line: $(cat stdout)"
done
[ "$(tail -n 1 stdout)" = "All $(wc -l <sent/checksums.sha256) files are there, and as they were delivered." ] ||
  fail "$(cat stdout)"
# The same command goes over it, and what is wrong besides is found.
exits 0 "$DOMEFALL" deliver fall.yaml --from made --out got
for stray in Thumbs.dbx icon frames/lost frames/recycle.bin; do
  echo >"got/$stray"
  exits 2 "$DOMEFALL" deliver --check got
  says "not of this delivery: $stray\$"
  exits 1 sh got/verify.sh
  grep -qxF "not of this delivery: $stray" stdout || fail "$(cat stdout)"
  rm "got/$stray"
done
rm got/frames/fall_00002.png
exits 2 "$DOMEFALL" deliver --check got
exits 1 sh got/verify.sh
grep -qxF 'missing: frames/fall_00002.png' stdout || fail "$(cat stdout)"
chmod 755 'got/System Volume Information' got/lost+found
ffmpeg -v error -f lavfi -i anullsrc=r=48000:cl=stereo -t 0.1 -f wav Thumbs.db
exits 2 "$DOMEFALL" deliver fall.yaml --from made --out d --audio Thumbs.db
says 'nor the name of what systems leave in folders'

# ---- what is no file is not waited for ----
for kind in pipe device folder link 'link to a device'; do
  rm -rf got
  cp -r sent got
  frame=got/frames/fall_00002.png
  rm $frame
  case $kind in
    pipe) mkfifo $frame ;;
    device) mknod $frame c 1 5 2>/dev/null || ln -s /dev/zero $frame ;;
    folder) mkdir $frame ;;
    link) ln -s ../../sent/frames/fall_00002.png $frame ;;
    *) ln -s /dev/zero $frame ;;
  esac
  exits 2 timeout 60 "$DOMEFALL" deliver --check got
  says 'fall_00002.png is a|frames missing: 2$'
  exits 1 timeout 60 sh got/verify.sh
  grep -qE '^(no file|a link and no file): frames/fall_00002.png$' stdout || fail "$kind: $(cat stdout)"
done
rm -rf got
cp -r sent got
rm got/checksums.sha256
mkfifo got/checksums.sha256
exits 2 timeout 60 "$DOMEFALL" deliver --check got
exits 1 timeout 60 sh got/verify.sh
# A delivery is not written through a link.
rm -rf got
cp -r sent got
mv got/README.txt elsewhere
ln -s ../elsewhere got/README.txt
exits 2 "$DOMEFALL" deliver fall.yaml --from made --out got
says '^got/README.txt: is a link, and a delivery holds files$'

# ---- the script reads its own folder, by whatever shell and name it is begun ----
rm -rf got
mkdir -p other/got
cp -r sent/. other/got
cp -r sent got
printf x | dd of=got/frames/fall_00003.png bs=1 seek=90 conv=notrunc status=none
shells=(sh)
for shell in dash bash 'bash --posix' 'busybox sh' ksh mksh yash zsh; do
  ! command -v "${shell%% *}" >/dev/null || shells+=("$shell")
done
for shell in "${shells[@]}"; do
  read -ra shell <<<"$shell"
  for setting in CDPATH="$PWD/other" POSIXLY_CORRECT=1 GREP_OPTIONS=-v LC_ALL=nowhere IFS=/; do
    exits 1 env "$setting" "${shell[@]}" got/verify.sh
    grep -qx 'changed: frames/fall_00003.png' stdout || fail "${shell[*]}, $setting: $(cat stdout stderr)"
    exits 0 env "$setting" "${shell[@]}" other/got/verify.sh
  done
  for name in - -x '-P x' 'a b' $'a\nb' $'a\n' 'a\b' '*' '~'; do
    mkdir -p "named/$name"
    cp -r got/. "named/$name"
    exits 1 "${shell[@]}" "$PWD/named/$name/verify.sh"
    exits 1 sh -c 'cd named && exec "$@"' - "${shell[@]}" "./$name/verify.sh"
    exits 1 env OLDPWD="$PWD/sent" sh -c 'cd named && OLDPWD=../sent exec "$@"' - "${shell[@]}" -- "$name/verify.sh"
    # shellcheck disable=SC2016 # expanded by the inner shell
    exits 1 sh -c 'cd "named/$1" && shift && exec "$@"' - "$name" "${shell[@]}" verify.sh
    rm -r named
  done
done
# With shasum where there is no sha256sum.
if command -v shasum perl >/dev/null; then
  mkdir bin
  for program in sh find sed awk grep tr cat shasum perl printf; do
    ln -s "$(command -v "$program")" bin
  done
  exits 1 env PATH="$PWD/bin" sh got/verify.sh
  grep -qx 'changed: frames/fall_00003.png' stdout || fail "$(cat stdout stderr)"
  exits 0 env PATH="$PWD/bin" sh sent/verify.sh
fi
# A list that leads out of the folder is none.
sed -i '2s|  .*|  ../sent/README.txt|' got/checksums.sha256
exits 1 sh got/verify.sh
grep -q '^not of this folder: ../sent/README.txt$' stdout || fail "$(cat stdout)"

# Whoever may read the files may run the script.
for mask in 022 027 077; do
  (
    umask $mask
    exits 0 "$DOMEFALL" deliver fall.yaml --from made --out "by_$mask"
  )
done
modes() { stat -c %a "$1/README.txt" "$1/verify.sh" | paste -sd' '; }
[ "$(modes by_022) $(modes by_027) $(modes by_077)" = "644 755 640 750 600 700" ] ||
  fail "$(modes by_022) $(modes by_027) $(modes by_077)"
