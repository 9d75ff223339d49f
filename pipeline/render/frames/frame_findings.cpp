#include "pipeline/render/frames/frame_findings.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "pipeline/base/errors.h"
#include "pipeline/base/in_parallel.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/render/frames/brightest_value.h"
#include "pipeline/show/frame_state.h"

namespace domefall {
namespace {

constexpr std::int64_t kNanosecondsOfSecond = 1'000'000'000;

// Calls look() and takes what stops it for a file that cannot be read.
template <class Look>
FileFinding unless_unreadable(const Look& look) {
  try {
    return look();
  } catch (const InputError& error) {
    return {{FrameCondition::kUnreadable, error.what()}};
  } catch (const TemporaryError& error) {
    return {{FrameCondition::kUnreadable, error.what()}};
  }
}

// Says whether manifests have lines for the file with the wanted key, but `same` holds for none of
// them.
template <class Same>
bool is_unlike_all(const Manifest& manifest, const ExpectedFile& file, const Same& same) {
  const auto lines = manifest.files.find(file.name);
  if (lines == manifest.files.end()) return false;
  const auto is_wanted = [&](const MadeFile& made) { return made.key == file.wanted.key; };
  return std::ranges::any_of(lines->second, is_wanted) &&
         std::ranges::none_of(lines->second,
                              [&](const MadeFile& made) { return is_wanted(made) && same(made); });
}

void look_at_light(const ExpectedFile& file, const Manifest& manifest, FileFinding& finding) {
  const MadeFile* made = manifest.find(file.name, finding.digest);
  try {
    const double brightest = made ? made->brightest : brightest_in_file(file.path);
    finding.black = brightest <= (file.is_linear() ? kBrightestOfBlack : kBrightestOfBlackCodes);
    finding.not_finite = !std::isfinite(brightest);
  } catch (const InputError&) {
    throw;
  } catch (const TemporaryError&) {
    throw;
  } catch (const std::runtime_error&) {  // a decoder does not take it, whatever its digest
    finding.condition = FrameCondition::kDamaged;
  }
}

// `files` are one frame's, and `findings` what they were found to be.
void add_frame(std::span<const ExpectedFile> files, std::span<const FileFinding> findings,
               FolderFindings& all) {
  using enum FrameCondition;
  const int frame = files.front().frame;
  const FileFinding& worst = *std::ranges::min_element(findings, {}, &FileFinding::condition);
  all.frames[static_cast<std::size_t>(worst.condition)].push_back(frame);
  if (worst.condition == kUnreadable) {
    all.reasons[frame] = worst.reason;
    return;
  }
  bool linear = false, graded = false;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const FileFinding& finding = findings[k];
    if (finding.condition == kOther) all.others.push_back({frame, files[k].name, finding.reason});
    if (finding.condition == kOlder) (files[k].is_linear() ? linear : graded) = true;
    if (worst.condition == kGood && finding.black && !files[k].is_layer)
      (files[k].is_linear() ? all.black_linear : all.black_graded).push_back(frame);
  }
  if (linear || graded) (linear ? all.older_linear : all.older_graded).push_back(frame);
  if (worst.condition != kGood) return;
  if (std::ranges::any_of(findings, &FileFinding::not_finite)) all.not_finite.push_back(frame);
  if (std::ranges::any_of(findings, &FileFinding::unlike)) all.unlike.push_back(frame);
}

// Writes a number with its thousands grouped, as in 1,260.
std::string grouped(std::size_t number) {
  return number < 1000 ? fmt::format("{}", number)
                       : fmt::format("{},{:03}", grouped(number / 1000), number % 1000);
}

// Joins items by commas, and says how many more there are than `most`.  A single item more is kept,
// since "1 more" would hardly be shorter.
std::string joined(std::vector<std::string> items, std::size_t most) {
  if (items.size() > most + 1) {
    const std::size_t more = items.size() - most;
    items.resize(most);
    items.push_back(grouped(more) + " more");
  }
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) text += k + 1 < items.size() ? ", " : " and ";
    text += items[k];
  }
  return text;
}

std::string list_of_segments(const std::map<int, int>& frames_of_segments, std::size_t frames,
                             const char* work) {
  if (frames == 0) return {};
  constexpr std::size_t kMost = 8;
  std::vector<std::string> segments;
  segments.reserve(frames_of_segments.size());
  for (const auto& [segment, count] : frames_of_segments)
    segments.push_back(fmt::to_string(segment + 1));
  const char* plural = segments.size() > 1 ? "s" : "";
  return fmt::format("segment{} {}: {} frame{} will be {} again\n", plural,
                     joined(std::move(segments), kMost), grouped(frames), frames > 1 ? "s" : "",
                     work);
}

}  // namespace

FileFinding glance_at(const ExpectedFile& file, const Manifest& manifest) {
  return unless_unreadable([&]() -> FileFinding {
    struct stat status {};
    const bool there = stat(file.path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
    const auto size = static_cast<std::uint64_t>(status.st_size);
    const MadeFile* made =
        there ? manifest.find(file.name, size,
                              status.st_mtim.tv_sec * kNanosecondsOfSecond + status.st_mtim.tv_nsec)
              : nullptr;
    if (made && made->key == file.wanted.key) return {{FrameCondition::kGood}};
    FileFinding finding{check_frame(file.path, file.wanted, CheckDepth::kHead)};
    // The same key gives the same bytes, so a file of another size is damaged.
    if (finding.condition == FrameCondition::kGood &&
        is_unlike_all(manifest, file, [&](const MadeFile& line) { return line.size == size; }))
      finding.condition = FrameCondition::kDamaged;
    return finding;
  });
}

FileFinding examine_file(const ExpectedFile& file, const Manifest& manifest) {
  return unless_unreadable([&]() -> FileFinding {
    FileFinding finding{check_frame(file.path, file.wanted)};
    if (finding.condition != FrameCondition::kGood) return finding;
    finding.unlike = is_unlike_all(
        manifest, file, [&](const MadeFile& made) { return made.digest == finding.digest; });
    look_at_light(file, manifest, finding);
    return finding;
  });
}

std::vector<FileFinding> look_at_files(
    const std::vector<ExpectedFile>& files, int threads,
    const std::function<FileFinding(const ExpectedFile&)>& look) {
  std::vector<FileFinding> findings(files.size());
  in_parallel(static_cast<int>(files.size()), threads, [&](int k) {
    stop_if_interrupted();
    const auto at = static_cast<std::size_t>(k);
    findings[at] = look(files[at]);
  });
  return findings;
}

std::vector<int> joined_frames(std::initializer_list<const std::vector<int>*> lists) {
  std::set<int> frames;
  for (const auto* list : lists) frames.insert(list->begin(), list->end());
  return {frames.begin(), frames.end()};
}

std::vector<int> FolderFindings::to_make() const {
  using enum FrameCondition;
  return joined_frames({&of(kMissing), &of(kDamaged), &of(kOther), &of(kOlder)});
}

FolderFindings sum_up(const std::vector<ExpectedFile>& files,
                      const std::vector<FileFinding>& findings) {
  FolderFindings all;
  for (std::size_t first = 0, end = 0; first < files.size(); first = end) {
    while (end < files.size() && files[end].frame == files[first].frame) ++end;
    add_frame(std::span(files).subspan(first, end - first),
              std::span(findings).subspan(first, end - first), all);
  }
  return all;
}

FolderFindings survey_files(const std::vector<ExpectedFile>& files) {
  bool undamaged_seen = false;
  return sum_up(files, look_at_files(files, 1, [&](const ExpectedFile& file) -> FileFinding {
                  FrameCheck found = check_frame(file.path, file.wanted, CheckDepth::kHead);
                  if (found.condition != FrameCondition::kOther || undamaged_seen) return {found};
                  undamaged_seen =
                      check_frame(file.path, file.wanted).condition == FrameCondition::kOther;
                  if (!undamaged_seen) found.condition = FrameCondition::kDamaged;
                  return {found};
                }));
}

void refuse_to_replace(const FolderFindings& found, const FrameFolder& folder) {
  if (found.others.empty()) return;
  std::set<int> frames;
  for (const auto& other : found.others) frames.insert(other.frame);
  const WantedFrame wanted = folder.wanted({});
  throw InputError(fmt::format(
      "{}: {} good frame{} of another size, show or kind would be replaced, such as {} ({}); this "
      "run makes '{}', {} of {} x {} pixels. Another --out leaves them alone, --replace replaces "
      "them",
      folder.path().string(), grouped(frames.size()), frames.size() > 1 ? "s" : "",
      (folder.path() / found.others.front().name).string(), found.others.front().reason,
      one_line(wanted.title), wanted.projection, wanted.width, wanted.height));
}

std::map<int, int> by_segment(const std::vector<int>& frames, const Show& show) {
  std::map<int, int> counts;
  for (const int frame : frames) ++counts[frame_state(show, frame).segment];
  return counts;
}

std::string describe_work(const FolderFindings& found, const Show& show) {
  const auto lines = [&](const std::vector<int>& frames, const char* work) {
    return list_of_segments(by_segment(frames, show), frames.size(), work);
  };
  return lines(found.older_linear, "made") + lines(found.older_graded, "graded");
}

std::string describe_foreign(const std::vector<std::string>& files, const FrameFolder& folder) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (const bool unasked : {false, true}) {
    std::vector<std::string> names;
    for (const std::string& file : files)
      if (folder.is_of_unasked_layer(file) == unasked) names.push_back(printable(file));
    if (names.empty()) continue;
    const bool many = names.size() > 1;
    text += fmt::format("{}{} file{} {}, and {} left alone: ", text.empty() ? "" : "; ",
                        grouped(names.size()), many ? "s are" : " is",
                        unasked ? "of layers that the show no longer asks for" : "not this show's",
                        many ? "are" : "is");
    text += joined(std::move(names), kMost);
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace domefall
