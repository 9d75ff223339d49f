#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "farm/verbs.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frames/brightest_value.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/render/reduced_frame.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr int kSmallWidth = 96;
constexpr double kSurelyBrighter = 10;

// Returns the greatest code as a part of white.
double brightest_of(const GradedFrame& frame) {
  constexpr double kWhite = 65535;
  return *std::max_element(frame.pixels.begin(), frame.pixels.end()) / kWhite;
}

// Returns, sorted, those of the black frames that ought to have light.  Each is rendered again,
// small, and ought to have light if that is more than ten times as bright as a frame may be that
// counts as black.  So frames in the dark of a fade, and frames that no light reaches, are not
// returned.  `grader` is the show's, or null.  Throws as Renderer.
std::vector<int> unexpectedly_black(const Show& show, const FolderFindings& found,
                                    const Grader* grader, int threads) {
  std::vector<int> unexpected;
  const std::vector<int> black = joined_frames({&found.black_linear, &found.black_graded});
  if (black.empty()) return unexpected;
  Renderer renderer(show, threads, {}, kSurveyDetail);
  for (const int frame : black) {
    const FrameState state = reduced(frame_state(show, frame), kSmallWidth);
    const HalfFrame small = renderer.render(state);
    const bool light = brightest_value(small) > kSurelyBrighter * kBrightestOfBlack;
    const bool linear = std::ranges::binary_search(found.black_linear, frame),
               graded = grader && std::ranges::binary_search(found.black_graded, frame);
    if ((linear && light) || (graded && brightest_of(grader->with(state.cdl).grade(small)) >
                                            kSurelyBrighter * kBrightestOfBlackCodes))
      unexpected.push_back(frame);
  }
  return unexpected;
}

// A Verification looks at every byte of a folder's frames, and has those made again that are not
// good.
class Verification {
 public:
  // `threads` render, where 0 stands for one per processor, and `readers` read.
  Verification(const FarmFrames& frames, int threads, int readers)
      : frames_(frames), threads_(threads), readers_(readers), files_(frames.files()) {
    findings_ = look(files_);
    sum_up_again();
  }

  const FolderFindings& found() const { return found_; }
  const std::vector<std::string>& foreign() const { return foreign_; }
  const std::vector<int>& black() const { return black_; }
  const std::vector<int>& unreadable() const { return found_.of(FrameCondition::kUnreadable); }

  // Returns the frames that a run has to make again.  Those that cannot be read are not among them,
  // because they may be good.
  std::vector<int> to_make() const {
    const std::vector<int> bad = found_.to_make(), suspicious = this->suspicious();
    return joined_frames({&bad, &suspicious});
  }

  std::size_t good() const { return found_.good().size() - suspicious().size(); }

  // Makes the frames of to_make() and those that cannot be read, and looks at them again.  Leaves
  // alone what is no file, such as a folder of a frame's name.  Throws InputError if the folder is
  // another show's.  Also throws as run_frames.
  void repair() {
    const std::vector<int> bad = to_make();
    if (bad.empty() && unreadable().empty()) return;
    // The files of other shows may go only where the folder is this show's.
    frames_.folder().check_owner();
    if (!found_.of(FrameCondition::kOther).empty() && found_.good().empty() &&
        found_.of(FrameCondition::kOlder).empty())
      throw InputError(fmt::format(
          "{}: no frame is of this show, and {} are of another show, size or kind, such as {}; "
          "domefall render --replace makes them this one's",
          frames_.folder().path().string(), found_.of(FrameCondition::kOther).size(),
          found_.others.front().name));
    const std::vector<int> left = empty_what_would_be_kept();
    std::vector<int> frames;
    std::ranges::set_difference(joined_frames({&bad, &unreadable()}), left,
                                std::back_inserter(frames));
    if (frames.empty()) return;
    run_frames({frames_.show(), frames, frames_.folder().path(), threads_, false, true, true});
    look_again(frames);
    sum_up_again();
  }

 private:
  std::vector<FileFinding> look(const std::vector<ExpectedFile>& files) const {
    const Manifest manifest = read_manifest(frames_.folder().path(), readers_);
    return look_at_files(files, readers_,
                         [&](const ExpectedFile& file) { return examine_file(file, manifest); });
  }

  void sum_up_again() {
    found_ = sum_up(files_, findings_);
    foreign_ = with_others(frames_.folder().foreign_files(), found_);
    black_ = unexpectedly_black(frames_.show(), found_, frames_.grader(), threads_);
  }

  std::vector<int> suspicious() const {
    return joined_frames({&black_, &found_.not_finite, &found_.unlike});
  }

  void look_again(const std::vector<int>& frames) {
    std::vector<std::size_t> places;
    std::vector<ExpectedFile> files;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      if (!std::ranges::binary_search(frames, files_[k].frame)) continue;
      places.push_back(k);
      files.push_back(files_[k]);
    }
    const std::vector<FileFinding> findings = look(files);
    for (std::size_t k = 0; k < places.size(); ++k) findings_[places[k]] = findings[k];
  }

  // Puts empty files in the place of those that a run would not replace.  It keeps a frame of the
  // right key and digest, whatever is to be seen on it, and ends at what it cannot read.  A link
  // stays, and the file at its end becomes empty.  Returns the frames for which that cannot be
  // done.
  std::vector<int> empty_what_would_be_kept() const {
    const std::vector<int> suspects = suspicious();
    std::vector<int> left;
    for (std::size_t k = 0; k < files_.size(); ++k) {
      const bool suspect = std::ranges::binary_search(suspects, files_[k].frame);
      if (!suspect && findings_[k].condition != FrameCondition::kUnreadable) continue;
      if (!is_emptied(files_[k].path)) left.push_back(files_[k].frame);
    }
    return left;
  }

  static bool is_emptied(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return false;
    try {
      write_atomically(path, {});
      return true;
    } catch (const TemporaryError&) {
      return false;
    }
  }

  const FarmFrames& frames_;
  int threads_, readers_;
  std::vector<ExpectedFile> files_;
  std::vector<FileFinding> findings_;
  FolderFindings found_;
  std::vector<std::string> foreign_;
  std::vector<int> black_;
};

nlohmann::ordered_json json_of(const FarmFrames& frames, const Verification& verified) {
  const FolderFindings& found = verified.found();
  nlohmann::ordered_json json = {{"frames", frames.frames().size()}, {"good", verified.good()}};
  add_bad_frames(json, found);
  json.update({{"foreign", verified.foreign()},
               {"suspicious",
                {{"black", as_ranges(verified.black())},
                 {"not_finite", as_ranges(found.not_finite)},
                 {"unlike_manifest", as_ranges(found.unlike)}}},
               {"to_make", as_ranges(verified.to_make())}});
  return json;
}

void print_page(const FarmFrames& frames, const Verification& verified) {
  using enum FrameCondition;
  const FolderFindings& found = verified.found();
  fmt::print("{}: {} of {} frames are good\n", printable(frames.folder().path().string()),
             verified.good(), frames.frames().size());
  const auto line = [](const char* what, const std::vector<int>& list) {
    if (!list.empty()) fmt::print("  {}: {}\n", what, as_ranges(list));
  };
  for (const FrameCondition condition : {kMissing, kDamaged, kOther, kOlder})
    line(words_of(condition), found.of(condition));
  line("black, though the show has light there", verified.black());
  line("with values that are no finite numbers", found.not_finite);
  line("not with the bytes that their writers noted", found.unlike);
  line(words_of(kUnreadable), verified.unreadable());
  for (const auto& [frame, why] : found.reasons) fmt::print("    {}: {}\n", frame, printable(why));
  if (!verified.foreign().empty()) fmt::print("  not this show's, and left alone:\n");
  for (const std::string& file : verified.foreign()) fmt::print("    {}\n", printable(file));
}

// Throws what leads to the exit code for the findings.  After a repair foreign files do not count,
// so that a job that depends on it does not wait until somebody has removed them.
void end_by(const FarmFrames& frames, const Verification& verified, bool repair) {
  const std::string folder = frames.folder().path().string();
  const auto counted = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (const auto count = verified.unreadable().size())
    throw TemporaryError(folder + ": " + counted(count, "frame") + " cannot be read");
  if (const auto count = verified.to_make().size())
    throw std::runtime_error(
        fmt::format("{}: {} to be made; --repair makes them", folder, counted(count, "frame")));
  if (const auto count = verified.foreign().size(); count > 0 && !repair)
    throw std::runtime_error(folder + ": all frames are good, and " + counted(count, "file") +
                             " among them not this show's");
}

}  // namespace

void verify_folder(const FarmRequest& request, bool json, bool repair) {
  catch_interruptions();
  const FarmFrames frames(request);
  Verification verified(frames, request.threads, reading_threads(request));
  if (repair) verified.repair();
  if (json)
    fmt::print(
        "{}\n",
        json_of(frames, verified).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    print_page(frames, verified);
  end_by(frames, verified, repair);
}

}  // namespace domefall
