#include "pipeline/theatre/delivery/frame_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

constexpr std::size_t kLongestName = 200;  // bytes; file systems take 255

}  // namespace

NamePattern parse_name_pattern(const std::string& text) {
  const auto fail = [&text](const std::string& what) {
    throw InputError(fmt::format("--name {}: {}; a name is like my_show_#####", text, what));
  };
  const auto begin = text.find('#');
  if (begin == std::string::npos) fail("no '#' says where the number goes");
  const auto end = std::min(text.find_first_not_of('#', begin), text.size());
  NamePattern pattern{text.substr(0, begin), text.substr(end), static_cast<int>(end - begin)};
  constexpr int kMostDigits = 10;
  if (pattern.digits > kMostDigits) fail("a number has at most 10 digits");
  for (const char c : pattern.before + pattern.after) {
    if (c == '#') fail("the number can stand in one place only");
    if (!is_plain(c)) fail("only letters a to z, digits, '.', '_' and '-' may be in it");
  }
  if (pattern.before.starts_with('.') || pattern.before.starts_with('-'))
    fail("it may not begin with '.' or '-'");
  if (pattern.after.find('.') != std::string::npos)
    fail("behind the number no '.' may stand, since the extension is added");
  if (text.size() > kLongestName)
    fail(fmt::format("it may have at most {} characters", kLongestName));
  return pattern;
}

NamePattern default_name_pattern(const std::string& name, int count) {
  constexpr int kLeastDigits = 5;
  std::string before = name.substr(0, kLongestName / 2);
  std::replace_if(
      before.begin(), before.end(), [](char c) { return !is_plain(c); }, '_');
  if (before.starts_with('.') || before.starts_with('-')) before[0] = '_';
  return {before + "_", "", std::max(kLeastDigits, static_cast<int>(fmt::to_string(count).size()))};
}

DeliveredNames::DeliveredNames(NamePattern pattern, int count, std::string extension)
    : pattern_(std::move(pattern)), count_(count), extension_(std::move(extension)) {
  const auto digits = static_cast<int>(fmt::to_string(count).size());
  if (digits > pattern_.digits)
    throw InputError(
        fmt::format("--name {}: {} frames need {} '#'", pattern_text(pattern_), count, digits));
}

std::filesystem::path DeliveredNames::path(int index) const {
  std::filesystem::path folder = "frames";
  if (count_ > kMostDeliveredInFolder) {
    const int first = index / kMostDeliveredInFolder * kMostDeliveredInFolder + 1;
    folder /= fmt::format("{}{:0{}d}_{:0{}d}{}", pattern_.before, first, pattern_.digits,
                          first + kMostDeliveredInFolder - 1, pattern_.digits, pattern_.after);
  }
  return folder / (name_of_number(pattern_, index + 1) + "." + extension_);
}

std::string name_of_number(const NamePattern& pattern, int number) {
  return fmt::format("{}{:0{}d}{}", pattern.before, number, pattern.digits, pattern.after);
}

std::string pattern_text(const NamePattern& pattern) {
  return pattern.before + std::string(static_cast<std::size_t>(pattern.digits), '#') +
         pattern.after;
}

}  // namespace domefall
