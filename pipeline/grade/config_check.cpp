#include "pipeline/grade/config_check.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

void check_file(const ocio::Config& config, const char* named, const std::string& name) {
  std::string found;
  try {
    found = config.getCurrentContext()->resolveFileLocation(named);
  } catch (const ocio::Exception&) {
    return;  // A missing file matters only to those who use it, whom OpenColorIO tells.
  }
  try {
    if (RegularFile(found).size() > 0) return;
  } catch (const InputError& error) {
    throw InputError(name + ": names " + error.what());
  }
  throw InputError(name + ": names " + found + ": the file is empty");
}

// A group holds further transforms, which may be groups.  Any other transform stands alone.
void check_transform(const ocio::Config& config, const ocio::ConstTransformRcPtr& transform,
                     const std::string& name) {
  if (!transform) return;
  if (const auto group = std::dynamic_pointer_cast<const ocio::GroupTransform>(transform))
    for (int k = 0; k < group->getNumTransforms(); ++k)
      check_transform(config, group->getTransform(k), name);
  if (const auto file = std::dynamic_pointer_cast<const ocio::FileTransform>(transform))
    check_file(config, file->getSrc(), name);
}

constexpr float kLargestHalf = 65504, kBright = 1024;

// The pixels are RGB, greys of all magnitudes, and colours between black, small and large values.
std::vector<float> probes() {
  std::vector<float> rgb{1, 1, 1};
  for (float v = kLargestHalf; v > 1e-7f; v /= 1.07f) rgb.insert(rgb.end(), 3, v);
  constexpr std::array kLevels{0.0f, 6e-8f, 1e-3f, 0.18f, 0.5f, 1.0f, 16.0f, kBright, kLargestHalf};
  for (const float r : kLevels)
    for (const float g : kLevels)
      for (const float b : kLevels) rgb.insert(rgb.end(), {r, g, b});
  return rgb;
}

// Says whether no value of the pixel at `at` is NaN and, unless the pixel was above kBright, none
// is infinite.
bool is_sound(const std::vector<float>& before, const std::vector<float>& after, std::size_t at) {
  bool bright = false, infinite = false;
  for (std::size_t c = at; c < at + 3; ++c) {
    if (std::isnan(after[c])) return false;
    bright |= before[c] > kBright;
    infinite |= std::isinf(after[c]);
  }
  return bright || !infinite;
}

// Says whether OpenColorIO will replace the variable in the text, as $NAME, ${NAME} or %NAME%.
bool refers_to(std::string_view text, const std::string& variable) {
  return text.find("$" + variable) != std::string_view::npos ||
         text.find("${" + variable + "}") != std::string_view::npos ||
         text.find("%" + variable + "%") != std::string_view::npos;
}

}  // namespace

// From each variable the search follows what its value refers to, and visits each other variable at
// most once.
void check_variables(const ocio::Config& config, const std::string& name) {
  const auto context = config.getCurrentContext();
  const int count = context->getNumStringVars();
  for (int first = 0; first < count; ++first) {
    std::vector<bool> seen(static_cast<std::size_t>(count), false);
    for (std::vector<int> left{first}; !left.empty();) {
      const std::string value = context->getStringVarByIndex(left.back());
      left.pop_back();
      if (value.find_first_of("$%") == std::string::npos) continue;
      for (int other = 0; other < count; ++other) {
        const auto at = static_cast<std::size_t>(other);
        if (seen[at] || !refers_to(value, context->getStringVarNameByIndex(other))) continue;
        if (other == first)
          throw InputError(fmt::format("{}: the variable {} refers to itself", name,
                                       context->getStringVarNameByIndex(first)));
        seen[at] = true;
        left.push_back(other);
      }
    }
  }
}

void check_files(const ocio::Config& config, const std::string& name) {
  const auto check = [&](const ocio::ConstTransformRcPtr& transform) {
    check_transform(config, transform, name);
  };
  const int spaces =
      config.getNumColorSpaces(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL);
  for (int k = 0; k < spaces; ++k) {
    const auto space = config.getColorSpace(
        config.getColorSpaceNameByIndex(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL, k));
    check(space->getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE));
    check(space->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE));
  }
  for (int k = 0; k < config.getNumLooks(); ++k) {
    const auto look = config.getLook(config.getLookNameByIndex(k));
    check(look->getTransform());
    check(look->getInverseTransform());
  }
  for (int k = 0; k < config.getNumViewTransforms(); ++k) {
    const auto view = config.getViewTransform(config.getViewTransformNameByIndex(k));
    check(view->getTransform(ocio::VIEWTRANSFORM_DIR_TO_REFERENCE));
    check(view->getTransform(ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE));
  }
  for (int k = 0; k < config.getNumNamedTransforms(ocio::NAMEDTRANSFORM_ALL); ++k) {
    const auto named =
        config.getNamedTransform(config.getNamedTransformNameByIndex(ocio::NAMEDTRANSFORM_ALL, k));
    check(named->getTransform(ocio::TRANSFORM_DIR_FORWARD));
    check(named->getTransform(ocio::TRANSFORM_DIR_INVERSE));
  }
}

void check_values(const ocio::Config& config, const ocio::Processor& processor,
                  const std::string& name) {
  const std::vector<float> first = probes();
  std::vector<float> values = first;
  const auto steps = processor.createGroupTransform();
  for (int k = 0; k < steps->getNumTransforms(); ++k) {
    const auto cpu = config.getProcessor(steps->getTransform(k))->getDefaultCPUProcessor();
    ocio::PackedImageDesc image(values.data(), static_cast<long>(values.size() / 3), 1, 3);
    cpu->apply(image);
    for (std::size_t at = 0; at < values.size(); at += 3)
      if (!is_sound(first, values, at))
        throw InputError(
            fmt::format("{}: step {} of {} of the view makes ({:g}, {:g}, {:g}) of the pixel "
                        "({:g}, {:g}, {:g})",
                        name, k + 1, steps->getNumTransforms(), values[at], values[at + 1],
                        values[at + 2], first[at], first[at + 1], first[at + 2]));
  }
}

}  // namespace domefall
