#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <future>
#include <nlohmann/json.hpp>

#include "farm/verbs.h"
#include "pipeline/base/utf8.h"
#include "pipeline/image/frame_list.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSlow = 3, kMostShown = 8;

// Writes hours, minutes and seconds, as in 1:02:03.
std::string short_duration(double seconds) {
  const auto s = std::lround(std::max(seconds, 0.0));
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string clock_of(double since_1970_s) {
  const auto time = static_cast<std::time_t>(since_1970_s);
  std::tm local{};
  return localtime_r(&time, &local) ? fmt::format("{:%F %T}", local)
                                    : std::string("an unknown time");
}

std::optional<double> seconds_left(const FarmStatus& status) {
  const auto rate = status.frames_per_second;
  if (!rate) return std::nullopt;
  return static_cast<double>(status.found.to_make().size()) / *rate;
}

void add_writers(std::string& page, const FarmStatus& status) {
  std::size_t shown = 0, more = 0;
  for (const FrameWriter& writer : status.manifest.writers)
    for (const auto& [frame, since] : writer.being_made) {
      if (++shown > kMostShown && ++more) continue;
      page += fmt::format("  {:<12} {} by {}, process {}, since {} ({})\n", "being made", frame,
                          writer.host, writer.pid, clock_of(since),
                          short_duration(status.now_s - since));
    }
  if (more > 0) page += fmt::format("  {:<12} {} more\n", "being made", more);
}

void add_failed(std::string& page, const FarmStatus& status) {
  for (const FailedChunk& chunk : status.failed)
    page += fmt::format("  round {}, task {} lacks {}; {}: {}\n", chunk.round, chunk.task,
                        as_ranges(chunk.lacking), chunk.log.string(), chunk.last_line);
}

}  // namespace

FarmStatus farm_status(const FarmFrames& frames, int threads) {
  FarmStatus status;
  const std::filesystem::path& folder = frames.folder().path();
  // Keys, names and manifests take about as long as each other and do not depend on one another, so
  // they are looked at side by side.
  auto manifest = std::async(std::launch::async, [&] { return read_manifest(folder, threads); });
  auto foreign = std::async(std::launch::async, [&] { return frames.folder().foreign_files(); });
  const std::vector<ExpectedFile> files = frames.files();
  status.manifest = manifest.get();
  status.found = sum_up(files, look_at_files(files, threads, [&](const ExpectedFile& file) {
                          return glance_at(file, status.manifest);
                        }));
  status.foreign = with_others(foreign.get(), status.found);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  status.now_s = std::chrono::duration<double>(now).count();
  status.frames_per_second = frames_per_second(status.manifest, status.now_s);
  status.slowest = slowest_frames(status.manifest, frames.frames(), kMostSlow);
  status.failed = failed_chunks(frames.tasks(), status.found.to_make(), status.manifest, folder);
  status.conclusion = frames.conclusion();
  return status;
}

bool is_complete(const FarmStatus& status) {
  return status.found.to_make().empty() && status.found.of(FrameCondition::kUnreadable).empty();
}

std::string farm_page(const FarmFrames& frames, const FarmStatus& status) {
  const FolderFindings& found = status.found;
  const std::size_t all = frames.frames().size();
  std::string page =
      fmt::format("{}: {} of {} frames are done ({:.1f} %)\n", frames.folder().path().string(),
                  found.good().size(), all,
                  100.0 * static_cast<double>(found.good().size()) / static_cast<double>(all));
  for (const BadFrames& bad : kBadFrames)
    if (const auto& list = found.of(bad.condition); !list.empty())
      page += fmt::format("  {:<12} {}: {}\n", bad.word, list.size(), as_ranges(list));
  page += describe_work(found, frames.show()) + describe_foreign(status.foreign, frames.folder());
  add_writers(page, status);
  if (status.frames_per_second)
    page += fmt::format("  {:<12} {:.3g} frames/s, {} left\n", "rate", *status.frames_per_second,
                        short_duration(*seconds_left(status)));
  for (const SlowFrame& slow : status.slowest)
    page += fmt::format("  {:<12} {} took {:.1f} s on {}\n", "slow", slow.frame, slow.seconds,
                        slow.host);
  add_failed(page, status);
  if (!status.conclusion.empty()) page += "  " + status.conclusion + "\n";
  return printable_lines(page);  // logs and names may hold anything
}

std::string farm_json(const FarmFrames& frames, const FarmStatus& status, int indent) {
  const FolderFindings& found = status.found;
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json json = {{"title", frames.show().title},
               {"folder", frames.folder().path().string()},
               {"frames", frames.frames().size()},
               {"done", found.good().size()}};
  add_bad_frames(json, found);
  json.update({{"invalidated", Json::array()},
               {"foreign", status.foreign},
               {"being_made", Json::array()},
               {"frames_per_second", number(status.frames_per_second)},
               {"seconds_left", number(seconds_left(status))},
               {"slowest", Json::array()},
               {"failed_chunks", Json::array()},
               {"conclusion", status.conclusion},
               {"to_make", as_ranges(found.to_make())}});
  const auto add_segments = [&](const std::vector<int>& older, const char* work) {
    for (const auto& [segment, count] : by_segment(older, frames.show()))
      json["invalidated"].push_back({{"segment", segment + 1}, {"frames", count}, {"work", work}});
  };
  add_segments(found.older_linear, "render");
  add_segments(found.older_graded, "grade");
  for (const FrameWriter& writer : status.manifest.writers)
    for (const auto& [frame, since] : writer.being_made)
      json["being_made"].push_back({{"frame", frame},
                                    {"host", writer.host},
                                    {"pid", writer.pid},
                                    {"since_s", since},
                                    {"last_sign_s", writer.last_sign_s}});
  for (const SlowFrame& slow : status.slowest)
    json["slowest"].push_back(
        {{"frame", slow.frame}, {"seconds", slow.seconds}, {"host", slow.host}});
  for (const FailedChunk& chunk : status.failed)
    json["failed_chunks"].push_back({{"round", chunk.round},
                                     {"task", chunk.task},
                                     {"frames", as_ranges(chunk.lacking)},
                                     {"log", chunk.log.string()},
                                     {"last_line", chunk.last_line}});
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace domefall
