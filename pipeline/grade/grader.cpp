#include "pipeline/grade/grader.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <mutex>
#include <vector>

#include "pipeline/colour/colour_space.h"
#include "pipeline/grade/config_check.h"
#include "pipeline/grade/display_curves.h"
#include "pipeline/grade/grade_table.h"
#include "pipeline/grade/trial.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

using Code = std::array<unsigned short, 3>;

void apply(const ocio::CPUProcessor& cpu, const Imath::half* in, unsigned short* out, long pixels) {
  constexpr std::ptrdiff_t half = sizeof(Imath::half), word = sizeof(unsigned short);
  // OpenColorIO takes void* even for what it only reads.
  const ocio::PackedImageDesc source(const_cast<Imath::half*>(in), pixels, 1, 3,
                                     ocio::BIT_DEPTH_F16, half, 3 * half, 3 * half * pixels);
  ocio::PackedImageDesc target(out, pixels, 1, 3, ocio::BIT_DEPTH_UINT16, word, 3 * word,
                               3 * word * pixels);
  cpu.apply(source, target);
}

Code graded_black(const ocio::CPUProcessor& cpu) {
  const Imath::half black[3] = {0.0f, 0.0f, 0.0f};
  Code code;
  apply(cpu, black, code.data(), 1);
  return code;
}

// The columns begin <= x < end, outside which a row is black.
struct Lit {
  int begin, end;
};

Lit lit_columns(const Imath::half* row, int width) {
  const auto is_black = [row](int x) {
    return (row[3 * x].bits() | row[3 * x + 1].bits() | row[3 * x + 2].bits()) == 0;
  };
  Lit lit{0, width};
  while (lit.begin < lit.end && is_black(lit.begin)) ++lit.begin;
  while (lit.begin < lit.end && is_black(lit.end - 1)) --lit.end;
  return lit;
}

void fill_black(unsigned short* row, int begin, int end, const Code& black) {
  for (int x = begin; x < end; ++x) std::copy(black.begin(), black.end(), row + 3 * x);
}

}  // namespace

struct Grader::Processor {
  ocio::ConstCPUProcessorRcPtr cpu;     // from half floats to 16 bits
  ocio::ConstCPUProcessorRcPtr floats;  // the same for floats
  Code black;

  Processor(ocio::ConstCPUProcessorRcPtr halves, ocio::ConstCPUProcessorRcPtr of_floats,
            Code of_black)
      : cpu(std::move(halves)), floats(std::move(of_floats)), black(of_black) {}

  mutable std::once_flag tabulated;
  mutable std::optional<GradeTable> table;

  const GradeTable& made_table() const {
    std::call_once(tabulated, [this] {
      table.emplace([this](const float* rgb, int pixels, float* codes) {
        std::copy_n(rgb, 3 * pixels, codes);
        ocio::PackedImageDesc image(codes, pixels, 1, 3);
        floats->apply(image);
      });
    });
    return *table;
  }

  // Grades a row by the table, and by the formulas what it does not hold.
  void look_up(const Imath::half* in, int pixels, unsigned short* out) const {
    constexpr int kMost = GradeTable::kMostPixels;
    const GradeTable& by = made_table();
    std::array<unsigned short, 3 * kMost + 1> codes;
    std::array<int, kMost> missed;
    std::array<Imath::half, 3 * kMost> rest;
    for (int first = 0; first < pixels; first += kMost, in += 3 * kMost, out += 3 * kMost) {
      const int count = std::min(kMost, pixels - first);
      const int misses = by.look_up(in, count, codes.data(), missed.data());
      std::copy_n(codes.begin(), 3 * count, out);
      if (misses == 0) continue;
      for (int k = 0; k < misses; ++k) std::copy_n(in + 3 * missed[k], 3, &rest[3 * k]);
      apply(*cpu, rest.data(), codes.data(), misses);
      for (int k = 0; k < misses; ++k) std::copy_n(&codes[3 * k], 3, out + 3 * missed[k]);
    }
  }
};

namespace {

// Removes a user's settings for other programs, which would make one node's frames differ from
// another's.
void ignore_environment() {
  for (const char* name : {"OCIO_ACTIVE_DISPLAYS", "OCIO_ACTIVE_VIEWS", "OCIO_INACTIVE_COLORSPACES",
                           "OCIO_OPTIMIZATION_FLAGS"})
    ocio::UnsetEnvVariable(name);
}

ocio::ConstConfigRcPtr read_config(const std::string& file) {
  try {
    return ocio::Config::CreateFromFile(file.c_str());
  } catch (const ocio::Exception& error) {
    throw InputError(file + ": not an OpenColorIO configuration that can be used: " + error.what());
  }
}

// The names at(0) to at(count - 1) in quotes, for a message.
template <class At>
std::string listed(int count, At at) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) names.push_back(fmt::format("'{}'", at(k)));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string chosen_display(const ocio::Config& config, const GradeSettings& settings) {
  if (settings.display.empty()) return config.getDefaultDisplay();
  for (int k = 0; k < config.getNumDisplays(); ++k)
    if (settings.display == config.getDisplay(k)) return settings.display;
  throw InputError(
      fmt::format("{} has no display '{}'; it has {}", settings.config.string(), settings.display,
                  listed(config.getNumDisplays(), [&](int k) { return config.getDisplay(k); })));
}

std::string view_name(const ocio::Config& config, const GradeSettings& settings,
                      const std::string& display) {
  if (settings.view.empty()) return config.getDefaultView(display.c_str());
  const int count = config.getNumViews(display.c_str());
  const auto at = [&](int k) { return config.getView(display.c_str(), k); };
  for (int k = 0; k < count; ++k)
    if (settings.view == at(k)) return settings.view;
  throw InputError(fmt::format("{} has no view '{}' for the display '{}'; it has {}",
                               settings.config.string(), settings.view, display,
                               listed(count, at)));
}

using Direction = ocio::TransformDirection;

void append_builtin(ocio::GroupTransform& group, const char* style,
                    Direction direction = ocio::TRANSFORM_DIR_FORWARD) {
  auto builtin = ocio::BuiltinTransform::Create();
  builtin->setStyle(style);
  builtin->setDirection(direction);
  group.appendTransform(builtin);
}

constexpr const char *kToAp0 = "ACEScg_to_ACES2065-1", *kAcescct = "ACEScct_to_ACES2065-1";

// Appends the CDL in ACEScct, which OpenColorIO knows whatever the configuration has.
void append_cdl(ocio::GroupTransform& group, const Cdl& values) {
  auto cdl = ocio::CDLTransform::Create();
  cdl->setSlope(values.slope.data());
  cdl->setOffset(values.offset.data());
  cdl->setPower(values.power.data());
  cdl->setSat(values.saturation);
  append_builtin(group, kToAp0);
  append_builtin(group, kAcescct, ocio::TRANSFORM_DIR_INVERSE);
  group.appendTransform(cdl);
  append_builtin(group, kAcescct);
  append_builtin(group, kToAp0, ocio::TRANSFORM_DIR_INVERSE);
}

bool names_acescg(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find("acescg") != std::string::npos;
}

// Appends what takes the working space to a space of the configuration, and returns that space.
// What a role for interchange names is exact.  Older configurations have none, and of these
// scene_linear is ACEScg if it is called so, and linear Rec.709 otherwise, as in those that were
// shipped with compositing programs.
std::string append_change_to(ocio::GroupTransform& group, const ocio::Config& config,
                             const std::string& file) {
  if (config.hasRole(ocio::ROLE_INTERCHANGE_SCENE)) {
    append_builtin(group, kToAp0);
    return ocio::ROLE_INTERCHANGE_SCENE;
  }
  if (const auto space = config.getColorSpace(kWorkingSpaceName)) return space->getName();
  if (config.hasRole(ocio::ROLE_INTERCHANGE_DISPLAY)) {
    append_builtin(group, kToAp0);
    append_builtin(group, "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    return ocio::ROLE_INTERCHANGE_DISPLAY;
  }
  if (!config.hasRole(ocio::ROLE_SCENE_LINEAR))
    throw InputError(file +
                     ": has none of the roles aces_interchange, cie_xyz_d65_interchange and "
                     "scene_linear, by one of which frames would enter it");
  const auto linear = config.getColorSpace(ocio::ROLE_SCENE_LINEAR);
  if (!names_acescg(linear->getName()))
    append_builtin(group, "UTILITY - ACES-AP1_to_LINEAR-REC709_BFD");
  return linear->getName();
}

// What a view shows of data, such as Raw, are the frame's own values.
bool is_data(const ocio::Config& config, const std::string& display, const std::string& view) {
  const auto space =
      config.getColorSpace(config.getDisplayViewColorSpaceName(display.c_str(), view.c_str()));
  return space && space->isData();
}

struct View {
  ocio::ConstConfigRcPtr config;
  std::string display, name;
  ocio::ConstTransformRcPtr transform;  // from the working space, with the show's own CDL
};

View chosen_view(const ocio::ConstConfigRcPtr& config, const GradeSettings& settings) {
  View chosen{config, chosen_display(*config, settings), {}, {}};
  chosen.name = view_name(*config, settings, chosen.display);
  auto group = ocio::GroupTransform::Create();
  if (settings.cdl != Cdl{}) append_cdl(*group, settings.cdl);
  auto view = ocio::DisplayViewTransform::Create();
  // From one space of data to another nothing is changed.
  const std::string source =
      is_data(*config, chosen.display, chosen.name)
          ? config->getDisplayViewColorSpaceName(chosen.display.c_str(), chosen.name.c_str())
          : append_change_to(*group, *config, settings.config.string());
  view->setSrc(source.c_str());
  view->setDisplay(chosen.display.c_str());
  view->setView(chosen.name.c_str());
  group->appendTransform(view);
  chosen.transform = group;
  return chosen;
}

// Calls what OpenColorIO may refuse, and says of which view it speaks.
template <class Step>
void explained(const View& view, const std::string& file, Step step) {
  const auto message = [&](const ocio::Exception& error) {
    return fmt::format("{}: the view '{}' of the display '{}' cannot be made from {}: {}", file,
                       view.name, view.display, kWorkingSpaceName, error.what());
  };
  try {
    step();
  } catch (const ocio::ExceptionMissingFile& error) {
    throw TemporaryError(message(error));
  } catch (const ocio::Exception& error) {
    throw InputError(message(error));
  }
}

void check(const GradeSettings& settings) {
  const std::string file = settings.config.string();
  const auto config = read_config(file);
  check_variables(*config, file);
  check_files(*config, file);
  const View view = chosen_view(config, settings);
  explained(view, file,
            [&] { check_values(*config, *config->getProcessor(view.transform), file); });
}

}  // namespace

// What further graders of the show are made from.
struct Grader::Source {
  ocio::ConstConfigRcPtr config;
  GradeSettings settings;
};

Grader::Grader(const GradeSettings& settings) {
  const std::string file = settings.config.string();
  if (file.empty()) throw InputError("no OpenColorIO configuration is named");
  if (RegularFile(settings.config).size() == 0) throw InputError(file + ": the file is empty");
  ignore_environment();
  if (!settings.shipped) try_elsewhere(file, [&] { check(settings); });
  GradeSettings plain = settings;
  plain.cdl = {};
  const View view = chosen_view(read_config(file), plain);
  source_ = std::make_shared<const Source>(Source{view.config, settings});
  display_ = view.display;
  view_ = view.name;
  explained(view, file, [&] {
    transform_id_ = view.config->getProcessor(view.transform)->getCacheID();
    if (settings.dome.light == DomeSettings::Light::kNone) return;
    dome_light_ = std::make_shared<const DomeLight>(
        settings.dome, display_curves(*view.config, display_, view_, file));
    transform_id_ += fmt::format(
        " dome light: {} {}",
        settings.dome.light == DomeSettings::Light::kSimulate ? "simulate" : "compensate",
        settings.dome.reflectance);
  });
  *this = with(settings.cdl, true);
}

Grader Grader::with(const Cdl& cdl, bool lasts) const {
  Grader other = *this;
  other.lasts_ = lasts;
  if (processor_ && cdl == cdl_) return other;
  other.cdl_ = cdl;
  GradeSettings settings = source_->settings;
  settings.cdl = cdl;
  const View view = chosen_view(source_->config, settings);
  explained(view, settings.config.string(), [&] {
    const auto processor = view.config->getProcessor(view.transform);
    const auto cpu = processor->getOptimizedCPUProcessor(
        ocio::BIT_DEPTH_F16, ocio::BIT_DEPTH_UINT16, ocio::OPTIMIZATION_DEFAULT);
    const auto floats = processor->getOptimizedCPUProcessor(
        ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32, ocio::OPTIMIZATION_DEFAULT);
    other.processor_ = std::make_shared<const Processor>(cpu, floats, graded_black(*cpu));
  });
  return other;
}

bool Grader::by_table(const HalfFrame& in) const {
  constexpr long kMany = 1L << 21;
  return lasts_ && static_cast<long>(in.width) * in.height >= kMany;
}

std::optional<TableError> Grader::table_error(const HalfFrame& in) const {
  if (!by_table(in)) return std::nullopt;
  const GradeTable& table = processor_->made_table();
  return TableError{table.error(), table.held()};
}

// The corners of a domemaster, a fifth of it, are black, and black is graded once: only the columns
// from a row's first light to its last are graded one by one.
void Grader::grade_rows(const HalfFrame& in, int y0, int y1, unsigned short* out) const {
  const bool table = by_table(in);
  for (int y = y0; y < y1; ++y, out += static_cast<std::ptrdiff_t>(3) * in.width) {
    const Lit lit = lit_columns(in.row(y), in.width);
    fill_black(out, 0, lit.begin, processor_->black);
    const int pixels = lit.end - lit.begin;
    if (table)
      processor_->look_up(in.row(y) + 3 * lit.begin, pixels, out + 3 * lit.begin);
    else if (pixels > 0)
      apply(*processor_->cpu, in.row(y) + 3 * lit.begin, out + 3 * lit.begin, pixels);
    fill_black(out, lit.end, in.width, processor_->black);
  }
}

GradedFrame Grader::grade(const HalfFrame& in) const {
  GradedFrame out(in.width, in.height);
  grade_rows(in, 0, in.height, out.row(0));
  return out;
}

}  // namespace domefall
