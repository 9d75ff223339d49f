#include "pipeline/cli/delivery_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <set>

#include "pipeline/cli/delivery_plan.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/frame_sheet.h"
#include "pipeline/cli/graded_frames.h"
#include "pipeline/cli/progress.h"
#include "pipeline/deliver/checksum_list.h"
#include "pipeline/deliver/contact_sheet.h"
#include "pipeline/deliver/delivery.h"
#include "pipeline/deliver/folder_files.h"
#include "pipeline/deliver/in_parallel.h"
#include "pipeline/deliver/place_file.h"
#include "pipeline/image/atomic_file.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

Show with_format(Show show, const GradedFormat& format) {
  if (show.output.graded) show.output.graded = format;
  return show;
}

class Deliverer {
 public:
  explicit Deliverer(const DeliveryRun& run)
      : run_(run),
        target_show_(with_format(run.show, delivered_format(run.show, run.bits))),
        source_(run.show, run.from),
        target_(target_show_, run.from),
        delivery_(describe_delivery(run, source_, target_.format())),
        files_(delivered_files(delivery_)) {
    delivery_.files = files_.size();
  }

  void check_frames() const {
    std::vector<int> frames(static_cast<std::size_t>(frame_count(run_.show)));
    std::iota(frames.begin(), frames.end(), 0);
    source_.check(frames, run_.threads);
  }

  void make() {
    begin();
    place_frames();
    draw_pictures();
    for (std::size_t k = 0; k < run_.sounds.size(); ++k)
      copy_whole_file(run_.sounds[k], run_.out / delivery_.sounds[k].path);
    for (std::size_t k = 0; k < run_.subtitles.size(); ++k)
      copy_whole_file(run_.subtitles[k], run_.out / delivery_.subtitles[k].path);
    write_texts();
    finish();
  }

  // Throws InputError if the folder holds what this delivery would not overwrite, or should not.
  void check_folder() const {
    std::error_code none;
    if (fs::exists(run_.out, none) && !fs::is_directory(run_.out, none))
      throw InputError(run_.out.string() + ": is a file; --out names a folder");
    const auto there = files_below(run_.out);
    if (there.empty()) return;
    const auto has = [&](const char* name) {
      return std::binary_search(there.begin(), there.end(), name);
    };
    if (!has(kUnfinished) && !(has(kMetadata) && has(kChecksums)))
      throw InputError(run_.out.string() +
                       ": the folder is not empty and holds no delivery; another --out is needed");
    std::vector<std::string> others;
    for (const std::string& file : there)
      if (!files_.contains(file) && file != kUnfinished && file != kChecksums)
        others.push_back(file);
    if (!others.empty())
      throw InputError(fmt::format(
          "{}: {} file{} there not of this delivery, such as {}; remove the folder, or name "
          "another "
          "--out",
          run_.out.string(), others.size(), others.size() > 1 ? "s are" : " is", others.front()));
  }

 private:
  void begin() const {
    make_delivery_folder(run_.out);
    write_atomically(
        run_.out / kUnfinished,
        "This delivery is not finished.  The same `domefall deliver` goes on with it.\n");
    std::error_code error;
    fs::remove(run_.out / kChecksums, error);
    if (error) throw_file_error(run_.out / kChecksums, error.value());
    flush_folder(run_.out);
    for (const fs::path& folder : folders())
      if (!folder.empty()) make_delivery_folder(run_.out / folder);
  }

  std::set<fs::path> folders() const {
    std::set<fs::path> all;
    for (const std::string& file : files_) all.insert(fs::path(file).parent_path());
    return all;
  }

  void place_frames() const {
    const bool same = source_.format() == target_.format();
    Progress progress(static_cast<std::size_t>(delivery_.names.count()));
    std::mutex one_at_a_time;
    in_parallel(delivery_.names.count(), frames_at_once(run_.show, run_.threads), [&](int frame) {
      const fs::path to = run_.out / delivery_.names.path(frame);
      const WantedFrame wanted = target_.wanted(frame);
      if (examine_frame(to, wanted) == FrameCondition::kGood) {
        const std::lock_guard lock(one_at_a_time);
        return progress.skipped();
      }
      if (same)
        link_or_copy_file(source_.file(frame), to);
      else
        write_graded(to, source_.read(frame), target_.info(frame), target_.format());
      // The source may have been changed since it was checked.
      if (examine_frame(to, wanted) != FrameCondition::kGood)
        throw TemporaryError(source_.file(frame).string() +
                             ": the file was changed meanwhile; run again");
      const std::lock_guard lock(one_at_a_time);
      progress.made();
    });
  }

  // Writes a picture that is no frame of the show, in the format of the frames.  One that is there
  // and good is left.
  template <class Draw>
  void write_drawn(const std::string& path, const char* kind, int number, const Draw& draw) const {
    GradedInfo info = picture_info();
    info.frame = number;
    Digest digest;
    digest.add(kSoftware).add(kind).add(number).add(run_.show.frames_per_second);
    digest.add(format_id(target_.format())).add(info.display).add(info.view);
    for (const std::string& line : show_lines(delivery_)) digest.add(line);
    info.key = digest.hex();
    const WantedFrame wanted{info.key, info.title, info.projection, columns(run_.show.projection),
                             rows(run_.show.projection)};
    if (examine_frame(run_.out / path, wanted) != FrameCondition::kGood)
      write_graded(run_.out / path, draw(), info, target_.format());
  }

  GradedInfo picture_info() const {
    GradedInfo info = target_.info(0);
    info.key.clear();
    return info;
  }

  void draw_pictures() const {
    const ShowLines lines = show_lines(delivery_);
    const int at_once = frames_at_once(run_.show, run_.threads);
    write_drawn(delivery_.alignment, "alignment", 0,
                [&] { return alignment_frame(run_.show.projection, lines); });
    in_parallel(delivery_.leader_frames, at_once, [&](int k) {
      write_drawn(leader_path(delivery_, k), "leader", k, [&] {
        return leader_frame(run_.show.projection, lines, run_.show.frames_per_second, k);
      });
    });
    const std::vector<int> shown = frames_of_sheet(delivery_.names.count());
    std::vector<std::string> labels;
    labels.reserve(shown.size());
    for (const int frame : shown) labels.push_back(fmt::to_string(frame + 1));
    write_graded(run_.out / kContactSheet,
                 sheet_of_frames(source_, run_.show, shown, labels, at_once), picture_info(),
                 {GradedKind::kPng8});
    constexpr int kPreviewRows = 1080;
    const int middle = delivery_.names.count() / 2;
    write_graded(run_.out / kPreview,
                 reduced_picture(source_.read(middle), columns(run_.show.projection), kPreviewRows),
                 picture_info(), {GradedKind::kPng8});
  }

  void write_texts() const {
    write_atomically(run_.out / kReadme, readme_text(delivery_));
    write_atomically(run_.out / kMetadata, metadata_text(delivery_));
    const fs::path script = run_.out / kVerifyScript;
    write_atomically(script, verify_script(delivery_.files));
    std::error_code ignored;  // some file systems know no such right, and `sh verify.sh` needs none
    fs::permissions(script, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                    fs::perm_options::add, ignored);
  }

  void finish() const {
    std::vector<ListedFile> listed;
    for (const std::string& file : files_) listed.push_back({"", file});
    in_parallel(static_cast<int>(listed.size()), run_.threads, [&](int k) {
      ListedFile& file = listed[static_cast<std::size_t>(k)];
      file.sha256 = sha256_of_file(run_.out / file.path);
    });
    for (const fs::path& folder : folders()) flush_folder(run_.out / folder);
    write_atomically(run_.out / kChecksums, checksum_list(listed));
    std::error_code error;
    fs::remove(run_.out / kUnfinished, error);
    if (error) throw_file_error(run_.out / kUnfinished, error.value());
    flush_folder(run_.out);
    std::fprintf(stderr, "%d frames and %zu other files delivered: %s\n", delivery_.names.count(),
                 listed.size() - static_cast<std::size_t>(delivery_.names.count()),
                 run_.out.c_str());
  }

  const DeliveryRun& run_;
  Show target_show_;  // whose format is that of the delivered frames
  GradedFrames source_, target_;
  Delivery delivery_;
  std::set<std::string> files_;  // all but the list of checksums
};

}  // namespace

void run_delivery(const DeliveryRun& run) {
  Deliverer deliverer(run);
  deliverer.check_folder();
  deliverer.check_frames();
  deliverer.make();
}

void check_delivery_folder(const DeliveryRun& run) { Deliverer(run).check_folder(); }

}  // namespace domefall
