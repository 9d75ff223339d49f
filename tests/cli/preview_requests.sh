#!/usr/bin/env bash
# domefall preview: what it serves, to whom, and that no request brings it down.
source "$(dirname "$0")/common.bash"
trap 'kill ${server:-} ${holder:-} 2>/dev/null || true; rm -rf "$folder"' EXIT
# serve SHOW: starts the preview $server at $url.
serve() {
  rm -f address said
  "$DOMEFALL" preview "$1" --no-open --threads 2 >address 2>said &
  server=$!
  for ((k = 0; k < 1000; ++k)); do
    [[ -e address && $(wc -l <address) -ge 2 ]] && break
    kill -0 "$server" 2>/dev/null || fail "the preview ended: $(cat said)"
    sleep 0.02
  done
  url=$(head -n 1 address)
}

# The name of a star, which a catalogue in another encoding gave it, is no UTF-8.
printf 'hip,ra_deg,dec_deg,v_mag,b_v,name,designation\n1,10,20,1,0.5,Caf\351,\n' >latin.csv
cat >latin.yaml <<'END'
size: [320, 180]
camera: {projection: stereographic, fov_deg: 60, look_at: {ra_deg: 10, dec_deg: 20}}
sky: {region_I: {background: black, stars: {catalogue: ./latin.csv}}}
timeline: [{duration_s: 1}]
END
serve latin.yaml
python3 - "$url" <<'END'
import json, sys, urllib.request
with urllib.request.urlopen(sys.argv[1] + 'probe?frame=0&w=320&h=180&x=160.5&y=90.5', timeout=60) as answer:
    star = json.load(answer)['star']
assert star['name'] == 'Caf\N{REPLACEMENT CHARACTER}' and star['magnitude'] == 1, star
END
kill "$server"
wait "$server" || true

write_show fall.yaml
serve fall.yaml
[[ $url =~ ^http://127\.0\.0\.1:([0-9]+)/[0-9a-f]{32}/$ ]] || fail "no address: $url"
port=${BASH_REMATCH[1]}
grep -q "ssh -L $port:127.0.0.1:$port " address || fail "no word of a tunnel: $(cat address)"

# A still picture is the one that --out writes, but for what half a step of 12 bits of the grade does.
exits 0 "$DOMEFALL" preview fall.yaml --frame 6 --out still.jpg --size 320x180
python3 - "$url" "$server" still.jpg <<'END'
import json, random, re, socket, sys, time, urllib.parse, urllib.request

url, server, still = sys.argv[1], int(sys.argv[2]), sys.argv[3]
where = urllib.parse.urlsplit(url)
host, token = where.netloc, where.path.strip('/')
random.seed(5)


def resident():
    with open(f'/proc/{server}/status') as status:
        return int(re.search(r'VmRSS:\s*(\d+)', status.read())[1]) / 1024  # MiB


def get(path, headers=(), method='GET', base=url):
    """The status, the headers and the body of one answer."""
    request = urllib.request.Request(base + path, headers=dict(headers), method=method)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, dict(answer.headers), answer.read()
    except urllib.error.HTTPError as error:
        return error.code, dict(error.headers), error.read()


def scan(jpeg):
    """The coded pixels and tables of a JPEG, without its comments and profiles."""
    kept, at = [], 2
    while jpeg[at + 1] != 0xda:
        size = 2 + int.from_bytes(jpeg[at + 2:at + 4], 'big')
        if jpeg[at + 1] not in (0xfe, 0xe0, 0xe2):
            kept.append(jpeg[at:at + size])
        at += size
    return b''.join(kept) + jpeg[at:]


status, headers, page = get('')
assert status == 200 and b'<title>' in page
policy = headers['Content-Security-Policy']
assert "default-src 'none'" in policy and headers['Cache-Control'] == 'no-store'
for name in re.findall(rb'(?:src|href)="([^"]+)"', page):
    assert get(name.decode())[0] == 200, name
assert not re.search(rb'https?://(?!127)', page.replace(b'http://www.w3.org/', b'')), 'no other host'

# No part of a file is sent, and no more than the file.
for parts in ('0-9', ','.join(f'{k}-' for k in range(2600))):
    status, headers, whole = get('', [('Range', f'bytes={parts}')])
    assert status == 200 and whole == page and 'Content-Range' not in headers
status, headers, body = get('', method='HEAD')
assert status == 200 and body == b'' and int(headers['Content-Length']) == len(page)
status, headers, text = get('nothing')
assert status == 404 and text == b'the preview has no such page\n', text

facts = json.loads(get('show')[2])
assert facts['revision'] == 1 and facts['mistake'] is None and facts['frames'] > 6
assert len(facts['states']['r']) == facts['frames']
assert get('plot.svg')[2].startswith(b'<')

# With a display of its own a picture is graded by the table from the first one on.
picture = 'picture?frame=6&w=320&h=180&display=sRGB%20-%20Display'
status, headers, before = get(picture)
assert status == 200 and headers['Content-Type'] == 'image/jpeg'
about = json.loads(headers['X-Domefall'])
assert about['frame'] == 6 and about['projection'] == 'stereographic' and len(about['camera']) == 9
again = get(picture)[2]
assert scan(before) == scan(again)

# Only this page, from this machine, with the token.  A refusal says why.
port = host.split(':')[1]
other = f'http://{host}/'


def refused(words, path='show', headers=(), **more):
    status, _, text = get(path, headers, **more)
    assert status == 403 and words in text.decode(), (path, headers, more, status, text[:200])


for path in ('', f'{"0" * 32}/', f'{token[:-1]}/', f'{token}x/', f'{token}%2f', f'/{token}/'):
    refused('is not the address that domefall preview has printed', path, base=other)
for path in ('../../etc/passwd', '%2e%2e/%2e%2e/etc/passwd', 'fall.yaml', '/etc/passwd', 'page/../show.h'):
    assert get(path)[0] in (403, 404), path
for name, value in (('Host', 'evil.example'), ('Host', f'evil.example:{port}'), ('Origin', 'http://evil.example'),
                    ('Origin', 'null'), ('Origin', f'http://127.0.0.1:{int(port) + 1}'),
                    ('Sec-Fetch-Site', 'cross-site'), ('Sec-Fetch-Site', 'same-site')):
    refused(f'({name})', headers=[(name, value)])
assert get('show', [('Origin', f'http://{host}'), ('Sec-Fetch-Site', 'same-origin')])[0] == 200
assert get('show', [('Host', 'localhost:1')])[0] == 200, 'a tunnel may end at another port'
for method in ('POST', 'PUT', 'DELETE', 'OPTIONS', 'PATCH'):
    refused('GET and HEAD only', method=method)

# A link to the address is followed, wherever it stands.
for site in ('cross-site', 'same-site'):
    link = [('Sec-Fetch-Site', site), ('Sec-Fetch-Mode', 'navigate'), ('Sec-Fetch-Dest', 'document')]
    assert get('', link)[2] == page, site
    assert get(token, link, base=other)[2] == page, 'the last slash is missing'
    refused('is not the address', 'x/', link, base=other)
    refused('GET and HEAD only', '', link, method='POST')
    refused('(Origin)', '', link + [('Origin', 'http://evil.example')])
    for mode, dest in (('navigate', 'iframe'), ('no-cors', 'document'), ('cors', 'empty'), ('no-cors', 'script')):
        refused('(Sec-Fetch-Site)', '', [link[0], ('Sec-Fetch-Mode', mode), ('Sec-Fetch-Dest', dest)])


def said(sent):
    """All that the server says until it closes the connection, and how long that takes."""
    with socket.create_connection(('127.0.0.1', int(port)), timeout=60) as connection:
        connection.sendall(sent)
        began, came = time.monotonic(), b''
        while piece := connection.recv(65536):
            came += piece
    return came, time.monotonic() - began


# What comes with or behind a refused request is no request: a page may have any body sent.
start = f' /{token}/show HTTP/1.1\r\nHost: {host}\r\n'.encode()
inner = b'GET' + start + b'\r\n'
length, evil = b'Content-Length: %d\r\n' % len(inner), b'Origin: http://evil.example\r\n'
chunks = b'%x\r\n' % len(inner) + inner + b'\r\n0\r\n\r\n'
chunked = b'Transfer-Encoding: chunked\r\n'
for method in (b'POST', b'GET', b'HEAD', b'PUT'):
    for fields, body in ((length, inner), (chunked, chunks), (chunked + length, chunks), (length + chunked, chunks),
                         (b'Transfer-Encoding: gzip\r\n', inner), (b'Transfer-Encoding: chunked, gzip\r\n', chunks),
                         (length + b'Content-Length: 3\r\n', inner), (b'Content-Length: 0\r\n' + length, inner),
                         (b'Content-Length: 3, 3\r\n', inner), (b'Content-Length: 99999999999\r\n', inner),
                         (b'Content-Length: -1\r\n', inner), (b'Expect: 100-continue\r\n' + length, inner),
                         (b'content-length : 3\r\n', inner)):
        for origin in (b'', evil):
            came, _ = said(method + start + origin + fields + b'\r\n' + body)
            assert came.count(b'HTTP/1.1 ') == 1 and re.match(rb'HTTP/1.1 40[03] ', came), (method, fields, came)
            assert b'\r\nConnection: close\r\n' in came and b'"states"' not in came, (method, fields, came)
came, _ = said(b'GET' + start + evil + b'\r\n' + inner)
assert came.count(b'HTTP/1.1 ') == 1 and b'403 ' in came[:20], came
came, _ = said(b'GET' + start + b'Host: evil.example\r\n\r\n')
assert b'403 ' in came[:20] and b'(Host)' in came, came
came, took = said(inner * 3)
assert came.count(b'HTTP/1.1 200 ') == 3 and took < 20, (came[:100], took)
came, _ = said(b'GET' + start + b'X: ' + b'y' * 70_000 + b'\r\n\r\n')
assert came.startswith(b'HTTP/1.1 400 ') and b'longer than 64 KiB' in came, came
came, _ = said(b'GET' + start + b'X: ' + b'y' * 60_000 + b'\r\nConnection: close\r\n\r\n')
assert came.startswith(b'HTTP/1.1 200 '), came[:100]
came, _ = said(b'\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 as a browser that tries TLS\r\n\r\n')
assert came.startswith(b'HTTP/1.1 400 ') and b'is no request of HTTP' in came, came
for silent in (b'', b'GET /', b'GET' + start):
    came, took = said(silent)
    assert came == b'' and took < 20, (came, took)

addresses = ['127.0.0.2']
try:
    addresses.append(socket.gethostbyname(socket.gethostname()))
except OSError:
    pass  # the machine's name leads nowhere
for address in addresses:
    if address != '127.0.0.1':
        with socket.socket() as elsewhere:
            assert elsewhere.connect_ex((address, int(port))) != 0, address

# 10,000 random and hostile requests, over connections that are kept and some that break off.
words = ['0', '1', '-1', '6', '1e18', '99999999999999999999', 'nan', 'inf', '', '%00', '../', 'I', 'III',
         'moving', 'still', 'stereographic', 'rectilinear', 'domemaster', 'x' * 300, '%ff%fe', '16', '64', '4097',
         '1e-300', 'lensing', 'rim,grid', 'sRGB - Display', 'Dome']
names = ['frame', 'w', 'h', 'projection', 'fov', 'look', 'ev', 'display', 'view', 'effects', 'amplification',
         'skies', 'stars', 'overlays', 'detail', 'client', 'n', 'kind', 'x', 'y', 'since', 'mistake', 'key']
pages = ['picture', 'probe', 'camera', 'show', 'warnings', 'index.html', 'nothing', '']


def hostile():
    if random.random() < 0.1:
        return bytes(random.randrange(256) for _ in range(random.randrange(60))) + b'\r\n\r\n'
    page = random.choice(pages)
    given = [f'{random.choice(names)}={urllib.parse.quote(random.choice(words), safe="%")}'
             for _ in range(random.randrange(5))]
    # Most small, so that the test does not spend its time on pictures.
    if page in ('picture', 'probe', 'camera'):
        given += ['w=16', 'h=16', 'fov=0'] if random.random() < 0.97 else ['w=16', 'h=16']
    start = f'/{token}/' if random.random() < 0.9 else random.choice(['/', '//', f'/{token}', 'x', '/%2e/'])
    verb = random.choice(['GET'] * 9 + ['HEAD', 'POST', 'get', 'G' * 50])
    head = f'{verb} {start}{page}?{"&".join(given)} HTTP/1.1\r\nHost: {host}\r\n'
    if random.random() < 0.05:
        head += 'X: ' + 'y' * random.choice([100, 9000]) + '\r\n'
    if random.random() < 0.05:
        head += f'Content-Length: {random.choice(["5", "-1", "99999999999", "x"])}\r\n'
    if random.random() < 0.05:
        head += f'Range: bytes={random.choice(["0-", "-1", "5-2", "0-0,1-1,2-2", "99999999999-"])}\r\n'
    return head.encode() + b'\r\n'


low, connection, sent = resident(), None, 0
while sent < 10_000:
    try:
        if connection is None:
            connection = socket.create_connection(('127.0.0.1', int(port)), timeout=60)
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection.sendall(b''.join(hostile() for _ in range(10)))
        sent += 10
        connection.recv(65536)
        if random.random() < 0.3:
            connection.close()
            connection = None
    except OSError:
        connection.close()
        connection = None

# Endless requests, of header lines and of one line, and one that comes byte by byte: each is cut off.
for endless in (b'X: y\r\n' * 1000, b'y' * 6000):
    with socket.create_connection(('127.0.0.1', int(port)), timeout=10) as talker:
        talker.sendall(f'GET /{token}/show HTTP/1.1\r\nHost: {host}\r\n'.encode())
        said = 0
        try:
            while said < 100e6:
                talker.sendall(endless)
                said += len(endless)
        except OSError:
            pass
        assert said < 20e6, said
with socket.create_connection(('127.0.0.1', int(port)), timeout=10) as drip:
    began = time.monotonic()
    try:
        while time.monotonic() - began < 20:
            drip.sendall(b'G')
            time.sleep(0.1)
    except OSError:
        pass
    assert time.monotonic() - began < 10

# 500 at once that say half of a request, and 100 that say nothing.  The page is answered meanwhile.
slow = []
for k in range(600):
    try:
        half = socket.create_connection(('127.0.0.1', int(port)), timeout=0.2)
        half.sendall(f'GET /{token}/show HTTP/1.1\r\nHo'.encode()[:40 * (k < 500)])
        slow.append(half)
    except OSError:
        pass
assert len(slow) > 100
assert get('')[2] == page
for half in slow:
    half.close()

status, _, after = get(picture)
assert status == 200 and scan(after) == scan(before), (status, len(after), len(before), after[:200])
assert resident() < low + 400, (low, resident())
with open(still, 'rb') as file:
    shown, written = scan(before), scan(file.read())
assert len(shown) > 2000 and abs(len(shown) - len(written)) < len(written) / 50, (len(shown), len(written))
END

# It ends as other programs do, and leaves nothing behind.
kill -TERM "$server"
ended 143 "$server"

# The browser is given a file that only this user can read, nothing that is a secret, and no socket.
mkdir desktop "quiet place"
cat >desktop/xdg-open <<'END'
#!/bin/sh
{
  echo "$#" "$(stat -c %a "$1" "$(dirname "$1")" | xargs)"
  find /proc/self/fd -lname 'socket:*'
} >given.new
cp "$1" opened.html
printf '%s\n' "$1" >argument
mv given.new given
END
chmod +x desktop/xdg-open
rm -f address
(umask 0 && DISPLAY=:9 TMPDIR="$folder/quiet place" PATH="$folder/desktop:$PATH" \
  exec "$DOMEFALL" preview fall.yaml >address 2>said) &
server=$!
for ((k = 0; k < 1000; ++k)); do [[ -e given ]] && break; sleep 0.02; done
url=$(head -n 1 address)
[[ $(<given) == "1 600 700" ]] || fail "the opener was given what others may read: $(<given)"
! grep -q "$(basename "$url")" argument || fail "the token stands in the opener's arguments: $(<argument)"
[[ $(<argument) == "$folder/quiet place/"*.html ]] || fail "the opener was given $(<argument)"
grep -qF "url=$url\"" opened.html || fail "the opened page does not lead to $url: $(<opened.html)"
kill -TERM "$server"
wait "$server" || true
[[ ! -e $(<argument) && -z $(ls "quiet place") ]] || fail "the opened page was left behind"

# Without a place for that file there is no browser, but there is the preview.
DISPLAY=:9 TMPDIR="$folder/nowhere" PATH="$folder/desktop:$PATH" "$DOMEFALL" preview fall.yaml >address 2>said &
server=$!
for ((k = 0; k < 1000; ++k)); do [[ -s said ]] && break; sleep 0.02; done
grep -q '^no browser was opened: ' said || fail "it does not say that no browser was opened: $(<said)"
python3 -c 'import sys, urllib.request; urllib.request.urlopen(sys.argv[1])' "$(head -n 1 address)" ||
  fail "the preview is gone with its browser"
kill -TERM "$server"
wait "$server" || true

# What cannot be served is told.
exits 2 "$DOMEFALL" preview fall.yaml --no-open --frame 3
exits 2 "$DOMEFALL" preview nothing.yaml --no-open
printf 'timelime: 3\n' >wrong.yaml
exits 2 "$DOMEFALL" preview wrong.yaml --no-open
python3 -c 'import socket, sys, time
s = socket.socket()
s.bind(("127.0.0.1", 0))
s.listen()
print(s.getsockname()[1], flush=True)
time.sleep(60)' >taken &
holder=$!
while [[ ! -s taken ]]; do sleep 0.02; done
exits 75 "$DOMEFALL" preview fall.yaml --no-open --port "$(cat taken)"
kill "$holder"
