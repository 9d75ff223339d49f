#!/usr/bin/env bash
# The program and the libraries that it loads are hardened against input that overruns a buffer, and
# look for libraries in no folder that somebody else may have filled.
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
  has "$file" --dyn-syms 'UND __stack_chk_fail' 'protected stack'
done
has "$DOMEFALL" --dyn-syms 'UND __[a-z_]+_chk@' 'checked lengths'

cmake --install "$build" --prefix "$folder/installed" >/dev/null
mapfile -t installed < <(find "$folder/installed" -name 'libdomefall_*.so' -o -name 'domefall*.so')
((${#installed[@]} >= ${#libraries[@]})) || fail "less is installed than built: ${installed[*]}"
# An empty element is the folder in which the program is started, and so is one that is relative.
for file in "$DOMEFALL" "${libraries[@]}" installed/bin/domefall "${installed[@]}"; do
  readelf -W --dynamic "$file" >dynamic || fail "$file is not read"
  while IFS= read -r element; do
    [[ $element =~ ^(/|\$ORIGIN(/|$)) ]] || fail "$file looks for libraries in '$element'"
  done < <(sed -nE 's/.*\((RPATH|RUNPATH)\).*\[(.*)\]$/\2/p' dynamic | tr ':' '\n')
done

# So that what lies beside a show under the name of a library is not even opened.
mkdir planted
for file in "$DOMEFALL" "${libraries[@]}"; do
  readelf -W --dynamic "$file" | sed -nE 's/.*\(NEEDED\).*\[(.*)\]$/\1/p'
done | grep -v '^ld-' | sort -u | (cd planted && xargs touch libdomefall_openimageio.so)
[ -e planted/libisal.so.2 ] || fail "what was planted is not what the program needs: $(ls planted)"
write_show show.yaml
printf '%s\n' 'title: no picture' >planted/panorama.png
cd planted
for program in "$DOMEFALL" "$folder/installed/bin/domefall"; do
  exits 0 "$program" check ../show.yaml
  exits 2 "$program" sky import panorama.png --size 32 --out made.sky
done
[ -z "${DOMEFALL_PYTHON:-}" ] || exits 0 env PYTHONPATH="$build/python" "$DOMEFALL_PYTHON" -c 'import domefall'
