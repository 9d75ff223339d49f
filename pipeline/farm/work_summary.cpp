#include "pipeline/farm/work_summary.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <set>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr double kWindow = 600;                // seconds
constexpr std::uint64_t kMostOfLog = 1 << 14;  // bytes, in which its last line is sought

// The last number in a name; nothing if there is none.
std::optional<int> last_number(const std::string& stem) {
  const auto end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const auto before = stem.find_last_not_of("0123456789", end);
  const auto begin = before == std::string::npos ? 0 : before + 1;
  int number = 0;
  const auto result = std::from_chars(stem.data() + begin, stem.data() + end + 1, number);
  return result.ec == std::errc() ? std::optional(number) : std::nullopt;
}

// The log that was written last, by task.
std::map<int, fs::path> logs_in(const fs::path& folder) {
  std::map<int, std::pair<fs::file_time_type, fs::path>> newest;
  std::error_code error;  // a folder that is not there has none
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto task = last_number(entry->path().stem().string());
    std::error_code ignored;
    const auto time = entry->last_write_time(ignored);
    if (!task || ignored) continue;
    const auto [found, is_new] = newest.try_emplace(*task, time, entry->path());
    if (!is_new && found->second.first < time) found->second = {time, entry->path()};
  }
  std::map<int, fs::path> logs;
  for (const auto& [task, log] : newest) logs[task] = log.second;
  return logs;
}

// Its last line that is not empty, without what a terminal would do with it.
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

}  // namespace

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

std::vector<SlowFrame> slowest_frames(const Manifest& manifest, std::size_t most) {
  std::map<int, const MadeFile*> last;
  for (const auto& [file, lines] : manifest.files)
    for (const MadeFile& made : lines) {
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

std::vector<FailedChunk> failed_chunks(const std::vector<FarmChunk>& chunks,
                                       const std::vector<int>& lacking, const Manifest& manifest,
                                       const fs::path& frames) {
  std::set<int> being_made;
  for (const FrameWriter& writer : manifest.writers)
    for (const auto& [frame, since] : writer.being_made) being_made.insert(frame);
  const std::map<int, fs::path> logs = logs_in(farm_folder(frames) / "log");
  std::vector<FailedChunk> failed;
  for (const FarmChunk& chunk : chunks) {
    const auto log = logs.find(chunk.task);
    if (log == logs.end() ||
        std::ranges::any_of(chunk.frames, [&](int frame) { return being_made.contains(frame); }))
      continue;
    std::vector<int> lacks;
    std::ranges::set_intersection(chunk.frames, lacking, std::back_inserter(lacks));
    if (!lacks.empty())
      failed.push_back({chunk.task, std::move(lacks), log->second, last_line_of(log->second)});
  }
  return failed;
}

}  // namespace domefall
