#include <fmt/format.h>

#include <string>
#include <string_view>

#include "pipeline/theatre/delivery/delivery.h"
#include "pipeline/theatre/delivery/folder_files.h"

namespace domefall {
namespace {

// Returns a text of awk, without its quotes.
std::string awk_text(std::string_view text) {
  std::string spelt;
  for (const char c : text)
    spelt += (c >= ' ' && c <= '~') ? std::string(1, c)
                                    : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  return spelt;
}

// Returns the names between slashes.
std::string names_left_behind() {
  std::string names = "/";
  for (const std::string_view name : kLeftBehind) names += awk_text(name) + "/";
  return names;
}

// Returns a regular expression of awk.
std::string ends_left_behind() {
  std::string ends;
  for (const std::string_view end : kLeftBehindEnds) {
    ends += ends.empty() ? "(" : "|";
    for (const char c : end) ends += c == '.' ? "[.]" : std::string(1, c);
  }
  return ends + ")$";
}

// The script, around the number of files, the ends and the names that are left behind.
// clang-format off
constexpr std::string_view kBeforeCount = R"sh(#!/bin/sh
# Says whether this folder holds what was delivered, by the SHA-256 sums in checksums.sha256.
# It ends with 0 if it does, with 1 if a file is missing, changed or not of the delivery, and with 2
# if that cannot be told.  What systems and file managers leave behind is listed, and is no fault.
files=)sh";
constexpr std::string_view kBehindCount = R"sh(
# The caller's environment has no say in which folder is read, nor in what a letter is.
unset CDPATH
LC_ALL=C
export LC_ALL
case $0 in
  /*) here=${0%/*}/ ;;
  */*) here=./${0%/*} ;;
  *) here=. ;;
esac
cd -P -- "$here" || exit 2
if [ -e INCOMPLETE.txt ] || [ ! -f checksums.sha256 ]; then
  echo "This delivery was never finished, or checksums.sha256 is gone."
  exit 1
fi
if command -v sha256sum >/dev/null 2>&1; then
  sums() { sha256sum -c -; }
elif command -v shasum >/dev/null 2>&1; then
  sums() { shasum -a 256 -c -; }
else
  echo "Neither sha256sum nor shasum is installed."
  exit 2
fi
line_end='
'
# Only files are read, since a pipe or a device in the place of one may never end.
lines_of_files() {
  while IFS= read -r line; do
    [ ! -f "./${line#*  }" ] || printf '%s\n' "$line"
  done <checksums.sha256
}
lines_without_files() {
  while IFS= read -r line; do
    path=./${line#*  }
    if [ -f "$path" ]; then
      continue
    elif [ -e "$path" ] || [ -L "$path" ]; then
      printf 'no file: %s\n' "${path#./}"
    else
      printf 'missing: %s\n' "${path#./}"
    fi
  done <checksums.sha256
}
# The files on the list are passed over, and each of the others is told after a word of its kind.
others() {
  {
    find . -type l ! -path "*$line_end*" | sed 's|^\./|link |'
    find . ! -type d ! -type l ! -path "*$line_end*" | sed 's|^\./|file |'
  } 2>/dev/null | awk '
    function left_behind(path, parts, count, k, name, until) {
      count = split(path, parts, "/")
      until = ""
      for (k = 1; k <= count; k++) {
        name = tolower(parts[k])
        until = until parts[k]
        if (name ~ /^[.]/ || index(names, "/" name "/") || name ~ /)sh";
constexpr std::string_view kBehindEnds = R"sh(/)
          return until (k < count ? "/" : "")
        until = until "/"
      }
      return ""
    }
    BEGIN { names = ")sh";
constexpr std::string_view kBehindNames = R"sh(" }
    FNR == NR { listed[substr($0, 67)] = 1; next }
    {
      path = substr($0, 6)
      left = left_behind(path)
      if (left != "") { if (!(left in told)) print "left " left; told[left] = 1 }
      else if (/^link /) print "link " path
      else if (path != "checksums.sha256" && !(path in listed)) print "file " path
    }' checksums.sha256 -
}
faults() {
  listed=$(awk '!(substr($0, 67) in path) { path[substr($0, 67)] = 1; n++ } END { print n + 0 }' \
    checksums.sha256)
  [ "$listed" -eq "$files" ] || echo "checksums.sha256 lists $listed files instead of $files."
  awk 'substr($0, 67) ~ /^\/|(^|\/)[.][.](\/|$)/ { print "not of this folder: " substr($0, 67) }' \
    checksums.sha256
  lines_without_files
  said=$(lines_of_files | sums 2>/dev/null)
  printf '%s\n' "$said" | sed -n -e 's/^\(.*\): FAILED$/changed: \1/p' \
    -e 's/^\(.*\): FAILED open or read$/cannot be read: \1/p'
  # What says nothing of a file, as a line that is no sum, is as good as a fault.
  right=$(printf '%s\n' "$said" | grep -c ': OK$')
  [ "$right" -eq "$files" ] || echo "Of $files files $right have the sums that were listed."
  find . -name '.?*' -prune -o -path "*$line_end*" -prune -exec echo "A name has the end of a line in it." \;
  printf '%s\n' "$others" | sed -n -e 's/^link /a link and no file: /p' \
    -e 's/^file /not of this delivery: /p'
}
# A name may hold what would steer a terminal.
show() {
  printf '%s\n' "$1" | tr '\001-\010\013-\037\177' '?' |
    sed "$(printf 's/\302[\200-\237]/?/g;s/\342\200[\250-\256]/?/g;s/\342\201[\246-\251]/?/g')"
}
others=$(others)
left=$(printf '%s\n' "$others" | sed -n 's/^left /left by a system or a file manager: /p')
[ -z "$left" ] || show "$left"
found=$(faults)
if [ -n "$found" ]; then
  show "$found"
  exit 1
fi
echo "All $files files are there, and as they were delivered."
)sh";
// clang-format on

}  // namespace

std::string verify_script(std::size_t files) {
  return fmt::format("{}{}{}{}{}{}{}", kBeforeCount, files, kBehindCount, ends_left_behind(),
                     kBehindEnds, names_left_behind(), kBehindNames);
}

}  // namespace domefall
