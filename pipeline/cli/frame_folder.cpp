#include "pipeline/cli/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/temporary_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kLinear = "linear", *kGraded = "graded";

// The first part of the path that is a link to nothing; empty if there is none.
fs::path dangling_link(const fs::path& path) {
  fs::path part;
  for (const fs::path& name : path) {
    part /= name;
    std::error_code ignored;
    if (fs::is_symlink(part, ignored) && !fs::exists(part, ignored)) return part;
  }
  return {};
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    const fs::path link = dangling_link(folder);
    const std::string why = error.value() == ELOOP || link.empty()
                                ? error.message()
                                : link.string() + " is a link that leads nowhere";
    const std::string what = folder.string() + ": the folder cannot be made: " + why;
    if (error.value() == ENOTDIR || error.value() == ENAMETOOLONG || error.value() == ELOOP)
      throw InputError(what);
    throw TemporaryError(what);
  }
  sweep_temporaries(folder);
}

// The number in NAME_00000.EXTENSION; nothing for other names.
std::optional<int> frame_number(const fs::path& file, const std::string& name) {
  const std::string stem = file.stem().string();
  if (!stem.starts_with(name + "_")) return std::nullopt;
  const char *begin = stem.data() + name.size() + 1, *end = stem.data() + stem.size();
  int number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stop != end || fmt::format("{}_{:05d}", name, number) != stem)
    return std::nullopt;
  return number;
}

void for_each_file(const fs::path& folder, const std::function<void(const fs::path&)>& use) {
  std::error_code error;  // a folder that cannot be read has none
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (!entry->path().filename().string().starts_with('.')) use(entry->path());
}

// Null for no record, and for one that cannot be understood.
Json read_record(const fs::path& path) {
  const auto file = FileBytes::open(path);
  if (!file || file->size() > FileBytes::kMost) return {};
  try {
    return Json::parse(file->at(0, file->size()), nullptr, false);
  } catch (const DamagedFile&) {  // another program has shortened it meanwhile
    return {};
  }
}

std::string text_of(const Json& record) {
  return fmt::format("'{}', {} of {} x {} pixels", record["title"].get<std::string>(),
                     record["projection"].get<std::string>(), record["width"].dump(),
                     record["height"].dump());
}

bool is_record(const Json& j) {
  return j.is_object() && j.contains("title") && j["title"].is_string() &&
         j.contains("projection") && j["projection"].is_string() && j.contains("width") &&
         j["width"].is_number_integer() && j.contains("height") && j["height"].is_number_integer();
}

}  // namespace

FrameFolder::FrameFolder(fs::path folder, const Show& show)
    : folder_(std::move(folder)), show_(show), name_(show.file.stem().string()) {}

fs::path FrameFolder::linear(int frame) const {
  return folder_ / kLinear / fmt::format("{}_{:05d}.exr", name_, frame);
}

fs::path FrameFolder::graded(int frame) const {
  const GradedFormat format = show_.output.graded.value_or(GradedFormat{});
  return folder_ / kGraded / fmt::format("{}_{:05d}.{}", name_, frame, extension_of(format.kind));
}

WantedFrame FrameFolder::wanted(std::string key) const {
  return {std::move(key), show_.title, std::string(projection_name(show_.projection)),
          columns(show_.projection), rows(show_.projection)};
}

fs::path FrameFolder::record_path() const { return folder_ / (name_ + ".json"); }

std::string FrameFolder::record() const {
  Json record = {{"show", name_},
                 {"title", show_.title},
                 {"projection", projection_name(show_.projection)},
                 {"width", columns(show_.projection)},
                 {"height", rows(show_.projection)},
                 {"frames", frame_count(show_)},
                 {"frames_per_second", show_.frames_per_second},
                 {"linear", "exr"},
                 {"graded", nullptr}};
  if (has_graded()) record["graded"] = graded(0).extension().string().substr(1);
  // A file's name need not be UTF-8.
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void FrameFolder::check_owner() const {
  const Json theirs = read_record(record_path()), ours = Json::parse(record());
  if (!is_record(theirs) || text_of(theirs) == text_of(ours)) return;
  const int there = frames_there();
  if (there == 0) return;
  throw InputError(fmt::format(
      "{}: the folder belongs to {}, of which {} files are there; this run would make {}. Another "
      "--out keeps them apart, --replace lets this run have the folder",
      record_path().string(), text_of(theirs), there, text_of(ours)));
}

int FrameFolder::frames_there() const {
  int count = 0;
  for (const char* kind : {kLinear, kGraded})
    for_each_file(folder_ / kind,
                  [&](const fs::path& file) { count += frame_number(file, name_).has_value(); });
  return count;
}

std::vector<fs::path> FrameFolder::strangers() const {
  std::vector<fs::path> found;
  const int count = frame_count(show_);
  const auto look = [&](const char* kind, const std::string& extension) {
    for_each_file(folder_ / kind, [&](const fs::path& file) {
      const auto number = frame_number(file, name_);
      if (!number || *number >= count || file.extension() != extension)
        found.push_back(fs::path(kind) / file.filename());
    });
  };
  look(kLinear, ".exr");
  look(kGraded, has_graded() ? graded(0).extension().string() : "");
  std::sort(found.begin(), found.end());
  return found;
}

void FrameFolder::prepare() const {
  make_folder(folder_ / kLinear);
  if (has_graded()) make_folder(folder_ / kGraded);
  sweep_temporaries(folder_);
}

void FrameFolder::write_record() const {
  const std::string text = record();
  try {
    const auto there = FileBytes::open(record_path());
    if (there && there->size() == text.size() && there->at(0, text.size()) == text) return;
  } catch (const DamagedFile&) {  // another program has shortened it meanwhile
  }
  write_atomically(record_path(), text);
}

}  // namespace domefall
