#include "pipeline/render/frames/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/temporary_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kLinear = "linear", *kGraded = "graded", *kLens = "lens",
                     *kLayerFiles = "layers";

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

fs::path FrameFolder::path_of(const std::string& kind, int frame, const char* extension) const {
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

fs::path FrameFolder::layer(int frame, Layer layer) const {
  return path_of(fmt::format("{}/{}", kLayerFiles, kind_of(layer).name), frame, "exr");
}

std::vector<Layer> FrameFolder::layers() const {
  return show_.output.layer_files ? show_.output.layers : std::vector<Layer>{};
}

std::vector<fs::path> FrameFolder::paths(int frame) const {
  std::vector<fs::path> paths;
  if (has_linear()) paths.push_back(linear(frame));
  for (const Layer one : layers()) paths.push_back(layer(frame, one));
  if (has_graded()) paths.push_back(graded(frame));
  return paths;
}

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

std::vector<ExpectedFile> FrameFolder::files(const std::vector<int>& frames, const FrameKeys& keys,
                                             FrameFiles which) const {
  std::vector<ExpectedFile> files;
  files.reserve(2 * frames.size());
  const auto add = [&](int frame, fs::path path, std::string key, bool is_layer = false) {
    std::string name = path.lexically_relative(folder_).string();
    files.push_back({frame, std::move(path), std::move(name), wanted(std::move(key)), is_layer});
  };
  for (const int frame : frames) {
    const FrameState state = frame_state(show_, frame);
    const std::string key = keys.scene(state);
    if (has_linear() && which == FrameFiles::kAll) {
      add(frame, linear(frame), key);
      for (const Layer one : layers())
        add(frame, layer(frame, one), FrameKeys::layer(key, one), true);
    }
    if (has_graded()) add(frame, graded(frame), keys.graded(key, state));
  }
  return files;
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
  for (const char* kind : {kLinear, kGraded, kLayerFiles})
    for_each_file(folder_ / kind,
                  [&](const fs::path& file) { count += frame_of(file).has_value(); });
  return count;
}

std::vector<std::string> FrameFolder::foreign_files() const {
  std::vector<std::string> found;
  const int count = frame_count(show_);
  for (const char* kind : {kLinear, kGraded, kLayerFiles})
    for_each_file(folder_ / kind, [&](const fs::path& file) {
      const auto frame = frame_of(file);
      const auto ours = frame && *frame < count ? paths(*frame) : std::vector<fs::path>{};
      if (std::ranges::find(ours, file) == ours.end())
        found.push_back(file.lexically_relative(folder_).string());
    });
  std::sort(found.begin(), found.end());
  return found;
}

bool FrameFolder::is_of_unasked_layer(const fs::path& file) const {
  const auto frame = frame_of(file);
  if (!frame || *frame >= frame_count(show_)) return false;
  const std::vector<Layer> asked = layers();
  for (std::size_t k = 0; k < kLayers.size(); ++k)
    if (const auto one = static_cast<Layer>(k); layer(*frame, one) == folder_ / file)
      return std::ranges::find(asked, one) == asked.end();
  return false;
}

void FrameFolder::prepare(const std::vector<int>& frames, bool for_lens_maps) const {
  std::set<fs::path> made;
  for (const int frame : frames)
    for (const fs::path& file : for_lens_maps ? std::vector{lens(frame)} : paths(frame))
      if (made.insert(file.parent_path()).second) make_folder(file.parent_path());
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
