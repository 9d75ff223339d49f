#include <CLI/CLI.hpp>
#include <cstdio>
#include <numbers>

#include "pipeline/cli/frame_range.h"
#include "pipeline/cli/output_file.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/diagram/page.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/read_show.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

void print_states(const std::string& file, const std::string& frames, const std::string& plot) {
  const Show show = read_show(file);
  const std::vector<int> chosen = parse_frames(frames, frame_count(show));
  if (!plot.empty()) write_output(plot, show_page(show));
  std::puts(
      "# r and proper_time in M (proper_time in s without a hole); celerity (gamma v) against the "
      "tetrad along R,"
      " Theta, Phi;\n# ra_deg and dec_deg: the observer's place as seen from the hole; camera axes "
      "in the boosted"
      " (R, Theta, Phi)\n"
      "# azimuth_deg: swept in the planes of its orbits since the start of the show\n"
      "# null_time in M: v = t + r* where the tetrad is rain, u = t - r* where it is outgoing\n"
      "frame,show_time_s,segment,region,tetrad,r,proper_time,celerity_r,celerity_theta,celerity_"
      "phi,ra_deg,dec_deg,azimuth_deg,"
      "x_r,x_theta,x_phi,y_r,y_theta,y_phi,z_r,z_theta,z_phi,null_time");
  for (const int n : chosen) {
    const FrameState s = frame_state(show, n);
    const ObserverState& o = s.observer;
    const Equatorial place = equatorial({column(o.sky_from_tetrad, 0)});
    std::printf("%d,%.9g,%d,%s,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.15g,%.15g,%.15g", n,
                s.show_time_s, s.segment + 1, region_name(o.region), tetrad_name(o.tetrad), o.r,
                o.proper_time, o.celerity.x, o.celerity.y, o.celerity.z, place.ra_deg,
                place.dec_deg, o.azimuth * 180 / std::numbers::pi);
    for (int k = 0; k < 3; ++k) {
      const V3d axis = column(o.tetrad_from_camera, k);
      std::printf(",%.17g,%.17g,%.17g", axis.x, axis.y, axis.z);
    }
    std::printf(",%.17g\n", o.null_time);
  }
}

}  // namespace

void add_states(CLI::App& app) {
  auto* verb = app.add_subcommand("states", "Per-frame observer states as CSV");
  auto show = std::make_shared<std::string>(), frames = std::make_shared<std::string>(),
       plot = std::make_shared<std::string>();
  verb->add_option("show", *show, "show file (YAML)")->required();
  verb->add_option("--frames", *frames, "7, 0-299, 0-599x10; default all");
  verb->add_option("--plot", *plot,
                   "also draw the whole show as one page (SVG): radius, orbit, Penrose diagram");
  verb->callback([show, frames, plot] { print_states(*show, *frames, *plot); });
}

}  // namespace domefall
