# What the scripts about `domefall trace` share.
# shellcheck source=tests/cli/common.bash
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

# right EXACT SAME COLUMN=LIMIT...: of the answer in stdout the columns SAME (joined by commas) are those of the
# exact rays, and the others right to a part of the exact number or, where the limit ends in ~, to an absolute
# error if that number is below 1.
right() {
  python3 - "$folder/stdout" "$@" <<'END'
import csv, sys
def rows(path):
    return list(csv.DictReader(line for line in open(path) if not line.startswith('#')))
answer, exact = rows(sys.argv[1]), rows(sys.argv[2])
assert len(exact) == len(answer) > 150, (len(exact), len(answer))
worst = {}
for e, a in zip(exact, answer):
    assert all(e[key] == a[key] for key in sys.argv[3].split(',')), (e, a)
    for column, limit in (argument.split('=') for argument in sys.argv[4:]):
        # After a million turns the sine of the azimuth has lost its digits.
        if not e[column] or column == 'amplification' and float(e.get('azimuth') or 0) > 1e6:
            continue
        value = float(e[column])
        error = abs(float(a[column]) - value) / max(abs(value), limit.endswith('~'))
        worst[column] = max(worst.get(column, 0), error)
        assert error < float(limit.rstrip('~')), (column, error, e, a)
print(len(exact), 'rays, worst errors', worst)
END
}

# row CELLS: writes a table of one ray, with the columns $columns.
row() { printf '%s\n' "${columns:?}" "$1" >row.csv; }
# refused CELLS WORDS: trace refuses such a ray.
refused() {
  row "$1"
  exits 2 "$DOMEFALL" trace --table row.csv
  says "row.csv:2: $2"
}
