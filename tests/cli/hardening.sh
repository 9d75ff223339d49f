#!/usr/bin/env bash
# The program and the libraries that it loads are hardened against input that overruns a buffer.
# shellcheck source=tests/cli/common.bash
source "$(dirname "$0")/common.bash"
command -v readelf >/dev/null || exit 77
build=$(dirname "$DOMEFALL")
libraries=("$build"/lib/libdomefall_*.so)
[ -z "${DOMEFALL_PYTHON:-}" ] || libraries+=("$build"/python/domefall.*.so)

# has FILE OPTION PATTERN WHAT: readelf says so of the file.
has() { readelf -W "$2" "$1" | grep -E -- "$3" >/dev/null || fail "$1 has no $4"; }

has "$DOMEFALL" --file-header 'Type: +DYN' 'position that is chosen when it starts'
has "$DOMEFALL" --dynamic 'FLAGS_1.*PIE' 'position that is chosen when it starts'
for file in "$DOMEFALL" "${libraries[@]}"; do
  has "$file" --program-headers 'GNU_RELRO' 'read-only relocations'
  has "$file" --dynamic '(FLAGS_1.*NOW|BIND_NOW)' 'binding at the start'
  has "$file" --program-headers 'GNU_STACK .* RW +0x' 'stack that cannot be executed'
  # A library without arrays has nothing to protect on its stack.
  [[ $file == */libdomefall_libtiff_file.so ]] ||
    has "$file" --dyn-syms 'UND __stack_chk_fail' 'protected stack'
done
has "$DOMEFALL" --dyn-syms 'UND __[a-z_]+_chk@' 'checked lengths'
