#include "farm/conclusion_note.h"

#include <algorithm>

#include "farm/work_summary.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

fs::path note_file(const fs::path& out, const std::string& plan_id) {
  return farm_folder(out) / ("conclusion_" + plan_id + ".txt");
}

}  // namespace

void note_conclusion(const FarmPlan& plan, const std::string& text, const fs::path& log) {
  const fs::path file = note_file(plan.out, plan.id);
  if (text.empty()) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw_file_error(file, error.value());
    return;
  }
  std::string line = text;
  std::ranges::replace(line, '\n', ' ');
  write_atomically(file, line + "\n" + log.string());
}

std::string conclusion_of(const fs::path& out, const std::string& plan_id) {
  const fs::path file = note_file(out, plan_id);
  constexpr std::uint64_t kMostBytes = 1 << 20;
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  try {
    const std::string text = read_file(file, kMostBytes);
    const std::size_t end = std::min(text.find('\n'), text.size());
    const fs::path log = end < text.size() ? text.substr(end + 1) : std::string();
    std::string note = text.substr(0, end);
    if (log.empty()) return note;
    // A job that failed says last what it has noted, which is not told twice.
    const std::string said = last_line_of(log);
    return note + "; " + log.string() + (note.ends_with(said) ? "" : ": " + said);
  } catch (const TemporaryError&) {
    // The work has ended meanwhile, and its note is gone.
    if (!fs::exists(file, error)) return {};
    throw;
  }
}

}  // namespace domefall
