#!/usr/bin/env bash
# A program whose talk goes into a full pipe that nobody reads still ends when it is asked to.
source "$(dirname "$0")/common.bash"
write_grid_show tiny.yaml 16 60 60
cat >unread_pipes.py <<'END_OF_TEST'
import os, pathlib, signal, subprocess, sys, time

DOMEFALL, HERE = os.environ['DOMEFALL'], pathlib.Path('.')
ENDING = [signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
for number in ENDING:  # which whoever started this may have ignored
    signal.signal(number, signal.default_int_handler)

def full_pipe():
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    for count in (4096, 1):
        try:
            while True:
                os.write(writer, b'x' * count)
        except BlockingIOError:
            pass
    os.set_blocking(writer, True)
    return reader, writer

def is_ready(process):
    """Whether it handles signals."""
    status = pathlib.Path(f'/proc/{process.pid}/status').read_text()
    return int(status.split('SigCgt:')[1].split()[0], 16) >> signal.SIGXCPU - 1 & 1

def busy(process):
    """Processor time so far, in ticks."""
    fields = pathlib.Path(f'/proc/{process.pid}/stat').read_text().rsplit(')', 1)[1].split()
    return int(fields[11]) + int(fields[12])

def wait_until_stuck(process):
    before, since = -1, time.monotonic()
    while time.monotonic() - since < 0.5:
        assert process.poll() is None, ('not stuck, but ended', process.args, process.returncode)
        if busy(process) != before or not is_ready(process):
            before, since = busy(process), time.monotonic()
        time.sleep(0.02)

def start(command, **streams):
    return subprocess.Popen([DOMEFALL, *command], stdin=subprocess.DEVNULL, **streams)

def ends(process, numbers):
    """It is stuck, and these signals end it as they should."""
    wait_until_stuck(process)
    for number in numbers:
        process.send_signal(number)
        time.sleep(0.2)
    try:
        code = process.wait(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        sys.exit(f'{process.args} does not end')
    assert code == 128 + numbers[0], (process.args, code)
    left = [p for p in HERE.rglob('*.tmp')]
    assert not left, left

# A run says of each frame what it cost.  The first signal asks it to finish the frame.
RENDER = ['render', 'tiny.yaml', '--explain', '--threads', '2', '--out', 'out']
STATES = ['states', 'tiny.yaml']
for number in ENDING:
    reader, writer = full_pipe()
    ends(start(RENDER, stderr=writer, stdout=subprocess.DEVNULL), [number, number])
    ends(start(STATES, stderr=writer, stdout=writer), [number])
    os.close(reader)
    os.close(writer)

# Where there is a reader, it is told.
reader, writer = full_pipe()
process = start(STATES, stderr=subprocess.PIPE, stdout=writer)
ends(process, [signal.SIGTERM])
assert process.stderr.read() == b'stopped; what was not finished has been removed\n'
END_OF_TEST
python3 unread_pipes.py || fail "see above"
