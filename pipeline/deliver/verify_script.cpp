#include <fmt/format.h>

#include <string>

#include "pipeline/deliver/delivery.h"

namespace domefall {

std::string verify_script(std::size_t files) {
  // clang-format off
  return R"sh(#!/bin/sh
# Says whether this folder holds what was delivered, by the SHA-256 sums in checksums.sha256.
# It ends with 0 if it does, with 1 if a file is missing, changed or not of the delivery, and with 2
# if that cannot be told.  Hidden files, which file managers leave behind, do not matter.
files=)sh" + fmt::to_string(files) + R"sh(
cd "$(dirname "$0")" || exit 2
if [ -e INCOMPLETE.txt ] || [ ! -f checksums.sha256 ]; then
  echo "This delivery was never finished, or checksums.sha256 is gone."
  exit 1
fi
if command -v sha256sum >/dev/null 2>&1; then
  sums() { sha256sum -c checksums.sha256; }
elif command -v shasum >/dev/null 2>&1; then
  sums() { shasum -a 256 -c checksums.sha256; }
else
  echo "Neither sha256sum nor shasum is installed."
  exit 2
fi
faults() {
  listed=$(awk '!(substr($0, 67) in path) { path[substr($0, 67)] = 1; n++ } END { print n + 0 }' \
    checksums.sha256)
  [ "$listed" -eq "$files" ] || echo "checksums.sha256 lists $listed files instead of $files."
  said=$(sums 2>/dev/null)
  printf '%s\n' "$said" |
    sed -n -e 's/^\(.*\): FAILED$/changed: \1/p' -e 's/^\(.*\): FAILED open or read$/missing: \1/p'
  # What says nothing of a file, as a line that is no sum, is as good as a fault.
  right=$(printf '%s\n' "$said" | grep -c ': OK$')
  [ "$right" -eq "$files" ] || echo "Of $files files $right have the sums that were listed."
  find . -type l ! -path '*/.*' | sed 's|^\./|a link and no file: |'
  find . ! -type d ! -path '*/.*' | sed 's|^\./||' |
    awk 'FNR == NR { listed[substr($0, 67)] = 1; next }
         $0 != "checksums.sha256" && !($0 in listed) { print "not of this delivery: " $0 }' \
      checksums.sha256 -
}
LC_ALL=C
export LC_ALL
found=$(faults)
if [ -n "$found" ]; then
  printf '%s\n' "$found"
  exit 1
fi
echo "All $files files are there, and as they were delivered."
)sh";
  // clang-format on
}

}  // namespace domefall
