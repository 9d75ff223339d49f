#!/usr/bin/env bash
# What editing programs are given, read by a reader that was written from OpenTimelineIO's schema, and
# markers that come back.
source "$(dirname "$0")/common.bash"
cat >cut.yaml <<'END'
title: "A cut & a half"
frames_per_second: 24000/1001
size: 32
markers: {first light: 0:01, "half | way": 2.5}
titles: [{text: "Less < more & --> so\n\nSecond line", at_s: 1, duration_s: 2}]
timeline:
  - {duration_s: 2, titles: [{text: Before, at_s: 0.5, duration_s: 0.25}]}
  - {duration_s: 3, dissolve_s: 1}
  - {duration_s: 1}
END
exits 0 "$DOMEFALL" timeline cut.yaml --from 'a folder/é' --out cut.otio
cat >read_otio.py <<'END'
import json, math, sys
# Required fields by the serialized schema of OpenTimelineIO, with their types.
number = (int, float)
SCHEMA = {
    'RationalTime.1': {'rate': number, 'value': number},
    'TimeRange.1': {'start_time': 'RationalTime.1', 'duration': 'RationalTime.1'},
    'Timeline.1': {'metadata': dict, 'name': str, 'global_start_time': ('RationalTime.1', None), 'tracks': 'Stack.1'},
    'Stack.1': {'metadata': dict, 'name': str, 'source_range': ('TimeRange.1', None), 'effects': list, 'markers': list,
                'enabled': bool, 'children': list},
    'Track.1': {'metadata': dict, 'name': str, 'source_range': ('TimeRange.1', None), 'effects': list, 'markers': list,
                'enabled': bool, 'children': list, 'kind': str},
    'Clip.2': {'metadata': dict, 'name': str, 'source_range': ('TimeRange.1', None), 'effects': list, 'markers': list,
               'enabled': bool, 'media_references': dict, 'active_media_reference_key': str},
    'Transition.1': {'metadata': dict, 'name': str, 'in_offset': 'RationalTime.1', 'out_offset': 'RationalTime.1',
                     'transition_type': str},
    'Marker.2': {'metadata': dict, 'name': str, 'color': str, 'marked_range': 'TimeRange.1', 'comment': str},
    'ImageSequenceReference.1': {
        'metadata': dict, 'name': str, 'available_range': ('TimeRange.1', None), 'available_image_bounds': (None,),
        'target_url_base': str, 'name_prefix': str, 'name_suffix': str, 'start_frame': int, 'frame_step': int,
        'rate': number, 'frame_zero_padding': int, 'missing_frame_policy': str},
}
def is_a(value, kind):
    if isinstance(kind, tuple) and kind is not number:
        return any(is_a(value, k) for k in kind)
    if kind is None:
        return value is None
    if isinstance(kind, str):
        return isinstance(value, dict) and value.get('OTIO_SCHEMA') == kind
    return isinstance(value, kind) and (kind is bool or not isinstance(value, bool))
def hold(value):
    if isinstance(value, dict):
        name = value.get('OTIO_SCHEMA')
        if name:
            fields = SCHEMA[name]
            assert set(value) - {'OTIO_SCHEMA'} == set(fields), (name, set(value) ^ set(fields))
            for field, kind in fields.items():
                assert is_a(value[field], kind), (name, field, value[field])
        for v in value.values():
            hold(v)
    elif isinstance(value, list):
        for v in value:
            hold(v)
timeline = json.load(open(sys.argv[1]))
assert timeline['OTIO_SCHEMA'] == 'Timeline.1'
hold(timeline)
assert timeline['name'] == 'A cut & a half'
rate = 24000 / 1001
frames = lambda t: (math.isclose(t['rate'], rate) or sys.exit('rate')) and t['value']
track = timeline['tracks']['children'][0]
clips = [c for c in track['children'] if c['OTIO_SCHEMA'] == 'Clip.2']
# Without a gap: each clip goes on where the one before ended, up to the last frame.
at = 0
for clip in clips:
    assert frames(clip['source_range']['start_time']) == at, clip
    at += frames(clip['source_range']['duration'])
assert len(clips) == 3 and at == int(sys.argv[2]), at
# The dissolve from 1 to 2 s lies about the cut at 1.5 s.
assert [c['OTIO_SCHEMA'] for c in track['children']] == ['Clip.2', 'Transition.1', 'Clip.2', 'Clip.2']
cut = frames(clips[1]['source_range']['start_time'])
offsets = track['children'][1]
assert cut == math.ceil(1.5 * rate)
assert cut - frames(offsets['in_offset']) == math.ceil(rate)
assert cut + frames(offsets['out_offset']) == math.ceil(2 * rate)
marks = {m['name']: frames(m['marked_range']['start_time']) for m in timeline['tracks']['markers']}
assert marks == {'first light': 24, 'half | way': 60}, marks
media = clips[0]['media_references']['DEFAULT_MEDIA']
assert media['target_url_base'].endswith('/a%20folder/%C3%A9/graded/'), media
assert media['target_url_base'].startswith('file:///')
assert (media['name_prefix'], media['name_suffix'], media['start_frame']) == ('cut_', '.png', 0)
END
count=$("$DOMEFALL" states cut.yaml | grep -c '^[0-9]')
python3 read_otio.py cut.otio "$count" || fail "the timeline is not as its schema says"

# It comes back: markers and cuts at the frames where they were.
sed 's/^markers:.*/markers: cut.otio/' cut.yaml >back.yaml
exits 0 "$DOMEFALL" check back.yaml --json
jq -r '.markers[] | "\(.frame) \(.name)"' stdout >came_back
printf '%s\n' '0 1 static' '24 first light' '36 2 static' '60 half | way' '96 3 static' >expected
cmp came_back expected || fail "markers came back as $(cat came_back)"

# Resolve's list of markers, and subtitles whose text cannot end them.
exits 0 "$DOMEFALL" timeline cut.yaml --format edl
grep -q '^001  001      V     C        01:00:01:00 01:00:01:01 01:00:01:00 01:00:01:01$' stdout || fail "$(cat stdout)"
grep -q '^ |C:ResolveColorGreen |M:half   way |D:1$' stdout || fail "$(cat stdout)"
exits 0 "$DOMEFALL" timeline cut.yaml --format vtt
printf '%s\n' WEBVTT '' 1 '00:00:00.500 --> 00:00:00.750' Before '' 2 '00:00:01.000 --> 00:00:03.000' \
  'Less &lt; more &amp; --&gt; so' 'Second line' '' >expected
cmp stdout expected || fail "subtitles: $(cat stdout)"
exits 0 "$DOMEFALL" timeline cut.yaml --format srt --out cut.srt
exits 0 ffprobe -v error -show_entries stream=codec_name -of csv=p=0 cut.srt
tells '^subrip$'

# Files that are no timeline, and markers behind the end, are refused with their place.
printf '{"OTIO_SCHEMA": "Track.1"}' >cut.otio
exits 2 "$DOMEFALL" check back.yaml
says 'back.yaml:4:[0-9]+: markers .*cut.otio: it is no OTIO timeline'
exits 2 "$DOMEFALL" timeline cut.yaml --format otio --out cut.yaml
