#include "pipeline/grade/grader.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/grade/config_check.h"
#include "pipeline/grade/grade_table.h"
#include "pipeline/grade/pixel_planes.h"
#include "pipeline/grade/view_transform.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

// This number grows whenever any pixel's code changes, so that earlier frames are graded again.
constexpr int kCodesVersion = 3;

using Code = std::array<unsigned short, 3>;

void send_halves_through(const ocio::CPUProcessor& cpu, const Imath::half* in, unsigned short* out,
                         long pixels) {
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
  send_halves_through(cpu, black, code.data(), 1);
  return code;
}

// These are the columns begin <= x < end, outside which a row is black.
struct Lit {
  int begin, end;
};

bool is_black(const Imath::half* rgb) {
  return (rgb[0].bits() | rgb[1].bits() | rgb[2].bits()) == 0;
}

bool are_black(const Imath::half* rgb) {
  std::array<std::uint64_t, 3> words;
  std::memcpy(words.data(), rgb, sizeof words);
  return (words[0] | words[1] | words[2]) == 0;
}

Lit lit_columns(const Imath::half* row, int width) {
  Lit lit{0, width};
  while (lit.end - lit.begin >= 4 && are_black(row + 3 * lit.begin)) lit.begin += 4;
  while (lit.end - lit.begin >= 4 && are_black(row + 3 * (lit.end - 4))) lit.end -= 4;
  while (lit.begin < lit.end && is_black(row + 3 * lit.begin)) ++lit.begin;
  while (lit.begin < lit.end && is_black(row + 3 * (lit.end - 1))) --lit.end;
  return lit;
}

void fill_black(unsigned short* row, int begin, int end, const Code& black) {
  for (int x = begin; x < end; ++x) std::copy(black.begin(), black.end(), row + 3 * x);
}

// Returns samples of the colours that a table holds, at every brightness that a display shows.
std::vector<Imath::half> sampled_colours() {
  std::vector<Imath::half> rgb;
  for (int stop = -24; stop < 12; ++stop)
    for (const float grey : {0.3f, 0.5f, 0.8f, 1.0f})
      for (const float hue : {0.0f, 0.4f, 1.0f})
        for (const auto& at : {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1}}) {
          const float most = std::exp2(0.5f * static_cast<float>(stop));
          const std::array<float, 3> values{most, most * (grey + hue * (1 - grey)), most * grey};
          for (const int c : at) rgb.emplace_back(values[static_cast<std::size_t>(c)]);
        }
  return rgb;
}

}  // namespace

// Further graders of the show are made from this, and share it.
struct Grader::Source {
  ocio::ConstConfigRcPtr config;
  GradeSettings settings;
  std::unique_ptr<GradeTable> table;  // of the view alone, so that every CDL goes through it
};

struct Grader::Processor {
  ocio::ConstCPUProcessorRcPtr cpu;  // from half floats to 16 bits, CDL and all
  Code black;
  std::optional<Cdl> cdl;  // nothing if it changes nothing

  Processor(ocio::ConstCPUProcessorRcPtr halves, const Cdl& of_frame)
      : cpu(std::move(halves)), black(graded_black(*cpu)) {
    if (of_frame != Cdl{}) cdl.emplace(of_frame);
  }

  // Grades a row by the table, and by the formulas what it does not hold.
  void look_up(const GradeTable& table, const Imath::half* in, int pixels,
               unsigned short* out) const {
    constexpr int kMost = PixelPlanes::kSize;
    std::array<unsigned short, 3 * kMost + 1> last;
    for (; pixels > kMost; pixels -= kMost, in += 3 * kMost, out += 3 * kMost)
      look_up_some(table, in, kMost, out);
    look_up_some(table, in, pixels, last.data());
    std::copy_n(last.begin(), 3 * pixels, out);
  }

  // Returns the largest difference between table and formulas, as a part of white, over sampled
  // colours.
  double measured_error(const GradeTable& table) const {
    static const std::vector<Imath::half> colours = sampled_colours();
    const int pixels = static_cast<int>(colours.size() / 3);
    std::vector<unsigned short> quick(colours.size()), exact(colours.size());
    look_up(table, colours.data(), pixels, quick.data());
    send_halves_through(*cpu, colours.data(), exact.data(), pixels);
    int most = 0;
    for (std::size_t k = 0; k < quick.size(); ++k)
      most = std::max(most, std::abs(quick[k] - exact[k]));
    return most / 65535.0;
  }

  // Returns the largest known error of the table with this CDL, which the table knows nothing of.
  double error(const GradeTable& table) const {
    if (!cdl) return table.error();
    std::call_once(measured_, [&] { error_ = measured_error(table); });
    return std::max(error_, table.error());
  }

 private:
  // out[] has room for one value more, which is overwritten.
  void look_up_some(const GradeTable& table, const Imath::half* in, int count,
                    unsigned short* out) const {
    constexpr int kMost = PixelPlanes::kSize;
    PixelPlanes planes;
    const int blacks = split_pixels(in, count, planes);
    if (blacks == count) return fill_black(out, 0, count, black);
    if (cdl) apply_cdl(*cdl, planes, count);
    std::array<int, kMost + 1> missed;
    const int misses = table.look_up(planes, count, out, missed.data());
    if (cdl && blacks > 0)
      for (int k = 0; k < count; ++k)
        if (is_black(in + 3 * k)) fill_black(out, k, k + 1, black);
    if (misses == 0) return;
    std::array<Imath::half, 3 * kMost> rest;
    std::array<unsigned short, 3 * kMost> codes;
    for (int k = 0; k < misses; ++k) std::copy_n(in + 3 * missed[k], 3, &rest[3 * k]);
    send_halves_through(*cpu, rest.data(), codes.data(), misses);
    for (int k = 0; k < misses; ++k) std::copy_n(&codes[3 * k], 3, out + 3 * missed[k]);
  }

  mutable std::once_flag measured_;
  mutable double error_ = 0;
};

namespace {

// Removes a user's settings for other programs, which would make one node's frames differ from
// another's.
void ignore_environment() {
  for (const char* name : {"OCIO_ACTIVE_DISPLAYS", "OCIO_ACTIVE_VIEWS", "OCIO_INACTIVE_COLORSPACES",
                           "OCIO_OPTIMIZATION_FLAGS"})
    ocio::UnsetEnvVariable(name);
}

std::unique_ptr<GradeTable> table_of(const ocio::Processor& processor) {
  const auto floats = processor.getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                                         ocio::OPTIMIZATION_DEFAULT);
  return std::make_unique<GradeTable>([floats](const float* rgb, int pixels, float* codes) {
    std::copy_n(rgb, 3 * pixels, codes);
    ocio::PackedImageDesc image(codes, pixels, 1, 3);
    floats->apply(image);
  });
}

void check(const GradeSettings& settings) {
  const std::string file = settings.config.string();
  const auto config = read_config(file);
  check_variables(*config, file);
  check_files(*config, file);
  const ViewTransform view = chosen_view(config, settings);
  explained(view, file,
            [&] { check_values(*config, *config->getProcessor(view.transform), file); });
}

}  // namespace

std::string ocio_note(const GradeSettings& settings) {
  const char* const named = std::getenv("OCIO");  // NOLINT(concurrency-mt-unsafe)
  if (!settings.shipped || !named || *named == '\0') return {};
  return fmt::format(
      "OCIO={} is not read; grade: {{config: FILE}} in the show names a configuration", named);
}

Grader::Grader(const GradeSettings& settings) {
  const std::string file = settings.config.string();
  if (file.empty()) throw InputError("no OpenColorIO configuration is named");
  if (RegularFile(settings.config).size() == 0) throw InputError(file + ": the file is empty");
  ignore_environment();
  if (!settings.shipped) try_in_child(file, [&] { check(settings); });
  GradeSettings plain = settings;
  plain.cdl = {};
  const ViewTransform view = chosen_view(read_config(file), plain);
  display_ = view.display;
  view_ = view.name;
  explained(view, file, [&] {
    const auto processor = view.config->getProcessor(view.transform);
    transform_id_ = fmt::format("{} {}", kCodesVersion, processor->getCacheID());
    source_ = std::make_shared<const Source>(Source{view.config, settings, table_of(*processor)});
    colour_ = display_colour(*view.config, display_, view_);
    if (settings.dome.light == DomeSettings::Light::kNone) return;
    dome_light_ = std::make_shared<const DomeLight>(
        settings.dome, display_curves(*view.config, display_, view_, file));
    transform_id_ += fmt::format(
        " dome light: {} {}",
        settings.dome.light == DomeSettings::Light::kSimulate ? "simulate" : "compensate",
        settings.dome.reflectance);
  });
  *this = with(settings.cdl);
}

Grader Grader::with(const Cdl& cdl) const {
  if (processor_ && cdl == cdl_) return *this;
  Grader other = *this;
  other.cdl_ = cdl;
  GradeSettings settings = source_->settings;
  settings.cdl = cdl;
  const ViewTransform view = chosen_view(source_->config, settings);
  explained(view, settings.config.string(), [&] {
    const auto cpu = view.config->getProcessor(view.transform)
                         ->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F16, ocio::BIT_DEPTH_UINT16,
                                                    ocio::OPTIMIZATION_DEFAULT);
    other.processor_ = std::make_shared<const Processor>(cpu, cdl);
  });
  return other;
}

Grader Grader::as_for(int width, int height) const {
  Grader other = *this;
  other.pixels_ = static_cast<long>(width) * height;
  return other;
}

const GradeTable* Grader::table_for(const HalfFrame& in) const {
  constexpr long kMany = 1L << 21;
  const long pixels = pixels_ > 0 ? pixels_ : static_cast<long>(in.width) * in.height;
  if (pixels < kMany) return nullptr;
  GradeTable& table = *source_->table;
  table.make();
  return processor_->error(table) < GradeTable::kMostError ? &table : nullptr;
}

std::optional<TableError> Grader::table_error(const HalfFrame& in) const {
  const GradeTable* table = table_for(in);
  if (!table) return std::nullopt;
  return TableError{processor_->error(*table), table->held()};
}

// The corners of a domemaster, a fifth of it, are black, and black is graded once.  So only the
// columns from a row's first light to its last are graded one by one.
void Grader::grade_rows(const HalfFrame& in, int y0, int y1, unsigned short* out) const {
  const GradeTable* table = table_for(in);
  for (int y = y0; y < y1; ++y, out += static_cast<std::ptrdiff_t>(3) * in.width) {
    const Lit lit = lit_columns(in.row(y), in.width);
    fill_black(out, 0, lit.begin, processor_->black);
    const int pixels = lit.end - lit.begin;
    if (table)
      processor_->look_up(*table, in.row(y) + 3 * lit.begin, pixels, out + 3 * lit.begin);
    else if (pixels > 0)
      send_halves_through(*processor_->cpu, in.row(y) + 3 * lit.begin, out + 3 * lit.begin, pixels);
    fill_black(out, lit.end, in.width, processor_->black);
  }
}

GradedFrame Grader::grade(const HalfFrame& in) const {
  GradedFrame out(in.width, in.height);
  grade_rows(in, 0, in.height, out.row(0));
  return out;
}

}  // namespace domefall
