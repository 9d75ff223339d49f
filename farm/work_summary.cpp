#include "farm/work_summary.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr double kWindow = 600;                // seconds
constexpr std::uint64_t kMostOfLog = 1 << 14;  // bytes, in which its last line is sought

struct FoundLog {
  std::string stem;
  fs::path path;
  fs::file_time_type written;
};

std::vector<FoundLog> logs_in(const fs::path& folder) {
  std::vector<FoundLog> logs;
  std::error_code error;  // a folder that is not there has none
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const auto written = entry->last_write_time(ignored);
    if (!ignored) logs.push_back({entry->path().stem().string(), entry->path(), written});
  }
  std::ranges::sort(logs,
                    [](const FoundLog& a, const FoundLog& b) { return a.written > b.written; });
  return logs;
}

// Returns the task's log that was written last, or an empty path if there is none.
fs::path log_of(const TaskFrames& task, const std::vector<FoundLog>& newest_first) {
  for (const FoundLog& log : newest_first)
    if (std::ranges::any_of(task.logs,
                            [&](const std::string& end) { return log.stem.ends_with(end); }))
      return log.path;
  return {};
}

// Returns what stands for the last line of an empty log, or nothing where the task may just have
// begun.
std::string line_of_empty(const fs::path& log) {
  constexpr std::uintmax_t kFull = 1 << 16;  // bytes that are left
  constexpr std::chrono::seconds kBeginning(10);
  std::error_code error;
  if (fs::space(log, error).available < kFull && !error)
    return "the log is empty: the disk is full";
  const auto written = fs::last_write_time(log, error);
  if (!error && fs::file_time_type::clock::now() - written < kBeginning) return {};
  return "the log is empty";
}

bool tells_of_success(const std::string& last_line) {
  return last_line.find(" frames made, ") != std::string::npos &&
         last_line.find(" already there, in ") != std::string::npos;
}

}  // namespace

std::string last_line_of(const fs::path& log) {
  std::string text;
  try {
    const RegularFile file(log);
    const std::uint64_t begin = file.size() - std::min(file.size(), kMostOfLog);
    text.resize(file.size() - begin);
    text.resize(read_at(file.descriptor(), log, begin, text.data(), text.size()));
  } catch (const InputError& error) {
    return error.what();
  } catch (const TemporaryError& error) {
    return error.what();
  }
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const auto before = text.find_last_of("\r\n", end);
  std::string line = text.substr(before == std::string::npos ? 0 : before + 1);
  line.resize(line.find_last_not_of(" \t\r\n") + 1);
  std::erase_if(line, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
  return line;
}

std::optional<double> frames_per_second(const Manifest& manifest, double now_s) {
  constexpr double kNanosecond = 1e-9;
  double first = now_s;
  std::size_t finished = 0;
  for (const FrameWriter& writer : manifest.writers) {
    if (writer.ended || writer.last_sign_s < now_s - kWindow) continue;
    if (writer.first_s > 0) first = std::min(first, writer.first_s);
    finished +=
        static_cast<std::size_t>(std::ranges::count_if(writer.finished, [&](std::int64_t at) {
          return static_cast<double>(at) * kNanosecond >= now_s - kWindow;
        }));
  }
  const double over = now_s - std::max(first, now_s - kWindow);
  if (finished == 0 || !(over > 0)) return std::nullopt;
  return static_cast<double>(finished) / over;
}

std::vector<SlowFrame> slowest_frames(const Manifest& manifest, const std::vector<int>& among,
                                      std::size_t most) {
  std::map<int, const MadeFile*> last;
  for (const auto& [file, lines] : manifest.files)
    for (const MadeFile& made : lines) {
      if (!std::ranges::binary_search(among, made.frame)) continue;
      const MadeFile*& known = last[made.frame];
      if (!known || known->mtime_ns < made.mtime_ns) known = &made;
    }
  std::vector<SlowFrame> frames;
  frames.reserve(last.size());
  for (const auto& [frame, made] : last) frames.push_back({frame, made->seconds, made->host});
  const auto middle = frames.begin() + static_cast<std::ptrdiff_t>(std::min(most, frames.size()));
  std::partial_sort(frames.begin(), middle, frames.end(),
                    [](const SlowFrame& a, const SlowFrame& b) {
                      return a.seconds != b.seconds ? a.seconds > b.seconds : a.frame < b.frame;
                    });
  frames.erase(middle, frames.end());
  return frames;
}

std::vector<FailedChunk> failed_chunks(const std::vector<TaskFrames>& tasks,
                                       const std::vector<int>& lacking, const Manifest& manifest,
                                       const fs::path& frames) {
  std::set<int> being_made, untold(lacking.begin(), lacking.end());
  for (const FrameWriter& writer : manifest.writers)
    for (const auto& [frame, since] : writer.being_made) being_made.insert(frame);
  const std::vector<FoundLog> logs = logs_in(frames / "farm" / "log");
  std::vector<FailedChunk> failed;
  for (std::size_t k = tasks.size(); k-- > 0;) {
    const TaskFrames& task = tasks[k];
    FailedChunk chunk{task.round, task.task, {}, {}, {}};
    for (const int frame : task.frames)
      if (untold.erase(frame) > 0) chunk.lacking.push_back(frame);
    const bool works =
        std::ranges::any_of(task.frames, [&](int frame) { return being_made.contains(frame); });
    if (chunk.lacking.empty() || works) continue;
    chunk.log = log_of(task, logs);
    if (chunk.log.empty()) continue;
    chunk.last_line = last_line_of(chunk.log);
    if (chunk.last_line.empty()) chunk.last_line = line_of_empty(chunk.log);
    if (chunk.last_line.empty() || tells_of_success(chunk.last_line)) continue;
    failed.push_back(std::move(chunk));
  }
  std::ranges::reverse(failed);
  return failed;
}

}  // namespace domefall
