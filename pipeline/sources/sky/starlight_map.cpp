#include "pipeline/sources/sky/starlight_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/cube_face.h"

namespace domefall {
namespace {

constexpr double kCut = 4;  // standard deviations
constexpr int kKernelSteps = 4096;
constexpr double kBlurStep = 1.5;  // factor between the blurs of neighbouring classes

// A cell holds the light of stars that stand close together.
struct Cell {
  V3d direction{0, 0, 0};  // sum of directions, weighted by flux
  double flux = 0, weighted = 0;
};

// Returns the number of cells along a face in the coarsest grid whose cells are at most two thirds
// of the blur.
int cell_grid(double blur, int size) {
  int n = 1;
  while (n < size && std::numbers::pi / 2 / n > blur / 1.5) n *= 2;
  return n;
}

// Adds up the stars of each cell in the catalogue's order, so that the sums depend on that order
// alone.
std::vector<Cell> gather(const std::vector<FaintStar>& stars, int n) {
  std::vector<Cell> cells(6 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  for (const FaintStar& star : stars) {
    const FacePoint at = face_of(star.direction);
    const auto face_coordinate = [n](double u) {
      return static_cast<std::size_t>(std::clamp(static_cast<int>((u + 1) / 2 * n), 0, n - 1));
    };
    Cell& cell = cells[(static_cast<std::size_t>(at.face) * static_cast<std::size_t>(n) +
                        face_coordinate(at.v)) *
                           static_cast<std::size_t>(n) +
                       face_coordinate(at.u)];
    cell.direction += star.flux * star.direction;
    cell.flux += star.flux;
    cell.weighted += star.flux * std::log2(star.temperature / kThermalBase);
  }
  return cells;
}

struct Span {
  int first, last;  // texels; none if last < first
};

// Returns the texels along one axis of a face that a cap of radius `angle` may touch.  `ahead` and
// `aside` are the components of the cap's centre along the face's normal and that axis.  Projected
// on the plane of these two, the cap lies within the angle asin(sin(angle)/length) of its centre,
// where `length` is that of the projected centre.
Span texels_within(double ahead, double aside, double angle, int n) {
  const double length = std::hypot(ahead, aside);
  double low = -1, high = 1;
  if (std::sin(angle) < length) {
    const double centre = std::atan2(aside, ahead), half = std::asin(std::sin(angle) / length);
    // A face reaches 45 degrees to either side of its middle, where u = tan(angle) is -1 and 1.
    constexpr double kQuarter = std::numbers::pi / 4;
    if (centre - half > kQuarter || centre + half < -kQuarter) return {0, -1};
    low = std::tan(std::max(centre - half, -kQuarter));
    high = std::tan(std::min(centre + half, kQuarter));
  }
  const auto texel = [n](double u) { return static_cast<int>(std::floor((u + 1) / 2 * n)); };
  return {std::max(texel(low), 0), std::min(texel(high), n - 1)};
}

struct FaceBox {
  Span columns, rows;
  std::array<float, 3> centre;  // of the cap: ahead, along u, along v
};

FaceBox box_of(const V3d& d, int face, double angle, int n) {
  const int axis = face / 2;
  const double ahead = face % 2 ? -d[axis] : d[axis];
  const double u = d[(axis + 1) % 3], v = d[(axis + 2) % 3];
  // The farthest texel of a face is acos(1/sqrt 3) = 54.74 degrees (0.9554) from its middle.
  if (ahead < std::cos(0.9554 + angle)) return {{0, -1}, {0, -1}, {}};
  return {texels_within(ahead, u, angle, n),
          texels_within(ahead, v, angle, n),
          {static_cast<float>(ahead), static_cast<float>(u), static_cast<float>(v)}};
}

std::size_t flat(int row, int column, int n) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(n) +
         static_cast<std::size_t>(column);
}

// Returns u or v at the centre of texel k, as texel_centre() has it.
double face_coordinate(int k, int n) { return (2 * k + 1.0) / n - 1; }

}  // namespace

std::vector<FaintStar> fainter_stars(const StarCatalogue& catalogue, double v_magnitude) {
  std::vector<FaintStar> stars;
  for (const Star& s : catalogue.stars) {
    if (!(s.v_magnitude > v_magnitude)) continue;
    // The flux of V = 0 depends on the temperature, and each magnitude divides it by 10^0.4.
    const double flux =
        std::pow(10, -0.4 * s.v_magnitude) * bolometric_flux_at_v_zero(s.temperature);
    stars.push_back({s.direction.v, flux, s.temperature, s.v_magnitude});
  }
  return stars;
}

std::vector<BlurClass> blur_classes(const std::vector<FaintStar>& stars, double blur,
                                    double smooth_to) {
  const auto most = static_cast<std::size_t>(std::log(kWidestBlur / blur) / std::log(kBlurStep));
  std::vector<BlurClass> classes;
  for (std::size_t k = 0; k <= most; ++k)
    classes.push_back({blur * std::pow(kBlurStep, static_cast<double>(k)), {}});
  for (const FaintStar& star : stars) {
    // The peak of a blurred star is its flux over its blur squared.  Five magnitudes are a factor
    // of 100 in flux, hence a factor of 10 in blur.
    const double wider = std::pow(10, 0.2 * std::max(smooth_to - star.v_magnitude, 0.0));
    const auto k = static_cast<std::size_t>(std::lround(std::log(wider) / std::log(kBlurStep)));
    classes[std::min(k, most)].stars.push_back(star);
  }
  return classes;
}

int starlight_face(double blur) {
  int size = 64;
  // A face spans a quarter of a turn, and three texels must fit into the blur.
  while (size < kLargestStarlightFace && std::numbers::pi / 2 / size > blur / 3) size *= 2;
  return size;
}

StarlightMap::StarlightMap(int size)
    : size_(size), inverse_length_(flat(size, 0, size)), light_(6 * flat(size, 0, size)) {
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double u = face_coordinate(i, size), v = face_coordinate(j, size);
      inverse_length_[flat(j, i, size)] = static_cast<float>(1 / std::sqrt(1 + u * u + v * v));
    }
  // The kernel is the Gaussian as a function of 1 - cos(angle), which for small angles is half of
  // angle^2.  Its value at the cut is subtracted, so that it ends without a step.  The entries from
  // there on are 0.
  const double end = std::exp(-kCut * kCut / 2);
  for (int k = 0; k <= kKernelSteps; ++k)
    kernel_.push_back(static_cast<float>(std::exp(-kCut * kCut / 2 * k / kKernelSteps) - end));
  kernel_.back() = 0;
  kernel_.push_back(0);
}

void StarlightMap::add(const std::vector<FaintStar>& stars, double blur) {
  if (stars.empty()) return;
  for (const Cell& cell : gather(stars, cell_grid(blur, size_)))
    if (cell.flux > 0) spread(cell.direction.normalized(), cell.flux, cell.weighted, blur);
}

// Goes over the texels of the cap twice.  The first pass finds their weights, and the sum of
// weights times solid angles.  The second adds the light, divided by that sum.  The division makes
// the light of a star its flux, wherever the texels lie on the cube.
void StarlightMap::spread(const V3d& direction, double flux, double weighted, double blur) {
  const double reach = kCut * kCut * blur * blur / 2;  // 1 - cos(angle) at the cut
  const double angle = std::acos(1 - reach);
  const auto steps = static_cast<float>(kKernelSteps / (2 * reach));
  std::array<FaceBox, 6> boxes;
  weights_.clear();
  double sum = 0;
  const auto step = static_cast<float>(2.0 / size_);
  for (int face = 0; face < 6; ++face) {
    boxes[face] = box_of(direction, face, angle, size_);
    const auto& [columns, rows, centre] = boxes[face];
    for (int j = rows.first; j <= rows.last; ++j) {
      const auto v = static_cast<float>(face_coordinate(j, size_));
      const float* inverse = &inverse_length_[flat(j, 0, size_)];
      for (int i = columns.first; i <= columns.last; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) * step - 1;
        // The squared chord is 2 (1 - cos(angle)).  Made of differences of components, it keeps its
        // digits.
        const float x = centre[0] - inverse[i], y = centre[1] - u * inverse[i],
                    z = centre[2] - v * inverse[i];
        const float at = (x * x + y * y + z * z) * steps;
        const float inside = std::clamp(at, 0.0f, static_cast<float>(kKernelSteps));
        const auto k = static_cast<int>(inside);
        const float w =
            kernel_[k] + (inside - static_cast<float>(k)) * (kernel_[k + 1] - kernel_[k]);
        weights_.push_back(w);
        sum += w * inverse[i] * inverse[i] * inverse[i];
      }
    }
  }
  // The sum lacks the factor 4/size^2 of all solid angles (texel_solid_angle).
  const double scale = 1 / (sum * 4 / size_ / size_);
  const auto radiance = static_cast<float>(flux * scale);
  const auto thermal = static_cast<float>(weighted * scale);
  const float* weight = weights_.data();
  for (int face = 0; face < 6; ++face)
    for (int j = boxes[face].rows.first; j <= boxes[face].rows.last; ++j) {
      Light* row = &light_[flat(face * size_ + j, 0, size_)];
      for (int i = boxes[face].columns.first; i <= boxes[face].columns.last; ++i, ++weight) {
        row[i].radiance += *weight * radiance;
        row[i].weighted += *weight * thermal;
      }
    }
}

double StarlightMap::greatest() const {
  float greatest = 0;
  for (const Light& l : light_) greatest = std::max({greatest, l.radiance, l.weighted});
  return greatest;
}

double StarlightMap::flux() const {
  double sum = 0;
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < size_; ++j)
      for (int i = 0; i < size_; ++i)
        sum += light_[flat(face * size_ + j, i, size_)].radiance *
               texel_solid_angle(size_, face_coordinate(i, size_), face_coordinate(j, size_));
  return sum;
}

void StarlightMap::write(const SkyPyramid& pyramid, double gain) const {
  const double scale = gain / pyramid.unit;
  const SkyPyramid::Level& level = pyramid.levels[0];
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < size_; ++j)
      for (int i = 0; i < size_; ++i) {
        const Light& l = light_[flat(face * size_ + j, i, size_)];
        level.at(face, i, j) = {half_bits(static_cast<float>(l.radiance * scale)),
                                half_bits(static_cast<float>(l.weighted * scale)), 0, 0};
      }
  fill_border(level);
}

}  // namespace domefall
