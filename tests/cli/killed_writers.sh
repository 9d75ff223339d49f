#!/usr/bin/env bash
# Every verb that writes, ended at 100 moments and by four signals: what bears a file's name is whole, what was
# asked to end leaves nothing else, and the next run removes what a kill has left.
source "$(dirname "$0")/common.bash"
write_grid_show tiny.yaml
oiiotool --pattern fill:topleft=0,0,0:topright=1,0.5,0:bottomleft=0,0.5,1:bottomright=1,1,1 64x32 3 -d uint8 -o panorama.png
mkdir tiff8
sed 's/^timeline/output: {graded: tiff8}\n&/' tiny.yaml >tiff8/tiny.yaml
cat >killed_writers.py <<'END'
import os, pathlib, random, shutil, signal, subprocess, time

DOMEFALL, STARS = os.environ['DOMEFALL'], os.environ['DOMEFALL_SOURCE'] + '/shows/assets/stars_to_8.csv'
KILL, TERM, INT, HUP = signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP
SIGNALS = [[KILL], [TERM], [KILL], [INT], [KILL], [HUP], [KILL], [TERM, TERM]]
chance = random.Random(13)
# Of a job in the background, signals to interrupt it are ignored by what it starts, too.
signal.signal(INT, signal.default_int_handler)

class Case:
    """A verb, and the folders that it writes to."""
    def __init__(self, name, moments, *command):
        self.name, self.moments = name, moments
        self.out, self.scratch = pathlib.Path(name).absolute(), pathlib.Path(name + '.tmpdir').absolute()
        self.command = [DOMEFALL, *(word.replace('OUT', str(self.out)) for word in command)]
        self.killed_in_the_middle = 0
        self.prepare = lambda: None
        self.scratch.mkdir()
        self.out.mkdir()

    def start(self):
        environment = dict(os.environ, TMPDIR=str(self.scratch))
        return subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, env=environment)

    def unfinished(self):
        return [p for p in [*self.out.rglob('*'), *self.scratch.rglob('*')]
                if p.name.endswith('.tmp') or self.scratch in p.parents]

    def files(self):
        return {str(p.relative_to(self.out)): p.read_bytes()
                for p in self.out.rglob('*') if p.is_file() and not p.name.endswith('.tmp')}

    def run(self):
        begin = time.monotonic()
        code = self.start().wait()
        assert code == 0, (self.name, code)
        assert not self.unfinished(), (self.name, self.unfinished())
        return time.monotonic() - begin

    def is_whole(self, name, content):
        return content == self.whole[name]

    def clear(self):
        for path in list(self.out.iterdir()):
            if not path.name.endswith('.tmp'):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.prepare()

    def end(self, moment, signals):
        """Ends a run after a time, or as soon as it has begun a file, and looks at what it leaves."""
        process, begin = self.start(), time.monotonic()
        while process.poll() is None:
            time.sleep(0.0005)
            if moment is None and self.unfinished():
                break
            if moment is not None and time.monotonic() - begin >= moment:
                break
        for number in signals:
            process.send_signal(number)
        code = process.wait(timeout=60)
        number = signals[0]
        # It may have been done before, or not yet have been asked to look at signals.
        assert code in (0, -number) or (number != KILL and code == 128 + number), (self.name, code, signals)
        for name, content in self.files().items():
            assert self.is_whole(name, content), (self.name, name, len(content), moment, signals)
        left = self.unfinished()
        if number == KILL:
            self.killed_in_the_middle += len(left) > 0
        else:
            assert not left, (self.name, left, moment, signals)

    def test(self):
        self.prepare()
        took = self.run()
        self.whole = self.files()
        for k in range(self.moments):
            if k % 2:
                self.clear()
            moment = None if k % 3 == 0 else chance.uniform(0, took)
            self.end(moment, SIGNALS[k % 8])
            if self.unfinished():
                self.run()
                assert self.files() == self.whole, self.name
        self.run()
        assert self.files() == self.whole, self.name
        print(f'{self.name}: {self.moments} moments, {self.killed_in_the_middle} kills left something')
        return self.killed_in_the_middle

class Report(Case):
    """Its numbers are measured, and a whole run takes long: only its drawings are looked at, and not to the end."""
    def is_whole(self, name, content):
        return name.endswith('.svg') and content.startswith(b'<?xml') and content.rstrip().endswith(b'</svg>')

    def test(self):
        for k in range(self.moments):
            self.end(None if k % 3 == 0 else chance.uniform(0, 2), SIGNALS[k % 8])
            if self.unfinished():
                self.end(3, [TERM])
        assert self.files(), self.name
        print(f'{self.name}: {self.moments} moments, {self.killed_in_the_middle} kills left something')
        return self.killed_in_the_middle

subprocess.run([DOMEFALL, 'stars', 'import', 'csv', STARS, '--faintest', '6', '--out', 'few.stars'], check=True,
               stderr=subprocess.DEVNULL)
cases = [
    Case('states', 11, 'states', 'tiny.yaml', '--plot', 'OUT/plot.svg'),
    Case('stars', 11, 'stars', 'import', 'csv', STARS, '--out', 'OUT/many.stars'),
    Case('sky_build', 13, 'sky', 'build', '--stars', 'few.stars', '--fainter-than', '5', '--blur', '3', '--size',
         '64', '--out', 'OUT/starlight.sky'),
    Case('sky_import', 13, 'sky', 'import', 'panorama.png', '--size', '128', '--stars', 'few.stars', '--out',
         'OUT/panorama.sky'),
    Case('preview', 11, 'preview', 'tiny.yaml', '--frame', '3', '--size', '160x90', '--out', 'OUT/still.jpg'),
    Case('render', 13, 'render', 'tiny.yaml', '--frames', '0-4', '--out', 'OUT'),
    Case('grade', 11, 'grade', 'tiff8/tiny.yaml', '--frames', '0-4', '--out', 'OUT'),
    Case('check', 9, 'check', 'tiny.yaml'),
    Report('report', 8, 'report', '--quick', '--figures', '--out', 'OUT'),
]
grade = cases[-3]
grade.prepare = lambda: shutil.copytree('render/linear', grade.out / 'linear')
assert sum(case.moments for case in cases) == 100
middle = [case.test() for case in cases]
# Most of the time nothing is being written; a third of the kills wait until something is.
assert sum(count > 0 for count in middle) >= 4, 'too few kills came in the middle of a file'
END
python3 killed_writers.py || fail "see above"

# What nohup protects from a terminal that is closed goes on, and so does what a script protects from its
# interruption.
for ignored in HUP INT TERM; do
  (
    trap '' $ignored
    exec "$DOMEFALL" render tiny.yaml --frames 0-9 --out protected$ignored 2>stderr
  ) &
  until [ -e protected$ignored/linear ]; do kill -0 $! || fail "$(cat stderr)"; done
  kill -$ignored $!
  wait $! || fail "a program that is to ignore $ignored does not: $(cat stderr)"
  says '^10 frames made'
done
