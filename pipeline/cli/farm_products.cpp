#include "pipeline/cli/farm_products.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "pipeline/cli/delivery_run.h"
#include "pipeline/cli/movie_frames.h"
#include "pipeline/image/errors.h"
#include "pipeline/movie/preset.h"
#include "pipeline/movie/sound.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Returns the path as the nodes find it, whose working folder may be another.
std::string absolute_path(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

void add_files(std::vector<std::string>& options, const char* name,
               const std::vector<std::string>& files) {
  if (files.empty()) return;
  options.emplace_back(name);
  for (const std::string& file : files) options.push_back(absolute_path(file));
}

void refuse_parts_of_nothing(const FarmProducts& products) {
  if (!products.audio.empty() && products.movie.empty() && products.deliver.empty())
    throw InputError("--audio " + products.audio.front() +
                     ": is the sound of --movie and --deliver, and neither is asked for");
  if (!products.deliver.empty()) return;
  const auto refuse = [](const std::string& option) {
    throw InputError(option + ": is of --deliver, which is not asked for");
  };
  if (!products.subtitles.empty()) refuse("--subtitles " + products.subtitles.front());
  if (products.depth > 0) refuse(fmt::format("--depth {}", products.depth));
  if (products.leader) refuse("--leader");
}

void require_graded(const Show& show, const char* option) {
  if (!show.output.graded)
    throw InputError(fmt::format("{}: {} needs graded frames, and the show makes none",
                                 show.file.string(), option));
}

void add_movie_product(FarmPlan& plan, const FarmProducts& products, const Show& show,
                       const std::vector<int>& frames) {
  const MoviePreset& preset = movie_preset(products.movie);
  plan.movie = products.movie;
  plan.movie_file = (plan.out / fmt::format("{}_{}.{}", show.file.stem().string(), products.movie,
                                            preset.extension))
                        .string();
  if (frames.back() - frames.front() + 1 != static_cast<int>(frames.size()))
    throw InputError("--frames " + plan.frames + ": a movie takes one range, such as 0-299");
  require_graded(show, "--movie");
  movie_size_of(preset, show.projection);
  if (std::error_code none; fs::is_directory(plan.movie_file, none))
    throw InputError(plan.movie_file + ": is a folder, where --movie would write its file");
  const std::string silence =
      compare_lengths(read_sound({products.audio.begin(), products.audio.end()}), frame_count(show),
                      frame_rate_of(show.frames_per_second));
  if (!silence.empty()) std::fprintf(stderr, "%s\n", silence.c_str());
  add_files(plan.movie_options, "--audio", products.audio);
}

void add_delivery(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames) {
  if (static_cast<int>(frames.size()) != frame_count(show))
    throw InputError("--deliver " + products.deliver + ": takes all frames of the show");
  require_graded(show, "--deliver");
  plan.deliver = absolute_path(products.deliver);
  DeliveryRun run{.show = show,
                  .from = plan.out,
                  .out = plan.deliver,
                  .bits = std::nullopt,
                  .name = {},
                  .sounds = {products.audio.begin(), products.audio.end()},
                  .subtitles = {products.subtitles.begin(), products.subtitles.end()},
                  .leader = products.leader};
  if (products.depth > 0) run.bits = products.depth;
  check_delivery_folder(run);
  std::vector<std::string>& options = plan.deliver_options;
  if (products.depth > 0)
    options.insert(options.end(), {"--depth", fmt::to_string(products.depth)});
  if (products.leader) options.emplace_back("--leader");
  add_files(options, "--audio", products.audio);
  add_files(options, "--subtitles", products.subtitles);
}

}  // namespace

void add_products(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames) {
  refuse_parts_of_nothing(products);
  if (!products.movie.empty()) add_movie_product(plan, products, show, frames);
  if (!products.deliver.empty()) add_delivery(plan, products, show, frames);
}

}  // namespace domefall
