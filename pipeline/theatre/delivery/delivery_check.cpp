#include "pipeline/theatre/delivery/delivery_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "pipeline/base/errors.h"
#include "pipeline/base/in_parallel.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_head.h"
#include "pipeline/theatre/delivery/checksum_list.h"
#include "pipeline/theatre/delivery/delivery.h"
#include "pipeline/theatre/delivery/folder_files.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// StatedFrames are what metadata.json says of the frames.
struct StatedFrames {
  DeliveredNames names;
  int width, height, bits;
  std::string title;
  std::size_t files;  // how many have a checksum
};

std::optional<StatedFrames> stated_frames(const fs::path& metadata) {
  constexpr std::uint64_t kMost = std::uint64_t{64} << 20;
  const auto json = nlohmann::json::parse(read_file(metadata, kMost), nullptr, false);
  try {
    const auto& names = json.at("names");
    const int count = json.at("frames").get<int>();
    constexpr int kMostFrames = 10'000'000;
    if (count < 1 || count > kMostFrames || names.at("first") != 1 || names.at("last") != count)
      return std::nullopt;
    return StatedFrames{DeliveredNames(parse_name_pattern(names.at("pattern").get<std::string>()),
                                       count, names.at("extension").get<std::string>()),
                        json.at("width").get<int>(),
                        json.at("height").get<int>(),
                        json.at("image").at("bits_per_colour").get<int>(),
                        json.at("title").get<std::string>(),
                        json.at("files").get<std::size_t>()};
  } catch (const nlohmann::json::exception&) {  // something is missing, or of another type
    return std::nullopt;
  } catch (const InputError&) {  // the pattern or the extension is wrong
    return std::nullopt;
  }
}

enum class FrameFinding : char { kAsStated, kOther, kDamaged };

// `index` is the frame's number in the show, from 0.
FrameFinding examine_delivered(const fs::path& path, int index, const StatedFrames& stated) {
  const auto file = FileBytes::open(path);
  try {
    const auto head = file ? read_frame_head(*file) : std::nullopt;
    if (!head || !is_whole(*file, *head)) return FrameFinding::kDamaged;
    const bool same = head->width == stated.width && head->height == stated.height &&
                      head->bits == stated.bits && head->title == one_line(stated.title) &&
                      head->frame == fmt::to_string(index);
    return same ? FrameFinding::kAsStated : FrameFinding::kOther;
  } catch (const DamagedFile&) {
    return FrameFinding::kDamaged;
  }
}

class DeliveryChecker {
 public:
  DeliveryChecker(fs::path folder, int threads) : folder_(std::move(folder)), threads_(threads) {
    FolderFiles found = files_below(folder_);
    there_.insert(found.files.begin(), found.files.end());
    faults_.left_behind = std::move(found.left_behind);
  }

  DeliveryFaults run() {
    if (there_.contains(kUnfinished))
      faults_.whole.push_back(std::string("it was not finished, says ") + kUnfinished +
                              "; run domefall deliver again");
    if (read_list()) {
      read_stated();
      compare_files();
      check_sums();
      if (stated_) check_frames();
    }
    return std::move(faults_);
  }

 private:
  bool read_list() {
    if (!is_file(kChecksums)) {
      faults_.whole.push_back(std::string(kChecksums) + " is missing: it was never finished");
      return false;
    }
    constexpr std::uint64_t kMost = std::uint64_t{2} << 30;
    try {
      listed_ = parse_checksum_list(read_file(folder_ / kChecksums, kMost));
    } catch (const InputError& error) {
      faults_.whole.push_back(std::string(kChecksums) + ": " + error.what());
      return false;
    }
    return true;
  }

  void read_stated() {
    if (is_file(kMetadata)) stated_ = stated_frames(folder_ / kMetadata);
    if (!stated_) {
      faults_.whole.push_back(std::string(kMetadata) +
                              " does not say which frames there should be");
      return;
    }
    for (int k = 0; k < stated_->names.count(); ++k)
      number_of_.emplace(stated_->names.path(k).string(), k + 1);
  }

  // Returns the number of a frame by its path, or 0 for other files.
  int number_of(const std::string& path) const {
    const auto found = number_of_.find(path);
    return found == number_of_.end() ? 0 : found->second;
  }

  // Says whether something is there that can be read to its end, if need be by a link.
  bool is_file(const std::string& path) const {
    std::error_code error;
    return there_.contains(path) && fs::is_regular_file(folder_ / path, error);
  }

  void compare_files() {
    std::set<std::string> named;
    for (const ListedFile& file : listed_) {
      if (!named.insert(file.path).second)
        faults_.whole.push_back(std::string(kChecksums) + " lists " + file.path + " twice");
      if (!there_.contains(file.path) && !number_of(file.path))
        faults_.missing_files.push_back(file.path);
    }
    for (const auto& [path, number] : number_of_) {
      if (!there_.contains(path))
        faults_.missing_frames.push_back(number);
      else if (!named.contains(path))
        faults_.whole.push_back(std::string(kChecksums) + " does not list " + path);
    }
    // A list that was made anew after files were lost would not show that they are missing.
    if (stated_ && named.size() != stated_->files)
      faults_.whole.push_back(fmt::format("{} lists {} files, and {} says {}", kChecksums,
                                          named.size(), kMetadata, stated_->files));
    for (const std::string& path : there_)
      if (fs::is_symlink(folder_ / path))
        faults_.whole.push_back(printable(path) + " is a link and no file");
      else if (!is_file(path))
        faults_.whole.push_back(printable(path) + " is a pipe, a socket or a device and no file");
    for (const char* file : {kReadme, kMetadata, kVerifyScript})
      if (!named.contains(file))
        faults_.whole.push_back(std::string(kChecksums) + " does not list " + file);
    for (const std::string& path : there_)
      if (path != kChecksums && path != kUnfinished && !named.contains(path) && !number_of(path))
        faults_.extra_files.push_back(path);
    std::ranges::sort(faults_.missing_frames);
  }

  void check_sums() {
    std::vector<char> changed(listed_.size());
    in_parallel(static_cast<int>(listed_.size()), threads_, [&](int k) {
      const ListedFile& file = listed_[static_cast<std::size_t>(k)];
      if (is_file(file.path))
        changed[static_cast<std::size_t>(k)] = sha256_of_file(folder_ / file.path) != file.sha256;
    });
    for (std::size_t k = 0; k < listed_.size(); ++k) {
      if (!changed[k]) continue;
      if (const int number = number_of(listed_[k].path))
        faults_.damaged_frames.push_back(number);
      else
        faults_.changed_files.push_back(listed_[k].path);
    }
  }

  // No two frames of a show have the same bytes, since each file says which it is.  So a list that
  // was made anew over a wrong folder is found out too.
  void check_frames() {
    std::map<std::string, int> first_with;
    std::vector<const ListedFile*> frames;
    for (const ListedFile& file : listed_)
      if (number_of(file.path) && is_file(file.path)) frames.push_back(&file);
    for (const ListedFile* file : frames)
      if (!first_with.emplace(file->sha256, number_of(file->path)).second)
        faults_.repeated_frames.push_back(number_of(file->path));
    std::vector<FrameFinding> findings(frames.size());
    in_parallel(static_cast<int>(frames.size()), threads_, [&](int k) {
      const auto at = static_cast<std::size_t>(k);
      findings[at] =
          examine_delivered(folder_ / frames[at]->path, number_of(frames[at]->path) - 1, *stated_);
    });
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const int number = number_of(frames[k]->path);
      if (findings[k] == FrameFinding::kOther) faults_.other_frames.push_back(number);
      if (findings[k] == FrameFinding::kDamaged &&
          std::ranges::find(faults_.damaged_frames, number) == faults_.damaged_frames.end())
        faults_.damaged_frames.push_back(number);
    }
    for (auto* numbers : {&faults_.damaged_frames, &faults_.repeated_frames, &faults_.other_frames})
      std::sort(numbers->begin(), numbers->end());
  }

  fs::path folder_;
  int threads_;
  std::set<std::string> there_;
  std::vector<ListedFile> listed_;
  std::optional<StatedFrames> stated_;
  std::map<std::string, int> number_of_;  // of the frames that there should be
  DeliveryFaults faults_;
};

}  // namespace

bool DeliveryFaults::none() const {
  return whole.empty() && missing_frames.empty() && damaged_frames.empty() &&
         repeated_frames.empty() && other_frames.empty() && missing_files.empty() &&
         changed_files.empty() && extra_files.empty();
}

DeliveryFaults check_delivery(const fs::path& folder, int threads) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw InputError(folder.string() + ": there is no such folder");
  return DeliveryChecker(folder, threads).run();
}

}  // namespace domefall
