#include "pipeline/show/file/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/show/file/usd_stage.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

// Returns a rotation by an angle in degrees about the axis x, y or z (0, 1, 2).
M33d about(int axis, double degrees) {
  const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree);
  if (axis == 0) return from_columns({1, 0, 0}, {0, c, s}, {0, -s, c});
  if (axis == 1) return from_columns({c, 0, -s}, {0, 1, 0}, {s, 0, c});
  return from_columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
}

// ---- .chan ----

// Returns the numbers of a line, or nothing for one without any.
std::vector<double> numbers_of(std::string_view line, const std::string& place) {
  std::vector<double> numbers;
  constexpr std::string_view kBlanks = " \t\r,";
  for (std::size_t at = line.find_first_not_of(kBlanks); at < line.size() && line[at] != '#';) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    const std::string_view word = line.substr(at, end - at);
    double number = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(number))
      throw InputError(fmt::format("{}: '{}' is no number", place, word));
    numbers.push_back(number);
    at = line.find_first_not_of(kBlanks, end);
  }
  return numbers;
}

std::vector<CameraSample> read_chan(const std::string& file, std::string_view text,
                                    double frames_per_second) {
  constexpr std::size_t kLeast = 7;  // frame, place, angles
  std::vector<CameraSample> samples;
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string place = fmt::format("{}:{}", file, ++line);
    const std::vector<double> n = numbers_of(text.substr(at, end - at), place);
    at = end + 1;
    if (n.empty()) continue;
    if (n.size() < kLeast)
      throw InputError(place +
                       ": a camera has a frame, a place and three angles in each line "
                       "(frame tx ty tz rx ry rz)");
    const CameraSample sample{n[0] / frames_per_second,
                              about(1, n[5]) * about(0, n[4]) * about(2, n[6])};
    if (!samples.empty() && !(sample.at_s > samples.back().at_s))
      throw InputError(
          fmt::format("{}: frame {:g} does not come after the one before", place, n[0]));
    samples.push_back(sample);
  }
  if (samples.empty()) throw InputError(file + ": holds no frames of a camera");
  return samples;
}

// ---- USD ----

// A UsdCamera is the camera of a stage and the way in which it is turned.
class UsdCamera {
 public:
  UsdCamera(const std::string& file, const UsdStage& stage, const UsdPrim& prim)
      : file_(file), stage_(stage), prim_(prim) {}

  bool moves() const { return !times().empty(); }

  std::vector<CameraSample> samples() const {
    std::set<double> all = times();
    if (all.empty()) all.insert(0);
    std::vector<CameraSample> samples;
    samples.reserve(all.size());
    for (const double time : all)
      samples.push_back({time / stage_.codes_per_second, rotation_at(time)});
    return samples;
  }

 private:
  [[noreturn]] void fail(const UsdPrim& prim, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {} {}", file_, prim.line, prim.path, what));
  }

  // Calls use(prim, operation, is_inverse) for each operation that turns the camera, the outermost
  // last.
  template <class Use>
  void for_each_operation(const Use& use) const {
    for (const UsdPrim* prim = &prim_; prim; prim = prim->parent) {
      const auto order = prim->attributes.find("xformOpOrder");
      if (order == prim->attributes.end()) continue;
      const std::vector<std::string>& outermost_first = order->second.fixed.texts;
      const std::vector<std::string> names(outermost_first.rbegin(), outermost_first.rend());
      for (const std::string& name : names) {
        constexpr std::string_view kInvert = "!invert!", kOperation = "xformOp:";
        if (name == "!resetXformStack!") return;
        const bool inverse = name.starts_with(kInvert);
        const std::string attribute = inverse ? name.substr(kInvert.size()) : name;
        const auto found = prim->attributes.find(attribute);
        if (!attribute.starts_with(kOperation) || found == prim->attributes.end())
          fail(*prim, "lacks the operation " + attribute + " of its xformOpOrder");
        const std::string kind = attribute.substr(
            kOperation.size(), attribute.find(':', kOperation.size()) - kOperation.size());
        if (kind != "translate") use(*prim, kind, found->second, inverse);
      }
    }
  }

  std::set<double> times() const {
    std::set<double> times;
    for_each_operation(
        [&](const UsdPrim&, const std::string&, const UsdAttribute& attribute, bool) {
          for (const auto& [time, value] : attribute.samples) times.insert(time);
        });
    return times;
  }

  M33d rotation_at(double time) const {
    M33d turned;  // is 1
    for_each_operation([&](const UsdPrim& prim, const std::string& kind,
                           const UsdAttribute& attribute, bool inverse) {
      const M33d m = operation(prim, kind, attribute.at(time).numbers);
      turned = (inverse ? m.transposed() : m) * turned;
    });
    // Where z is up, y leads away and becomes -z.
    if (stage_.z_is_up) turned = from_columns({1, 0, 0}, {0, 0, -1}, {0, 1, 0}) * turned;
    return turned;
  }

  M33d operation(const UsdPrim& prim, const std::string& kind, const std::vector<double>& n) const {
    const auto require = [&](std::size_t count) {
      if (n.size() != count) fail(prim, fmt::format("has {} numbers in its {}", n.size(), kind));
    };
    if (kind == "transform") {
      require(16);
      return rotation(prim,
                      from_columns({n[0], n[1], n[2]}, {n[4], n[5], n[6]}, {n[8], n[9], n[10]}));
    }
    if (kind == "scale") {
      require(3);
      return rotation(prim, from_columns({n[0], 0, 0}, {0, n[1], 0}, {0, 0, n[2]}));
    }
    if (kind == "orient") {
      require(4);
      return turned_by_quaternion(prim, n);
    }
    constexpr std::string_view kRotate = "rotate", kAxes = "XYZ";
    const std::string axes = kind.starts_with(kRotate) ? kind.substr(kRotate.size()) : "";
    if (axes.empty() || axes.size() == 2 || axes.size() > 3 ||
        axes.find_first_not_of(kAxes) != std::string::npos)
      fail(prim, "is turned by the operation " + kind + ", which is not known");
    require(axes.size());
    M33d m;  // is 1
    // The axis that is named first comes first.  The angles stand in the order x, y, z.
    for (const char axis : axes) {
      const int k = static_cast<int>(kAxes.find(axis));
      m = about(k, n[axes.size() == 1 ? 0 : static_cast<std::size_t>(k)]) * m;
    }
    return m;
  }

  M33d turned_by_quaternion(const UsdPrim& prim, const std::vector<double>& n) const {
    const double length = std::hypot(std::hypot(n[0], n[1]), std::hypot(n[2], n[3]));
    if (!(length > 0)) fail(prim, "has an orient of length 0");
    const double w = n[0] / length, x = n[1] / length, y = n[2] / length, z = n[3] / length;
    return from_columns({1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)});
  }

  // Returns axes of length 1.  A mirrored camera would show letters in reverse, and a sheared one
  // shapes that no projection has.
  M33d rotation(const UsdPrim& prim, const M33d& m) const {
    constexpr double kSheared = 1e-3;
    const V3d x = column(m, 0).normalized(), y = column(m, 1).normalized(),
              z = column(m, 2).normalized();
    const double off = std::max({std::abs(x.dot(y)), std::abs(y.dot(z)), std::abs(z.dot(x))});
    if (!(off < kSheared)) fail(prim, "shears the camera");
    if (!(x.cross(y).dot(z) > 0)) fail(prim, "mirrors the camera, or makes it nothing");
    const V3d right = (x - z * x.dot(z)).normalized();
    return from_columns(right, z.cross(right), z);
  }

  const std::string& file_;
  const UsdStage& stage_;
  const UsdPrim& prim_;
};

void find_cameras(const UsdPrim& prim, std::vector<const UsdPrim*>& found) {
  if (prim.type == "Camera") found.push_back(&prim);
  for (const auto& child : prim.children) find_cameras(*child, found);
}

std::vector<CameraSample> read_usd(const std::string& file, std::string_view text) {
  const UsdStage stage = read_usd_stage(file, text);
  std::vector<const UsdPrim*> cameras;
  find_cameras(stage.root, cameras);
  if (cameras.empty()) throw InputError(file + ": holds no camera");
  const auto moves = [&](const UsdPrim* prim) { return UsdCamera(file, stage, *prim).moves(); };
  if (std::ranges::count_if(cameras, moves) > 0)
    std::erase_if(cameras, [&](const UsdPrim* prim) { return !moves(prim); });
  if (cameras.size() > 1)
    throw InputError(fmt::format("{}: holds {} cameras, among them {} and {}; a show takes one",
                                 file, cameras.size(), cameras[0]->path, cameras[1]->path));
  return UsdCamera(file, stage, *cameras.front()).samples();
}

}  // namespace

std::vector<CameraSample> read_camera_file(const std::filesystem::path& file,
                                           double frames_per_second) {
  const std::string text = read_file(file, kMostBytes), name = file.string();
  if (text.starts_with("PXR-USDC") || text.starts_with("PK"))
    throw InputError(name + ": is a packed USD file; save it as text, with the ending .usda");
  return text.starts_with("#usda") ? read_usd(name, text)
                                   : read_chan(name, text, frames_per_second);
}

}  // namespace domefall
