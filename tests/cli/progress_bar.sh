#!/usr/bin/env bash
# The bar of a run on terminals of any width: it fits, what is said meanwhile stands above it, and
# whatever comes after it begins on a line of its own.
source "$(dirname "$0")/common.bash"
write_grid_show tiny.yaml
cat >bar.py <<'PY'
import fcntl, os, pty, re, shutil, signal, struct, subprocess, sys, termios

DOMEFALL = os.environ["DOMEFALL"]
BAR = re.compile(r"^(\[[#.]+\] )?\d+/60( |$)")

def set_width(side, columns):
    fcntl.ioctl(side, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))

def run(columns, options=(), when_begun=None, code=0):
    """Renders on such a terminal, and returns what it was sent. `when_begun` is called once, while
    more is still to be said than a terminal's buffer holds."""
    shutil.rmtree("out", ignore_errors=True)
    terminal, side = pty.openpty()
    set_width(side, columns)
    process = subprocess.Popen([DOMEFALL, "render", "tiny.yaml", "--out", "out", *options],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=side)
    os.close(side)
    text = b""
    while True:
        try:
            piece = os.read(terminal, 1024)
        except OSError:  # nobody has the other side open any more
            piece = b""
        if not piece:
            break
        text += piece
        if when_begun:
            when_begun(terminal, process)
            when_begun = None
    os.close(terminal)
    assert process.wait() == code, (process.returncode, text)
    return text.decode()

def screen(text, columns):
    """The lines of a terminal that was sent the text, without the blanks at their ends."""
    rows, at = [""], 0
    for c in text:
        if c == "\r":
            at = 0
        elif c == "\n":
            rows.append("")
        else:
            assert c.isprintable(), repr(c)
            if at == columns:
                rows.append("")
                at = 0
            rows[-1] = rows[-1][:at].ljust(at) + c + rows[-1][at + 1:]
            at += 1
    assert at == 0 and rows[-1] == "", "the next prompt would not begin its line: %r" % rows[-1]
    return [row.rstrip() for row in rows[:-1]]

def bars(text):
    return [part for part in re.split("[\r\n]+", text) if BAR.match(part)]

for columns in (1, 2, 5, 6, 10, 20, 40, 79, 80, 81, 300, 0):
    seen = columns or 80  # one that does not say how wide it is
    text = run(columns)
    rows = screen(text, seen)
    assert all(len(part) < seen for part in bars(text)), (columns, bars(text))
    said = "60 frames made, 0 already there, in "
    shown = rows[0] if seen > 5 else ""  # where 60/60 has no room there is no bar
    if seen > 5:
        assert BAR.match(shown) and "60/60" in shown, (columns, rows)
        rows = rows[1:]
    assert "".join(row.ljust(seen) for row in rows).startswith(said), (columns, rows)
    if seen >= 40:
        assert re.match(r"\[#{5,30}\] 60/60 frames", shown), (columns, shown)
    if seen >= 80:
        assert re.search(r"\] 60/60 frames  [\d.]+ frames/s  ETA 0:00:00$", shown), (columns, shown)

# What is said meanwhile has its own lines, and the bar comes back below.
text = run(80, ["--explain"])
rows = screen(text, 80)
assert [row.startswith("frame ") for row in rows].count(True) >= 120, rows
assert [bool(BAR.match(row)) for row in rows].count(True) == 1 and BAR.match(rows[-2]), rows[-3:]
assert not any("/60 frames" in row and not BAR.match(row) for row in rows), rows

# The window becomes narrow, and wide, while frames are made.
for before, after in ((120, 25), (25, 120)):
    text = run(before, ["--explain"], lambda terminal, process: set_width(terminal, after))
    assert len(bars(text)[0]) < before, bars(text)[0]
    last = bars(text)[-1].rstrip()
    assert "60/60" in last and len(last) < after, last
    assert ("frames/s" in last) == (after == 120), last

# A signal that ends the run leaves the bar its line, too.
text = run(80, ["--explain"], lambda terminal, process: process.send_signal(signal.SIGINT), code=130)
rows = screen(text, 80)
assert rows[-1] == "stopped; run the same command again to go on", rows[-2:]
assert BAR.match(rows[-2]), rows[-2:]
PY
python3 bar.py || fail "see above"

# Without a terminal there is no bar.
exits 0 "$DOMEFALL" render tiny.yaml --out plain
[ "$(wc -l <stderr)" -eq 1 ] || fail "$(cat stderr)"
says '^60 frames made, 0 already there'
