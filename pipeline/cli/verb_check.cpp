#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "pipeline/cli/verbs.h"
#include "pipeline/grade/grader.h"
#include "pipeline/render/scene.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/read_show.h"

namespace domefall {
namespace {

const char* kind_of(const Trajectory& t) {
  constexpr const char* kNames[] = {"static", "circular", "infall", "velocity"};
  return kNames[t.index()];
}

void print_segments(const Show& show) {
  for (std::size_t k = 0; k < show.timeline.size(); ++k) {
    const Segment& s = show.timeline[k];
    const double from = point_at(s.trajectory, s.timing.tau_begin).r,
                 to = point_at(s.trajectory, s.timing.tau_end).r;
    std::printf("segment %zu    %s, %.6g s", k, kind_of(s.trajectory), s.duration_s);
    if (std::isinf(from))
      std::puts(", flat space");
    else
      std::printf(", r = %.6g M to %.6g M, %.6g M of proper time\n", from, to,
                  s.timing.tau_end - s.timing.tau_begin);
  }
}

// What the pictures leave out of nature, or add to it.
void print_effects(const Effects& effects) {
  if (effects == Effects{}) return;
  std::printf("effects     ");
  if (!effects.aberration) std::printf(" no aberration;");
  if (!effects.doppler_colour) std::printf(" no Doppler colours;");
  if (!effects.intensity) std::printf(" intensities at rest;");
  if (!effects.lensing) std::printf(" no lensing;");
  constexpr const char* kAmplified[] = {"nothing is", "stars are", "everything is"};
  std::printf(" %s amplified\n", kAmplified[static_cast<int>(effects.amplification)]);
}

void check(const std::string& file) {
  const Show show = read_show(file);
  // A file that is there may still be damaged: what the frames will read is read.
  Scene scene(show);
  if (show.graded_format != GradedFormat::kNone) {
    const Grader grader(show.grade);
    std::printf("graded for   %s, %s\n", grader.display().c_str(), grader.view().c_str());
  }
  const int count = frame_count(show);
  // r only falls or stays along every trajectory, so a segment's ends tell.
  std::set<Region> regions;
  double closest = kFlatSpace;
  for (const Segment& s : show.timeline)
    for (const double tau : {s.timing.tau_begin, s.timing.tau_end}) {
      const OrbitPoint point = point_at(s.trajectory, tau);
      regions.insert(point.region);
      closest = std::min(closest, point.r);
    }
  std::printf("title        %s\nframes       %d at %g a second, %s of %d x %d\n",
              show.title.c_str(), count, show.frames_per_second,
              std::string(projection_name(show.projection)).c_str(), columns(show.projection),
              rows(show.projection));
  const bool inside = regions.contains(Region::kII);
  if (inside || regions.contains(Region::kI)) scene.sky(SeenSky::kOne);
  if (inside || regions.contains(Region::kIII)) scene.sky(SeenSky::kThree);
  if (show.mass_solar) scene.sky(SeenSky::kFour);
  print_effects(show.effects);
  print_segments(show);
  if (!show.mass_solar) return;
  std::printf("regions     ");
  for (const Region r : regions) std::printf(" %s", region_name(r));
  std::printf("\nclosest      r = %.6g M\n", closest);
}

}  // namespace

void add_check(CLI::App& app) {
  auto* verb = app.add_subcommand("check", "Validate a show and say what it does");
  auto show = std::make_shared<std::string>();
  verb->add_option("show", *show, "show file (YAML)")->required();
  verb->callback([show] { check(*show); });
}

}  // namespace domefall
