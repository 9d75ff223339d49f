#!/usr/bin/env bash
# The variables, the language, the umask and the home of whoever begins a run have no say in what it
# makes, and what is not obeyed is told.
source "$(dirname "$0")/common.bash"
cat >fall.yaml <<'END'
title: A short fall
frames_per_second: 12
size: 96
black_hole: {mass_solar: 4.3e6}
sky: {region_I: {stars: naked_eye}}
titles: [{text: "Istanbul I i 1.5 شروع", at_s: 0, duration_s: 0.25}]
timeline: [{duration_s: 0.25, trajectory: {type: infall, from_r: 6.5, to_r: 2.5}}]
END
exits 0 "$DOMEFALL" render fall.yaml --out plain
# all_of WORD...: what these say and make, by COMMAND that begins each.
all_of() {
  local name=$1
  shift
  exits 0 "$@" "$DOMEFALL" render fall.yaml --out "$name"
  cp stderr "$name.talk"
  same_frames plain/graded "$name/graded"
  same_frames plain/linear "$name/linear"
  exits 0 "$@" "$DOMEFALL" states fall.yaml
  cp stdout "$name.states"
  exits 0 "$@" "$DOMEFALL" probe fall.yaml --frame 1 --pixel 48,20
  cat stdout >>"$name.states"
  [ "$name" = plain ] || cmp plain.states "$name.states"
}
all_of plain env
all_of none env -i
all_of set env OCIO=/nowhere/config.ocio OCIO_ACTIVE_DISPLAYS=x OCIO_ACTIVE_VIEWS=x OCIO_INACTIVE_COLORSPACES=x \
  OCIO_OPTIMIZATION_FLAGS=0 OPENIMAGEIO_OPTIONS=try_all_readers=0 OPENIMAGEIO_THREADS=1 TBB_VERSION=1 \
  FONTCONFIG_FILE=/nowhere PANGOCAIRO_BACKEND=x TZ=Asia/Kathmandu COLUMNS=1 LINES=1 NO_COLOR=1 TERM=dumb \
  POSIXLY_CORRECT=1 HOME=/nowhere XDG_CACHE_HOME=/nowhere XDG_CONFIG_HOME=/nowhere LANGUAGE=de PWD=/nowhere \
  SLURM_JOB_ID=4242 SLURM_CPUS_PER_TASK=1 SLURM_ARRAY_TASK_ID=2 OMP_NUM_THREADS=1

# Numbers with a comma, and letters whose capitals are others.
if [ -e /usr/share/i18n/locales/tr_TR ] && command -v localedef >/dev/null; then
  mkdir locales
  for language in de_DE tr_TR; do
    localedef -i $language -f UTF-8 "locales/$language.UTF-8" 2>/dev/null || continue
    [ "$(LOCPATH=$folder/locales LC_ALL=$language.UTF-8 locale decimal_point)" = , ] || fail "no $language"
    all_of $language env LOCPATH="$folder/locales" LC_ALL=$language.UTF-8 LANG=$language.UTF-8
  done
fi

# OCIO is told where the show leaves the configuration open, and in the manual.
[ "$(grep -c '^OCIO=/nowhere/config.ocio is not read; ' set.talk)" -eq 1 ] || fail "$(cat set.talk)"
exits 0 env OCIO=/nowhere/config.ocio "$DOMEFALL" check fall.yaml
grep -q '^ *OCIO=/nowhere/config.ocio is not read; grade: {config: FILE}' stdout || fail "$(cat stdout)"
exits 0 env OCIO=/nowhere/config.ocio "$DOMEFALL" check fall.yaml --json
python3 -m json.tool <stdout >/dev/null || fail "the note is among the JSON"
exits 0 "$DOMEFALL" --help
grep -A 2 '^ *OCIO' stdout | grep -q 'Is not read' || fail "the manual says nothing of OCIO"
cp "$DOMEFALL_SOURCE"/shows/assets/dome.ocio own.ocio
for show in 'grade: {config: own.ocio}' 'output: {graded: none}'; do
  sed "\$a $show" fall.yaml >own.yaml
  exits 0 env OCIO=/nowhere/config.ocio "$DOMEFALL" render own.yaml --out own --frames 0 --replace
  ! grep -q OCIO stderr || fail "$show: $(cat stderr)"
done
exits 0 env OCIO= "$DOMEFALL" check fall.yaml
! grep -q OCIO stdout || fail "$(cat stdout)"

# Files and folders are as the umask says.
for mask in 002 027 077; do
  (
    umask $mask
    exits 0 "$DOMEFALL" render fall.yaml --out "by_$mask"
    exits 0 "$DOMEFALL" farm submit fall.yaml --engine local --workers 1 --out "by_$mask"
    exits 0 "$DOMEFALL" states fall.yaml --plot "by_$mask/plot.svg"
    exits 0 "$DOMEFALL" movie fall.yaml --preset review --from "by_$mask" --out "by_$mask/fall.mp4"
  )
  wanted=$(printf '%o %o' $((0777 & ~0$mask)) $((0666 & ~0$mask)))
  [ "$(find "by_$mask" -type d -printf '%m\n' | sort -u) $(find "by_$mask" -type f -printf '%m\n' | sort -u)" = "$wanted" ] ||
    fail "umask $mask: $(find "by_$mask" -printf '%m %p\n')"
done

# A farm's processes begin without standard streams, too.
for streams in '<&-' '>&-' '2>&-' '<&- >&- 2>&-'; do
  exits 0 bash -c "'$DOMEFALL' farm submit fall.yaml --engine local --workers 2 --chunk 1 --out closed $streams"
  same_frames plain/linear closed/linear
  rm -r closed
done
