#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/cli/black_frames.h"
#include "pipeline/cli/farm_frames.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

struct VerifyOptions {
  FarmRequest request;
  bool json = false, repair = false;
};

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

  // Returns the frames that a run has to make again.  Those that cannot be read are not among them,
  // because they may be good.
  std::vector<int> to_make() const {
    const std::vector<int> bad = found_.to_make(), suspicious = this->suspicious();
    return joined_frames({&bad, &suspicious});
  }

  std::size_t good() const { return found_.good.size() - suspicious().size(); }

  // Makes the frames of to_make() and those that cannot be read, and looks at them again.  Throws
  // InputError if the folder is another show's.  Also throws as run_frames.
  void repair() {
    const std::vector<int> bad = to_make();
    const std::vector<int> frames = joined_frames({&bad, &found_.unreadable});
    if (frames.empty()) return;
    // The files of other shows may go only where the folder is this show's.
    frames_.folder().check_owner();
    if (!found_.others.empty() && found_.good.empty() && found_.stale.empty())
      throw InputError(fmt::format(
          "{}: no frame is of this show, and {} are of another show, size or kind, such as {}; "
          "domefall render --replace makes them this one's",
          frames_.folder().path().string(), found_.others.size(),
          found_.others_files.front().string()));
    remove_what_would_be_kept();
    run_frames({frames_.show(), frames, frames_.folder().path(), threads_, false, true, true});
    look_again(frames);
    sum_up_again();
  }

 private:
  std::vector<FileFinding> look(const std::vector<ExpectedFile>& files) const {
    const Manifest manifest = read_manifest(frames_.folder().path(), readers_);
    return look_at_files(files, manifest, examine_file, readers_, stop_if_interrupted);
  }

  void sum_up_again() {
    found_ = sum_up(files_, findings_);
    foreign_ = FarmFrames::foreign(found_, frames_.folder().strangers());
    const auto& grader = frames_.grader();
    black_ = unexpectedly_black(frames_.show(), found_, grader ? &*grader : nullptr, threads_);
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

  // Removes files that a run would not replace.  It keeps a frame of the right key and digest,
  // whatever is to be seen on it, and ends at a file that it cannot read.
  void remove_what_would_be_kept() const {
    const std::vector<int> suspects = suspicious();
    for (std::size_t k = 0; k < files_.size(); ++k) {
      std::error_code error;
      const bool suspect = std::ranges::binary_search(suspects, files_[k].frame);
      if (!suspect && findings_[k].unreadable.empty()) continue;
      if (!fs::is_regular_file(fs::symlink_status(files_[k].path, error)) || error) continue;
      fs::remove(files_[k].path, error);
      if (error) throw TemporaryError(files_[k].path.string() + ": " + error.message());
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

nlohmann::ordered_json verify_json(const FarmFrames& frames, const Verification& verified) {
  const FolderFindings& found = verified.found();
  return {{"frames", frames.frames().size()},
          {"good", verified.good()},
          {"missing", as_ranges(found.missing)},
          {"damaged", as_ranges(found.damaged)},
          {"others", as_ranges(found.others)},
          {"stale", as_ranges(found.stale)},
          {"unreadable", as_ranges(found.unreadable)},
          {"foreign", verified.foreign()},
          {"suspicious",
           {{"black", as_ranges(verified.black())},
            {"not_finite", as_ranges(found.not_finite)},
            {"unlike_manifest", as_ranges(found.unlike)}}},
          {"to_make", as_ranges(verified.to_make())}};
}

void print_page(const FarmFrames& frames, const Verification& verified) {
  const FolderFindings& found = verified.found();
  fmt::print("{}: {} of {} frames are good\n", frames.folder().path().string(), verified.good(),
             frames.frames().size());
  const auto line = [](const char* what, const std::vector<int>& list) {
    if (!list.empty()) fmt::print("  {}: {}\n", what, as_ranges(list));
  };
  line("missing", found.missing);
  line("damaged", found.damaged);
  line("frames of another show, size or kind", found.others);
  line("of another version of the show or its grade", found.stale);
  line("black, though the show has light there", verified.black());
  line("with values that are no finite numbers", found.not_finite);
  line("not with the bytes that their writers noted", found.unlike);
  line("cannot be read", found.unreadable);
  for (const auto& [frame, why] : found.reasons) fmt::print("    {}: {}\n", frame, why);
  if (!verified.foreign().empty()) fmt::print("  not this show's, and left alone:\n");
  for (const std::string& file : verified.foreign()) fmt::print("    {}\n", file);
}

// Throws what leads to the exit code for the findings.  After a repair foreign files do not count,
// so that a job that depends on it does not wait until somebody has removed them.
void end_by(const FarmFrames& frames, const Verification& verified, bool repair) {
  const std::string folder = frames.folder().path().string();
  const auto counted = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (const auto count = verified.found().unreadable.size())
    throw TemporaryError(folder + ": " + counted(count, "frame") + " cannot be read");
  if (const auto count = verified.to_make().size())
    throw std::runtime_error(
        fmt::format("{}: {} to be made; --repair makes them", folder, counted(count, "frame")));
  if (const auto count = verified.foreign().size(); count > 0 && !repair)
    throw std::runtime_error(folder + ": all frames are good, and " + counted(count, "file") +
                             " among them not this show's");
}

void verify_folder(const VerifyOptions& o) {
  catch_interruptions();
  const FarmFrames frames(o.request);
  Verification verified(frames, o.request.threads, reading_threads(o.request));
  if (o.repair) verified.repair();
  if (o.json)
    fmt::print("{}\n", verify_json(frames, verified)
                           .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    print_page(frames, verified);
  end_by(frames, verified, o.repair);
}

}  // namespace

void add_farm_verify(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "verify", "Read every byte of a show's frames; ends with 1 where not all are there and good");
  auto o = std::make_shared<VerifyOptions>();
  add_farm_options(*verb, o->request);
  verb->add_flag("--json", o->json, "print what was found as JSON");
  verb->add_flag("--repair", o->repair, "make the frames again that are not good");
  verb->callback([o] { verify_folder(*o); });
}

}  // namespace domefall
