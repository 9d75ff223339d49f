#include "pipeline/cli/frame_survey.h"

#include <fmt/format.h>

#include "pipeline/cli/interruption.h"
#include "pipeline/image/errors.h"
#include "pipeline/show/frame_state.h"

namespace domefall {
namespace {

// A Surveyor looks at files one by one.  It reads the whole of those that may have to be protected,
// until it finds one that must be.
class Surveyor {
 public:
  explicit Surveyor(FrameSurvey& survey) : survey_(survey) {}

  FrameCondition look(const std::filesystem::path& file, const WantedFrame& wanted) {
    const FrameCondition condition = claimed_condition(file, wanted);
    if (condition != FrameCondition::kOther) return condition;
    if (survey_.first_other.empty()) {
      if (examine_frame(file, wanted) != FrameCondition::kOther) return FrameCondition::kDamaged;
      survey_.first_other = file;
      survey_.first_difference = describe_difference(file, wanted);
    }
    return condition;
  }

 private:
  FrameSurvey& survey_;
};

// Writes a number with its thousands grouped, as in 1,260.
std::string grouped(int number) {
  return number < 1000 ? fmt::format("{}", number)
                       : fmt::format("{},{:03}", grouped(number / 1000), number % 1000);
}

std::string joined(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) text += k + 1 < items.size() ? ", " : " and ";
    text += items[k];
  }
  return text;
}

// Keeps the first `most` items, and says how many more there are.  A single item more is kept,
// since "1 more" would hardly be shorter.
std::vector<std::string> shortened_list(std::vector<std::string> items, std::size_t most) {
  if (items.size() <= most + 1) return items;
  const std::size_t more = items.size() - most;
  items.resize(most);
  items.push_back(fmt::format("{} more", grouped(static_cast<int>(more))));
  return items;
}

std::string list_of_segments(const std::map<int, int>& frames_of_segments, const char* work) {
  if (frames_of_segments.empty()) return {};
  std::vector<std::string> segments;
  int frames = 0;
  for (const auto& [segment, count] : frames_of_segments) {
    segments.push_back(fmt::to_string(segment + 1));
    frames += count;
  }
  constexpr std::size_t kMost = 8;
  return fmt::format("segment{} {}: {} frame{} will be {} again\n", segments.size() > 1 ? "s" : "",
                     joined(shortened_list(segments, kMost)), grouped(frames),
                     frames > 1 ? "s" : "", work);
}

}  // namespace

FrameSurvey survey_frames(const FrameFolder& folder, const Show& show, const FrameKeys& keys,
                          const std::vector<int>& frames, bool renders) {
  FrameSurvey survey;
  Surveyor surveyor(survey);
  for (const int number : frames) {
    stop_if_interrupted();
    const FrameState state = frame_state(show, number);
    const std::string key = keys.scene(state);
    auto linear = FrameCondition::kGood, graded = FrameCondition::kGood;
    if (renders && folder.has_linear())
      linear = surveyor.look(folder.linear(number), folder.wanted(key));
    if (folder.has_graded())
      graded = surveyor.look(folder.graded(number), folder.wanted(keys.graded(key, state)));
    if (linear == FrameCondition::kOther || graded == FrameCondition::kOther) ++survey.others;
    if (linear == FrameCondition::kOlder)
      ++survey.older[state.segment];
    else if (graded == FrameCondition::kOlder)
      ++survey.older_grades[state.segment];
    if (linear != FrameCondition::kGood || graded != FrameCondition::kGood)
      survey.to_make.push_back(number);
  }
  return survey;
}

void refuse_to_replace(const FrameSurvey& survey, const FrameFolder& folder) {
  if (survey.first_other.empty()) return;
  const WantedFrame wanted = folder.wanted({});
  throw InputError(fmt::format(
      "{}: {} good frame{} of another size, show or kind would be replaced, such as {} ({}); this "
      "run makes '{}', {} of {} x {} pixels. Another --out leaves them alone, --replace replaces "
      "them",
      folder.path().string(), grouped(survey.others), survey.others > 1 ? "s" : "",
      survey.first_other.string(), survey.first_difference, one_line(wanted.title),
      wanted.projection, wanted.width, wanted.height));
}

std::string describe_work(const FrameSurvey& survey) {
  return list_of_segments(survey.older, "made") + list_of_segments(survey.older_grades, "graded");
}

std::string describe_strangers(const std::vector<std::string>& files) {
  constexpr std::size_t kMost = 3;
  const bool many = files.size() > 1;
  return fmt::format("{} file{} not this show's, and {} left alone: {}\n",
                     grouped(static_cast<int>(files.size())), many ? "s are" : " is",
                     many ? "are" : "is", joined(shortened_list(files, kMost)));
}

std::string describe_strangers(const FrameFolder& folder) {
  const auto found = folder.strangers();
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const auto& file : found) names.push_back(file.string());
  return names.empty() ? std::string() : folder.path().string() + ": " + describe_strangers(names);
}

}  // namespace domefall
