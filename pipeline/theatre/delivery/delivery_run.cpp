#include "pipeline/theatre/delivery/delivery_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <numeric>
#include <set>
#include <vector>

#include "pipeline/base/disk_room.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/in_parallel.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/render/frames/graded_frames.h"
#include "pipeline/render/frames/progress.h"
#include "pipeline/theatre/delivery/checksum_list.h"
#include "pipeline/theatre/delivery/contact_sheet.h"
#include "pipeline/theatre/delivery/delivery.h"
#include "pipeline/theatre/delivery/delivery_plan.h"
#include "pipeline/theatre/delivery/folder_files.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

Show with_format(Show show, const GradedFormat& format) {
  if (show.output.graded) show.output.graded = format;
  return show;
}

// Copies a file.  The copy appears whole or not at all.  Throws as RegularFile and NewFile.
void copy_whole_file(const fs::path& from, const fs::path& to) {
  RegularFile source(from);
  NewFile made(to);
  std::vector<char> block(std::size_t{1} << 20);
  while (const std::size_t count = source.read(block.data(), block.size()))
    made.write({block.data(), count});
  made.commit();
}

// Makes a hard link, which takes no room, or copies the file where the file system has no hard
// links or the two paths lie on different file systems.  What was at `to` is replaced.
void link_or_copy_file(const fs::path& from, const fs::path& to) {
  if (unlink(to.c_str()) != 0 && errno != ENOENT) throw_file_error(to, errno);
  // A symbolic link at `from` is followed, since a hard link to it would lead away from the
  // delivery.
  if (linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
  switch (errno) {
    case EXDEV:       // another file system
    case EPERM:       // one without hard links, or another user's file
    case EMLINK:      // as many as it may have
    case EOPNOTSUPP:  // as above, on some systems
    case ENOSYS:
      return copy_whole_file(from, to);
    default:
      throw_file_error(to, errno);
  }
}

class Deliverer {
 public:
  explicit Deliverer(const DeliveryRun& run)
      : run_(run),
        target_show_(with_format(run.show, delivered_format(run.show, run.bits))),
        grader_(run.show.grade),
        source_(run.show, grader_, run.from),
        target_(target_show_, grader_, run.from),
        delivery_(describe_delivery(run, source_, target_.format())),
        files_(delivered_files(delivery_)) {
    delivery_.files = files_.size();
  }

  void say_notes() const {
    for (std::size_t k = 0; k < run_.subtitles.size(); ++k)
      for (const std::string& note : delivery_.subtitles[k].subtitles.notes)
        say(run_.subtitles[k].string() + ": " + note);
  }

  void check_frames() const {
    std::vector<int> frames(static_cast<std::size_t>(frame_count(run_.show)));
    std::iota(frames.begin(), frames.end(), 0);
    source_.check(frames, run_.threads, kOtherFramesHint, {});
  }

  // Throws as require_room().  Frames that stay as they are become links where they can.
  void check_room() const {
    constexpr double kLeastPart = 1.0 / 8;  // of a frame of 16 bits, as one of 8
    const bool same = source_.format() == target_.format();
    if (same && is_same_disk(run_.from, run_.out)) return;
    double least = 0;
    for (int frame = 0; frame < delivery_.names.count(); ++frame) {
      std::error_code none;
      const auto bytes = static_cast<double>(fs::file_size(source_.file(frame), none));
      if (!none && !fs::exists(run_.out / delivery_.names.path(frame), none))
        least += (same ? 1 : kLeastPart) * bytes;
    }
    require_room(run_.out, least,
                 fmt::format("the frames of the delivery take {} {}", same ? "another" : "at least",
                             bytes_text(least)));
  }

  void make() {
    begin();
    place_frames();
    draw_pictures();
    for (const auto& [path, sound, cut] : delivery_.sounds)
      cut ? copy_wave(sound, run_.out / path) : copy_whole_file(sound.file, run_.out / path);
    place_subtitles();
    write_texts();
    finish();
  }

  // Throws InputError if the folder holds what this delivery would not overwrite, or should not.
  void check_folder() const {
    require_writable(run_.out / delivery_.names.path(0));
    std::error_code none;
    if (fs::exists(run_.out, none) && !fs::is_directory(run_.out, none))
      throw InputError(run_.out.string() + ": is a file; --out names a folder");
    const auto there = files_below(run_.out).files;
    if (there.empty()) return;
    const auto has = [&](const char* name) {
      return std::binary_search(there.begin(), there.end(), name);
    };
    if (!has(kUnfinished) && !(has(kMetadata) && has(kChecksums)))
      throw InputError(run_.out.string() +
                       ": the folder is not empty and holds no delivery; another --out is needed");
    std::vector<std::string> others;
    for (const std::string& file : there) {
      // What is written through a link would not be in the delivery.
      if (fs::is_symlink(run_.out / file))
        throw InputError((run_.out / file).string() + ": is a link, and a delivery holds files");
      if (!files_.contains(file) && file != kUnfinished && file != kChecksums)
        others.push_back(file);
    }
    if (!others.empty())
      throw InputError(fmt::format(
          "{}: {} file{} there not of this delivery, such as {}; remove the folder, or name "
          "another "
          "--out",
          run_.out.string(), others.size(), others.size() > 1 ? "s are" : " is",
          printable(others.front())));
  }

 private:
  void begin() const {
    make_folder(run_.out);
    write_atomically(
        run_.out / kUnfinished,
        "This delivery is not finished.  The same `domefall deliver` goes on with it.\n");
    std::error_code error;
    fs::remove(run_.out / kChecksums, error);
    if (error) throw_file_error(run_.out / kChecksums, error.value());
    flush_folder(run_.out);
    for (const fs::path& folder : folders())
      if (!folder.empty()) make_folder(run_.out / folder);
  }

  std::set<fs::path> folders() const {
    std::set<fs::path> all;
    for (const std::string& file : files_) all.insert(fs::path(file).parent_path());
    return all;
  }

  void place_subtitles() const {
    for (std::size_t k = 0; k < run_.subtitles.size(); ++k) {
      const DeliveredSubtitles& text = delivery_.subtitles[k];
      if (text.subtitles.converted.empty())
        copy_whole_file(run_.subtitles[k], run_.out / text.path);
      else
        write_atomically(run_.out / text.path, text.subtitles.converted);
    }
  }

  void place_frames() const {
    const bool same = source_.format() == target_.format();
    Progress progress(static_cast<std::size_t>(delivery_.names.count()));
    std::mutex one_at_a_time;
    in_parallel(delivery_.names.count(), frames_at_once(run_.show, run_.threads), [&](int frame) {
      const fs::path to = run_.out / delivery_.names.path(frame);
      const WantedFrame wanted = target_.wanted(frame);
      if (check_frame(to, wanted).condition == FrameCondition::kGood) {
        const std::lock_guard lock(one_at_a_time);
        return progress.skipped();
      }
      if (same)
        link_or_copy_file(source_.file(frame), to);
      else
        write_graded(to, source_.read(frame), target_.info(frame), target_.format());
      // The source may have been changed since it was checked.
      if (check_frame(to, wanted).condition != FrameCondition::kGood)
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
    if (check_frame(run_.out / path, wanted).condition != FrameCondition::kGood)
      write_graded(run_.out / path, draw(), info, target_.format());
  }

  GradedInfo picture_info() const {
    GradedInfo info = target_.info(0);
    info.key.clear();
    return info;
  }
  // Of pictures that show frames as a screen does.
  GradedInfo screen_info() const {
    GradedInfo info = picture_info();
    info.pixel_aspect = 1;
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
                 sheet_of_frames(source_, run_.show, shown, labels, at_once), screen_info(),
                 {GradedKind::kPng8});
    constexpr int kPreviewRows = 1080;
    const int middle = delivery_.names.count() / 2;
    write_graded(run_.out / kPreview,
                 reduced_picture(source_.read(middle), columns(run_.show.projection), kPreviewRows,
                                 screen_sides(run_.show.projection)),
                 screen_info(), {GradedKind::kPng8});
  }

  void write_texts() const {
    write_atomically(run_.out / kReadme, readme_text(delivery_));
    write_atomically(run_.out / kMetadata, metadata_text(delivery_));
    const fs::path script = run_.out / kVerifyScript;
    write_atomically(script, verify_script(delivery_.files));
    std::error_code ignored;  // some file systems know no such right, and `sh verify.sh` needs none
    // Whoever may read it, by the user's umask, may run it.
    constexpr auto kRead = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
    const auto readers = static_cast<unsigned>(fs::status(script, ignored).permissions() & kRead);
    fs::permissions(script, static_cast<fs::perms>(readers >> 2U), fs::perm_options::add, ignored);
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
    say(fmt::format("{} frames and {} other files delivered: {}", delivery_.names.count(),
                    listed.size() - static_cast<std::size_t>(delivery_.names.count()),
                    run_.out.string()));
  }

  const DeliveryRun& run_;
  Show target_show_;  // whose format is that of the delivered frames
  Grader grader_;
  GradedFrames source_, target_;
  Delivery delivery_;
  std::set<std::string> files_;  // all but the list of checksums
};

}  // namespace

void run_delivery(const DeliveryRun& run) {
  Deliverer deliverer(run);
  deliverer.check_folder();
  deliverer.say_notes();
  deliverer.check_frames();
  deliverer.check_room();
  deliverer.make();
}

void check_delivery_folder(const DeliveryRun& run) {
  const Deliverer deliverer(run);
  deliverer.check_folder();
  deliverer.say_notes();
}

}  // namespace domefall
