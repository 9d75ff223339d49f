#include "pipeline/grade/grader.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>

#include "pipeline/colour/colour_space.h"
#include "pipeline/image/errors.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

struct Grader::Processor {
  ocio::ConstCPUProcessorRcPtr cpu;
};

namespace {

ocio::ConstConfigRcPtr read_config(const GradeSettings& settings) {
  const std::string file = settings.config.string();
  try {
    return ocio::Config::CreateFromFile(file.c_str());
  } catch (const ocio::Exception& error) {
    throw InputError(file + ": not an OpenColorIO configuration that can be used: " + error.what());
  }
}

template <class At>
std::string listed(int count, At at) {
  std::string list;
  for (int k = 0; k < count; ++k) list += (k ? ", '" : "'") + std::string(at(k)) + "'";
  return list;
}

std::string chosen_display(const ocio::Config& config, const GradeSettings& settings) {
  if (settings.display.empty()) return config.getDefaultDisplay();
  for (int k = 0; k < config.getNumDisplays(); ++k)
    if (settings.display == config.getDisplay(k)) return settings.display;
  throw InputError(settings.config.string() + " has no display '" + settings.display +
                   "'; it has " +
                   listed(config.getNumDisplays(), [&](int k) { return config.getDisplay(k); }));
}

std::string chosen_view(const ocio::Config& config, const GradeSettings& settings,
                        const std::string& display) {
  if (settings.view.empty()) return config.getDefaultView(display.c_str());
  const int count = config.getNumViews(display.c_str());
  const auto at = [&](int k) { return config.getView(display.c_str(), k); };
  for (int k = 0; k < count; ++k)
    if (settings.view == at(k)) return settings.view;
  throw InputError(settings.config.string() + " has no view '" + settings.view +
                   "' for the display '" + display + "'; it has " + listed(count, at));
}

bool changes_anything(const GradeSettings& s) {
  const std::array<double, 3> zeros{0, 0, 0}, ones{1, 1, 1};
  return s.slope != ones || s.offset != zeros || s.power != ones || s.saturation != 1;
}

ocio::TransformRcPtr space_change(const char* from, const char* to) {
  auto change = ocio::ColorSpaceTransform::Create();
  change->setSrc(from);
  change->setDst(to);
  return change;
}

// In the configuration's space for colour timing, ACEScct in ours.
void append_cdl(ocio::GroupTransform& group, const GradeSettings& settings) {
  auto cdl = ocio::CDLTransform::Create();
  cdl->setSlope(settings.slope.data());
  cdl->setOffset(settings.offset.data());
  cdl->setPower(settings.power.data());
  cdl->setSat(settings.saturation);
  group.appendTransform(space_change(kWorkingSpaceName, ocio::ROLE_COLOR_TIMING));
  group.appendTransform(cdl);
  group.appendTransform(space_change(ocio::ROLE_COLOR_TIMING, kWorkingSpaceName));
}

}  // namespace

Grader::Grader(const GradeSettings& settings) {
  const auto config = read_config(settings);
  display_ = chosen_display(*config, settings);
  view_ = chosen_view(*config, settings, display_);
  auto group = ocio::GroupTransform::Create();
  if (changes_anything(settings)) append_cdl(*group, settings);
  auto view = ocio::DisplayViewTransform::Create();
  view->setSrc(kWorkingSpaceName);
  view->setDisplay(display_.c_str());
  view->setView(view_.c_str());
  group->appendTransform(view);
  try {
    const auto processor = config->getProcessor(group);
    processor_ = std::make_shared<const Processor>(Processor{processor->getOptimizedCPUProcessor(
        ocio::BIT_DEPTH_F16, ocio::BIT_DEPTH_UINT16, ocio::OPTIMIZATION_DEFAULT)});
  } catch (const ocio::Exception& error) {
    throw InputError(settings.config.string() + ": the view '" + view_ + "' of the display '" +
                     display_ + "' cannot be made from " + kWorkingSpaceName + ": " + error.what());
  }
}

void Grader::grade_rows(const HalfFrame& in, GradedFrame& out, int y0, int y1) const {
  const long width = in.width, rows = y1 - y0;
  const auto half = static_cast<std::ptrdiff_t>(sizeof(Imath::half)),
             word = static_cast<std::ptrdiff_t>(sizeof(unsigned short));
  // OpenColorIO takes what it reads as void*, too.
  auto* from = const_cast<Imath::half*>(in.row(y0));
  const ocio::PackedImageDesc source(from, width, rows, 3, ocio::BIT_DEPTH_F16, half, 3 * half,
                                     3 * half * width);
  ocio::PackedImageDesc target(out.row(y0), width, rows, 3, ocio::BIT_DEPTH_UINT16, word, 3 * word,
                               3 * word * width);
  processor_->cpu->apply(source, target);
}

GradedFrame Grader::grade(const HalfFrame& in) const {
  GradedFrame out(in.width, in.height);
  grade_rows(in, out, 0, in.height);
  return out;
}

}  // namespace domefall
