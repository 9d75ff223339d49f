#!/usr/bin/env bash
# One reader of sound, one set of rules: what movie, deliver and farm submit (also with --dry-run) take and refuse, in
# the same words, before a frame is made.
source "$(dirname "$0")/common.bash"
command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null || exit 77

# 6 frames of 800 samples at 48 kHz.
cat >show.yaml <<'YAML'
title: Six frames
frames_per_second: 60
size: 64
sky: {region_I: {background: grid, stars: none}}
output: {linear: none, graded: png8}
timeline: [{duration_s: 0.1}]
YAML
exits 0 "$DOMEFALL" render show.yaml --out made

# write_wave.py FILE SAMPLES [KEY=VALUE...]: a tone of 16 bits and one channel, or as the keys say.
cat >write_wave.py <<'PY'
import math, struct, sys
keys = dict(k.split("=") for k in sys.argv[3:])
samples, channels, bits = int(sys.argv[2]), int(keys.get("channels", 1)), int(keys.get("bits", 16))
rate, kind = int(keys.get("rate", 48000)), keys.get("kind", "RIFF")
width = (bits + 7) // 8
def sample(k, c):
    value = 0.5 * math.sin(2 * math.pi * 300 * (c + 1) * k / rate)
    if keys.get("float"):
        return struct.pack("<f" if bits == 32 else "<d", value)
    if bits == 8:
        return bytes([128 + int(value * 128)])
    return int(value * (2 ** (8 * width - 1) - 1)).to_bytes(width, "little", signed=True)
data = b"".join(sample(k, c) for k in range(samples) for c in range(channels))
tag = 3 if keys.get("float") else 1
fmt = struct.pack("<HHIIHH", tag, channels, rate, rate * channels * width, channels * width, bits)
if keys.get("extensible"):
    fmt = struct.pack("<H", 0xfffe) + fmt[2:] + struct.pack("<HHI", 22, int(keys.get("valid", bits)), 0) + struct.pack("<H", tag) + \
        bytes.fromhex("000000001000800000aa00389b71")
chunk = lambda name, body: name + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)
size = int(keys.get("size", str(len(data))), 0)
body = (chunk(b"ds64", struct.pack("<QQQI", 0, len(data), samples, 0)) if kind != "RIFF" else b"") + \
    chunk(b"junk", b"odd") + chunk(b"fmt ", fmt) + b"data" + \
    struct.pack("<I", size if kind == "RIFF" else 0xffffffff) + data + b"\0" * (len(data) % 2)
if "cut" in keys:
    body = body[:-int(keys["cut"])]
riff = struct.pack("<I", len(body) + 4 if kind == "RIFF" and size == len(data) else 0xffffffff)
open(sys.argv[1], "wb").write(kind.encode() + riff + b"WAVE" + body)
PY
wave() { python3 write_wave.py "$@"; }

# by_each FILE...: what each verb says of the files, in one file a verb, and their codes in $codes.
by_each() {
  local code verb made
  codes=''
  rm -rf movie.mov delivered
  for verb in movie deliver farm; do
    code=0
    case $verb in
      movie) "$DOMEFALL" movie show.yaml --from made --preset master --out movie.mov --audio "$@" ;;
      deliver) "$DOMEFALL" deliver show.yaml --from made --out delivered --audio "$@" ;;
      farm) "$DOMEFALL" farm submit show.yaml --engine openjd --out farm --movie master --deliver sent --audio "$@" --dry-run ;;
    esac >"$verb.out" 2>"$verb.said" || code=$?
    codes+=" $code"
  done
}
taken() { # taken NOTE FILE...: each verb takes it, with this note and no other
  by_each "${@:2}"
  [ "$codes" = ' 0 0 0' ] || { cat ./*.said; fail "${*:2}: exit codes$codes"; }
  local verb made
  for verb in movie deliver farm; do
    if [ -z "$1" ]; then
      ! grep -E 'the sound|its head' $verb.said || fail "$verb: ${*:2}: a note"
    else
      [ "$(grep -cE -- "$1" $verb.said)" -eq 1 ] || { cat $verb.said; fail "$verb: ${*:2}: not once '$1'"; }
    fi
  done
}
refused() { # refused WORDS FILE...: each verb refuses it in these words, and nothing was made
  by_each "${@:2}"
  [ "$codes" = ' 2 2 2' ] || { cat ./*.said; fail "${*:2}: exit codes$codes"; }
  local verb made
  for verb in movie deliver farm; do
    grep -qF -- "$1" $verb.said || { cat $verb.said; fail "$verb: ${*:2}: no '$1'"; }
  done
  # ffmpeg tells addresses of its memory.
  diff <(sed "s/0x[0-9a-f]*//" movie.said) <(sed "s/0x[0-9a-f]*//" deliver.said) || fail "movie and deliver use other words"
  for made in movie.mov delivered farm sent; do
    [ ! -e $made ] || fail "${*:2}: $made was made"
  done
}
samples() { ffmpeg -v error -i "$1" -map 0:a:0 -af 'pan=mono|c0=c0' -c:a pcm_u8 -f u8 - | wc -c; }
peak() { ffmpeg -hide_banner -i "$1" -map 0:a:0 -af volumedetect -f null - 2>&1 | sed -n 's/.*max_volume: //p'; }

# Kinds of WAV.
for kind in bits=8 bits=24 bits=32 'bits=32 float=1' 'bits=64 float=1' 'bits=24 extensible=1' \
  'bits=32 extensible=1 valid=24' 'bits=32 extensible=1 valid=16' kind=RF64 kind=BW64 \
  'channels=16 bits=24'; do
  # shellcheck disable=SC2086 # several words
  wave kind.wav 4800 $kind
  taken '' kind.wav
  cmp -s kind.wav delivered/audio/kind.wav || fail "$kind: was delivered as another file"
  [ "$(peak movie.mov)" = '-6.0 dB' ] || fail "$kind: is as loud as $(peak movie.mov) in the movie"
done
wave strange.wav 4800 cut=100
refused 'strange.wav: no sound that can be used: it ends before its sound does' strange.wav
echo words >words.wav
refused 'words.wav: no sound that can be used: it is no WAV file, and ffprobe' words.wav
# A list of other files is no sound, whatever its name is.
printf 'ffconcat version 1.0\nfile kind.wav\n' >list.mp3
refused 'list.mp3: no sound that can be used: it is no WAV file, and ffprobe' list.mp3
refused 'none.wav: No such file or directory' none.wav

# Written into a pipe: the length was never filled in.  What is delivered says its length.
for size in 0 0xffffffff 0x7ffff000; do
  wave pipe.wav 4800 size=$size
  taken 'pipe.wav: its head does not say how long it is' pipe.wav
  [ "$(python3 -c "import wave; print(wave.open('delivered/audio/pipe.wav').getnframes())")" = 4800 ] ||
    fail "size $size: the delivered file does not say its length"
  [ "$(samples movie.mov)" = 4800 ] || fail "size $size: $(samples movie.mov) samples in the movie"
done

# Lengths: one frame longer is cut, with a note.  More is refused.
wave long.wav 5360
taken 'long.wav: the sound lasts 0.112 s, and the show 0.100 s .*; what is beyond the last frame is left out' long.wav
[ "$(samples movie.mov) $(samples delivered/audio/long.wav)" = '4800 4800' ] || fail "it was not cut"
wave longer.wav 5700
refused 'longer.wav: the sound lasts 0.119 s, and the show 0.100 s (6 frames at 60 a second)' longer.wav
wave short.wav 2400
taken 'short.wav: the sound lasts 0.050 s, .*; the rest is silent' short.wav
grep -q 'the rest is silent' delivered/README.txt || fail "README.txt says that the sound is as long as the frames"

# Other formats.  What an encoder pads is no sound that is too long.
wave exact.wav 4800
for packed in 'libmp3lame mp3' 'libmp3lame -write_xing 0 mp3' 'aac aac' 'aac m4a' 'ac3 ac3' 'libopus opus' 'flac flac' \
  'pcm_s16be aiff'; do
  # shellcheck disable=SC2086 # several words
  ffmpeg -v error -y -i exact.wav -c:a ${packed% *} "exact.${packed##* }" 2>/dev/null || continue
  by_each "exact.${packed##* }"
  [ "$codes" = ' 0 0 0' ] || { cat ./*.said; fail "$packed: exit codes$codes"; }
  [ "$(samples movie.mov)" = 4800 ] || fail "$packed: $(samples movie.mov) samples in the movie"
done

# Names are names, whatever is in them.
mkdir names
for name in -y 'a%03d' 'concat:a|b' 'http:x' 'pipe:0' "it's \"so\"" '[0:v]' '@x' '--preset'; do
  cp exact.wav "names/$name.wav"
  exits 0 "$DOMEFALL" movie show.yaml --from made --preset master --out name.mov --audio "names/$name.wav"
done
(cd names && exits 0 "$DOMEFALL" movie ../show.yaml --from ../made --preset master --audio=-y.wav --out ../name.mov)

# One file for each channel, in any case and order.
for name in L r C lfe Ls rs Lb Rb; do wave "mix_$name.wav" 4800; done
taken '' mix_r.wav mix_L.wav
taken '' mix_rs.wav mix_Ls.wav mix_lfe.wav mix_C.wav mix_r.wav mix_L.wav
[ "$(ffprobe -v error -select_streams a -show_entries stream=channels,channel_layout -of csv=p=0 movie.mov)" = 6,5.1 ] ||
  fail "no 5.1"
grep -q '"channel": "LFE"' delivered/metadata.json || fail "metadata.json does not name the channels"
taken '' mix_*.wav
[ "$(ffprobe -v error -select_streams a -show_entries stream=channels,channel_layout -of csv=p=0 movie.mov)" = 8,7.1 ] ||
  fail "no 7.1"
refused 'audio: more than one file is the channel l: mix_L.wav and ./mix_L.wav' mix_L.wav ./mix_L.wav
for k in $(seq 12); do wave "dome_$k.wav" 4800; done
taken '' dome_*.wav
[ "$(ffprobe -v error -select_streams a -show_entries stream=channels -of csv=p=0 movie.mov)" = 12 ] || fail "no 12 channels"

# More channels than the codec of a preset has, before a frame is made.
wave m12.wav 4800 channels=12
for command in "movie show.yaml --preset dome --out no.mp4" "movie show.yaml --preset review --from nowhere --out no.mp4" \
  "farm submit show.yaml --engine local --movie dome --out no" \
  "farm submit show.yaml --engine openjd --movie dome --out no --dry-run"; do
  # shellcheck disable=SC2086 # several words
  exits 2 "$DOMEFALL" $command --audio m12.wav
  says '^m12.wav: 12 channels, and the sound of the preset (dome|review) has at most 8'
  [ "$(cat stdout)$(find . -name 'no' -o -name 'no.mp4')" = '' ] || fail "$command: something was made"
done

# A show names its sound itself, beside it: movies, deliveries and the preview have it.
mkdir sung
cp show.yaml sung/
cp mix_L.wav mix_r.wav sung/
sed -i 's/^timeline/audio: [mix_L.wav, mix_r.wav]\ntimeline/' sung/show.yaml
exits 0 "$DOMEFALL" movie sung/show.yaml --from made --preset master --out sung.mov
[ "$(ffprobe -v error -select_streams a -show_entries stream=channels -of csv=p=0 sung.mov)" = 2 ] || fail "no stereo"
exits 0 "$DOMEFALL" deliver sung/show.yaml --from made --out sung/sent
[ "$(ls sung/sent/audio)" = "$(printf 'mix_L.wav\nmix_r.wav')" ] || fail "delivered: $(ls sung/sent/audio)"
exits 0 "$DOMEFALL" movie sung/show.yaml --from made --preset master --audio mix_C.wav --out sung.mov
[ "$(ffprobe -v error -select_streams a -show_entries stream=channels -of csv=p=0 sung.mov)" = 1 ] || fail "another sound"
exits 2 "$DOMEFALL" movie sung/show.yaml --from made --preset master --out sung/mix_L.wav
for audio in mix_L.wav '[mix_L.wav, mix_L.wav]' "[$(printf 'dome_%d.wav, ' $(seq 11))dome_12.wav]" m12.wav; do
  cp dome_*.wav m12.wav sung/
  sed -i "s/^audio: .*/audio: $audio/" sung/show.yaml
  : >address
  "$DOMEFALL" preview sung/show.yaml --no-open >>address 2>said &
  server=$!
  until [ "$(wc -l <address)" -ge 2 ]; do kill -0 "$server"; sleep 0.02; done
  code=$(curl -s -o heard.mp4 -w '%{http_code}' "$(head -n 1 address)sound")
  if [[ $audio = *L*L* ]]; then
    [[ $code = 400 && $(cat heard.mp4) = *'more than one file is the channel l'* ]] || fail "$audio: $code $(cat heard.mp4)"
  else
    heard=$(ffprobe -v error -show_entries stream=codec_name,channels:format=duration -of csv=p=0 heard.mp4 | tr '\n' ' ')
    [[ $code = 200 && $heard = 'aac,2 0.1'* ]] || fail "$audio: $code $heard"
  fi
  kill "$server"
  wait "$server" || true
done
printf 'audio: none.wav\ntimeline: [{duration_s: 1}]\n' >mute.yaml
exits 75 "$DOMEFALL" check mute.yaml
says 'mute.yaml:1:8: audio.*none.wav'
