"""What the launchers share: the program, the frames of a show, and which of them are on disk.

Everything they know about a show they ask `domefall`; nothing is read from the YAML here.
Needs Python 3.9 and nothing beyond its standard library.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

# The exit codes of domefall and of the launchers.
DONE, FAILURE, BAD_INPUT, TRY_AGAIN = 0, 1, 2, 75


def say(message):
    print(message, file=sys.stderr, flush=True)


def stop(message, code):
    say(message)
    sys.exit(code)


def find_domefall():
    """The absolute path of the program: $DOMEFALL, else the one that these launchers were installed
    with, else the first one on the PATH."""
    here = pathlib.Path(__file__).resolve().parent
    with_us = here.parents[1] / "bin" / "domefall"
    is_installed = here.parent.name == "libexec" and with_us.exists()
    name = os.environ.get("DOMEFALL") or (str(with_us) if is_installed else "domefall")
    found = shutil.which(name)
    if not found:
        stop(f"{name}: no such program; put domefall on the PATH or name it in DOMEFALL", BAD_INPUT)
    return os.path.abspath(found)


def run(domefall, *arguments, if_refused=BAD_INPUT):
    """What a verb of domefall prints, and what it says; if it fails, this program ends with its
    message and code, or with `if_refused` in the place of 2."""
    try:
        answer = subprocess.run([domefall, *arguments], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, check=False)
    except OSError as error:
        stop(f"domefall cannot be started: {error}", TRY_AGAIN)
    if answer.returncode != 0:
        code = answer.returncode if answer.returncode > 0 else TRY_AGAIN
        code = if_refused if code == BAD_INPUT else code
        stop((answer.stderr or answer.stdout).rstrip(), code)
    return answer.stdout, answer.stderr


def ask(domefall, *arguments):
    return run(domefall, *arguments)[0]


def still_to_make(domefall, show, frames, out, options, if_refused=BAD_INPUT):
    """The frames, of those that `frames` names, that a run with these options would make, by what the
    beginnings of their files say. Passes on what domefall says of the folder, such as how many
    frames an edit of the show costs. If the run would be refused, this program ends with
    `if_refused`: 2, or 75 where the show was good before and may be so again."""
    ranges, talk = run(domefall, "render", show, "--out", out, "--dry-run", *options,
                       *(["--frames", frames] if frames else []), if_refused=if_refused)
    if talk:
        say(talk.rstrip())
    return from_ranges(ranges.strip())


def frames_of(domefall, show, frames):
    """Checks the show with its assets and lists the numbers of the frames that `frames` names
    (as in `domefall render --frames`; empty: all)."""
    ask(domefall, "check", show)
    table = ask(domefall, "states", show, *(["--frames", frames] if frames else []))
    first_column = (line.split(",", 1)[0] for line in table.splitlines())
    return [int(cell) for cell in first_column if cell.isdigit()]


def make_folder(path):
    """Makes a folder, and those above it, before anything is begun in it."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        never = isinstance(error, (NotADirectoryError, FileExistsError))
        stop(f"{path}: the folder cannot be made: {error.strerror}",
             BAD_INPUT if never else TRY_AGAIN)


def as_ranges(frames):
    """Sorted numbers as domefall writes them: 0-9,12."""
    ranges = []
    for number in frames:
        if ranges and ranges[-1][1] == number - 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in ranges)


def from_ranges(text):
    """The numbers that as_ranges wrote."""
    numbers = []
    for part in filter(None, text.split(",")):
        first, _, last = part.partition("-")
        numbers += range(int(first), int(last or first) + 1)
    return numbers


def chunks_of(frames, size):
    return [frames[k:k + size] for k in range(0, len(frames), size)]


def frames_without_file(show, out, frames):
    """The frames that lack their linear file, or their graded one where the show is graded. Says
    nothing about what is in the files: domefall itself looks into them when it is run again."""
    record = pathlib.Path(out) / (pathlib.Path(show).stem + ".json")
    try:
        facts = json.loads(record.read_text(encoding="utf-8"))
        kinds = [kind for kind in ("linear", "graded") if facts[kind]]
        name, start, digits = facts["name"], facts["start"], facts["digits"]
    except (OSError, ValueError, TypeError, KeyError):
        return list(frames)  # the first frame that is made writes the record
    there = [{path.name for path in (pathlib.Path(out) / kind).rglob(f"*.{facts[kind]}")}
             for kind in kinds]
    return [n for n in frames
            if not all(f"{name}_{start + n:0{digits}d}.{facts[kind]}" in names
                       for kind, names in zip(kinds, there))]
