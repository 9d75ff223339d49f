#include "pipeline/cli/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/temporary_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kLinear = "linear", *kGraded = "graded", *kLens = "lens";

// Returns the first part of the path that is a link to nothing, or an empty path if there is none.
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

// Visits the files in a folder and in those below it, except for hidden ones.
void for_each_file(const fs::path& folder, const std::function<void(const fs::path&)>& use) {
  std::error_code error;  // a folder that cannot be read has no files
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const bool hidden = entry->path().filename().string().starts_with('.');
    if (hidden) entry.disable_recursion_pending();
    if (!hidden && !entry->is_directory(ignored)) use(entry->path());
  }
}

std::string numbered(const FrameNames& names, int number) {
  return fmt::format("{:0{}d}", number, names.digits);
}

// Returns null where there is no record, or one that cannot be understood.
Json read_record(const fs::path& path) {
  const auto file = FileBytes::open(path);
  if (!file || file->size() > FileBytes::kMost) return {};
  try {
    return Json::parse(file->at(0, file->size()), nullptr, false);
  } catch (const DamagedFile&) {  // another program has shortened it meanwhile
    return {};
  }
}

std::string record_text(const Json& record) {
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

fs::path frames_folder(const Show& show, const std::string& out) {
  return out.empty() ? fs::path("out") / show.file.stem() : fs::path(out);
}

FrameFolder::FrameFolder(fs::path folder, const Show& show)
    : folder_(std::move(folder)),
      show_(show),
      name_(show.file.stem().string()),
      file_name_(show.output.names.name.empty() ? name_ : show.output.names.name) {}

fs::path FrameFolder::path_of(const char* kind, int frame, const char* extension) const {
  const FrameNames& names = show_.output.names;
  fs::path folder = folder_ / kind;
  if (names.per_folder > 0) {
    const int first = names.start + frame / names.per_folder * names.per_folder,
              last = first + names.per_folder - 1;
    folder /= fmt::format("{}_{}-{}", file_name_, numbered(names, first), numbered(names, last));
  }
  return folder /
         fmt::format("{}_{}.{}", file_name_, numbered(names, names.start + frame), extension);
}

fs::path FrameFolder::linear(int frame) const { return path_of(kLinear, frame, "exr"); }

fs::path FrameFolder::lens(int frame) const { return path_of(kLens, frame, "exr"); }

fs::path FrameFolder::graded(int frame) const {
  const GradedFormat format = show_.output.graded.value_or(GradedFormat{});
  return path_of(kGraded, frame, extension_of(format.kind));
}

// Returns the frame whose number is in NAME_00000.EXTENSION, in whatever folder the file is.
// Returns nothing for other names.
std::optional<int> FrameFolder::frame_of(const fs::path& file) const {
  const FrameNames& names = show_.output.names;
  const std::string stem = file.stem().string();
  if (!stem.starts_with(file_name_ + "_")) return std::nullopt;
  const char *begin = stem.data() + file_name_.size() + 1, *end = stem.data() + stem.size();
  int number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stop != end || number < names.start ||
      numbered(names, number) != std::string(begin, end))
    return std::nullopt;
  return number - names.start;
}

WantedFrame FrameFolder::wanted(std::string key) const {
  return {std::move(key), show_.title, std::string(projection_name(show_.projection)),
          columns(show_.projection), rows(show_.projection)};
}

fs::path FrameFolder::record_path() const { return folder_ / (name_ + ".json"); }

std::string FrameFolder::record() const {
  const FrameNames& names = show_.output.names;
  Json record = {{"show", name_},
                 {"title", show_.title},
                 {"projection", projection_name(show_.projection)},
                 {"width", columns(show_.projection)},
                 {"height", rows(show_.projection)},
                 {"frames", frame_count(show_)},
                 {"frames_per_second", show_.frames_per_second},
                 {"linear", nullptr},
                 {"graded", nullptr},
                 {"name", file_name_},
                 {"start", names.start},
                 {"digits", names.digits},
                 {"per_folder", names.per_folder}};
  if (has_linear()) record["linear"] = "exr";
  if (has_graded()) record["graded"] = graded(0).extension().string().substr(1);
  // A file's name need not be UTF-8.
  return record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Throws InputError where the record of another show, which may call its files by the same name,
// claims files that are there.
void FrameFolder::check_namesakes() const {
  std::error_code error;  // a folder that is not there has no records
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().extension() != ".json" || entry.path() == record_path()) continue;
    const Json theirs = read_record(entry.path());
    if (!is_record(theirs) || theirs.value("name", "") != file_name_ || frames_there() == 0)
      continue;
    throw InputError(
        fmt::format("{}: files called {}_... belong to another show, {}. Another output.name or "
                    "--out keeps them "
                    "apart, --replace lets this run have them",
                    entry.path().string(), file_name_, theirs.value("show", "")));
  }
}

void FrameFolder::check_owner() const {
  check_namesakes();
  const Json theirs = read_record(record_path()), ours = Json::parse(record());
  if (!is_record(theirs) || record_text(theirs) == record_text(ours)) return;
  const int there = frames_there();
  if (there == 0) return;
  throw InputError(fmt::format(
      "{}: the folder belongs to {}, of which {} files are there; this run would make {}. Another "
      "--out keeps them apart, --replace lets this run have the folder",
      record_path().string(), record_text(theirs), there, record_text(ours)));
}

int FrameFolder::frames_there() const {
  int count = 0;
  for (const char* kind : {kLinear, kGraded})
    for_each_file(folder_ / kind,
                  [&](const fs::path& file) { count += frame_of(file).has_value(); });
  return count;
}

std::vector<fs::path> FrameFolder::strangers() const {
  std::vector<fs::path> found;
  const int count = frame_count(show_);
  const auto look = [&](const char* kind, const auto& path_of_frame) {
    for_each_file(folder_ / kind, [&](const fs::path& file) {
      const auto frame = frame_of(file);
      if (!frame || *frame >= count || file != path_of_frame(*frame))
        found.push_back(file.lexically_relative(folder_));
    });
  };
  look(kLinear, [this](int frame) { return has_linear() ? linear(frame) : fs::path(); });
  look(kGraded, [this](int frame) { return has_graded() ? graded(frame) : fs::path(); });
  std::sort(found.begin(), found.end());
  return found;
}

void FrameFolder::prepare(const std::vector<int>& frames) const {
  std::set<fs::path> linear_folders, graded_folders;
  for (const int frame : frames) {
    if (has_linear()) linear_folders.insert(linear(frame).parent_path());
    if (has_graded()) graded_folders.insert(graded(frame).parent_path());
  }
  for (const fs::path& made : linear_folders) make_folder(made);
  for (const fs::path& made : graded_folders) make_folder(made);
  sweep_temporaries(folder_);
}

void FrameFolder::prepare_lens(const std::vector<int>& frames) const {
  std::set<fs::path> folders;
  for (const int frame : frames) folders.insert(lens(frame).parent_path());
  for (const fs::path& made : folders) make_folder(made);
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
