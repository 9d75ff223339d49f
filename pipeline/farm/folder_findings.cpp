#include "pipeline/farm/folder_findings.h"

#include <algorithm>
#include <set>
#include <span>

#include "pipeline/deliver/in_parallel.h"

namespace domefall {
namespace {

// A FoundFrame is one frame's files, and what they were found to be.
struct FoundFrame {
  std::span<const ExpectedFile> files;
  std::span<const FileFinding> findings;

  bool any(FrameCondition condition) const {
    return std::ranges::any_of(findings,
                               [&](const FileFinding& f) { return f.condition == condition; });
  }
  bool any(bool FileFinding::*mark) const {
    return std::ranges::any_of(findings, [&](const FileFinding& f) { return f.*mark; });
  }
};

void add_stale(const FoundFrame& found, FolderFindings& all) {
  const int frame = found.files.front().frame;
  bool linear = false;
  for (std::size_t k = 0; k < found.files.size(); ++k)
    linear |= found.findings[k].condition == FrameCondition::kOlder &&
              found.files[k].path.extension() == ".exr";
  all.stale.push_back(frame);
  (linear ? all.stale_linear : all.stale_grades).push_back(frame);
}

void add_good(const FoundFrame& found, FolderFindings& all) {
  const int frame = found.files.front().frame;
  all.good.push_back(frame);
  for (std::size_t k = 0; k < found.files.size(); ++k)
    if (found.findings[k].black)
      (found.files[k].path.extension() == ".exr" ? all.black_linear : all.black_graded)
          .push_back(frame);
  if (found.any(&FileFinding::not_finite)) all.not_finite.push_back(frame);
  if (found.any(&FileFinding::unlike)) all.unlike.push_back(frame);
}

void add_frame(const FoundFrame& found, FolderFindings& all) {
  const int frame = found.files.front().frame;
  for (const FileFinding& finding : found.findings) {
    if (finding.unreadable.empty()) continue;
    all.unreadable.push_back(frame);
    all.reasons[frame] = finding.unreadable;
    return;
  }
  for (std::size_t k = 0; k < found.files.size(); ++k)
    if (found.findings[k].condition == FrameCondition::kOther)
      all.others_files.emplace_back(found.files[k].name);
  using enum FrameCondition;
  if (found.any(kMissing))
    all.missing.push_back(frame);
  else if (found.any(kDamaged))
    all.damaged.push_back(frame);
  else if (found.any(kOther))
    all.others.push_back(frame);
  else if (found.any(kOlder))
    add_stale(found, all);
  else
    add_good(found, all);
}

}  // namespace

std::vector<int> joined_frames(std::initializer_list<const std::vector<int>*> lists) {
  std::set<int> frames;
  for (const auto* list : lists) frames.insert(list->begin(), list->end());
  return {frames.begin(), frames.end()};
}

std::vector<int> FolderFindings::to_make() const {
  return joined_frames({&missing, &damaged, &others, &stale});
}

std::vector<FileFinding> look_at_files(const std::vector<ExpectedFile>& files,
                                       const Manifest& manifest, LookAtFile look, int threads,
                                       const std::function<void()>& step) {
  std::vector<FileFinding> findings(files.size());
  in_parallel(static_cast<int>(files.size()), threads, [&](int k) {
    step();
    const auto at = static_cast<std::size_t>(k);
    findings[at] = look(files[at], manifest);
  });
  return findings;
}

FolderFindings sum_up(const std::vector<ExpectedFile>& files,
                      const std::vector<FileFinding>& findings) {
  FolderFindings all;
  for (std::size_t first = 0, end = 0; first < files.size(); first = end) {
    while (end < files.size() && files[end].frame == files[first].frame) ++end;
    add_frame({std::span(files).subspan(first, end - first),
               std::span(findings).subspan(first, end - first)},
              all);
  }
  return all;
}

}  // namespace domefall
