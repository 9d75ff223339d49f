#include "pipeline/show/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "pipeline/image/errors.h"
#include "pipeline/image/utf8.h"

namespace domefall {
namespace {

constexpr std::size_t kMostListed = 100;

}  // namespace

Problems::Problems(std::string file, std::string text) : file_(std::move(file)) {
  // The text is split into lines once, since each message needs the one that it is about.
  std::istringstream in(std::move(text));
  for (std::string line; std::getline(in, line);) lines_.push_back(std::move(line));
  // Even an empty text has the place of its beginning.
  if (lines_.empty()) lines_.emplace_back();
}

void Problems::add(TextPlace at, const std::string& what) {
  problems_.push_back({at, what});
  mistaken_ = true;
}

void Problems::add_missing_file(TextPlace at, const std::string& what) {
  problems_.push_back({at, what});
}

std::string Problems::place(TextPlace at) const {
  // yaml-cpp reports what is missing at the end of the file at a place beyond the last line.
  const bool at_end = at.line >= static_cast<int>(lines_.size());
  const std::size_t line = at_end ? lines_.size() - 1 : static_cast<std::size_t>(at.line);
  const std::size_t bytes = at_end ? lines_[line].size() : static_cast<std::size_t>(at.column);
  const std::string before = lines_[line].substr(0, bytes);
  // Editors count characters, so that only the first byte of each counts.
  const auto column =
      before.size() - static_cast<std::size_t>(std::ranges::count_if(before, continues_character));
  return fmt::format("{}:{}:{}: ", file_, line + 1, column + 1);
}

void Problems::raise() const {
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  // Problems of one place stay in the order in which they were found.
  std::ranges::stable_sort(sorted, [](const Problem& a, const Problem& b) {
    return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
  });
  std::string message;
  // Each problem is a line of one exception, which the program writes as it is.
  for (std::size_t k = 0; k < std::min(sorted.size(), kMostListed); ++k)
    message.append(k > 0 ? "\n" : "").append(place(sorted[k].at)).append(sorted[k].what);
  if (sorted.size() > kMostListed)
    message += fmt::format("\n{}: and {} more", file_, sorted.size() - kMostListed);
  // Files that are missing here may be there on another machine, where the same show can succeed.
  // One mistake among them fails everywhere.
  if (!mistaken_) throw TemporaryError(message);
  throw InputError(message);
}

std::string shown(std::string_view text) {
  std::string out;
  int characters = 0;
  for (const char c : text) {
    // A character is counted at its first byte, so that none is cut in two.
    if (!continues_character(c) && ++characters > 40) return out + "...";
    out.push_back(static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c);
  }
  return out;
}

}  // namespace domefall
