#include "pipeline/image/openimageio/exr_layers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <stdexcept>

#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

// Returns what follows the last dot, and removes it, with the dot, from `name`.
std::string cut_last(std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string last = dot == std::string::npos ? name : name.substr(dot + 1);
  name.resize(dot == std::string::npos ? 0 : dot);
  return last;
}

std::vector<std::string> view_names(const OIIO::ImageSpec& spec) {
  std::vector<std::string> views;
  const OIIO::ParamValue* stated = spec.find_attribute("multiView");
  if (stated && stated->type().basetype == OIIO::TypeDesc::STRING)
    for (std::size_t k = 0; k < stated->type().basevalues(); ++k)
      views.push_back(stated->get_string_indexed(static_cast<int>(k)));
  return views;
}

// A Layer's channels are by their own names in lower case.
struct Layer {
  int part;
  std::string name;
  std::map<std::string, int> channels;
};

// Renderers' names of what is no colour.
bool is_data_name(const std::string& layer) {
  std::string parents = layer;
  std::string name = in_lower_case(cut_last(parents));
  while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back()))) name.pop_back();
  static constexpr std::array<std::string_view, 31> kNames{
      "n",       "p",        "z",       "uv",      "st",    "id",        "pos",    "point",
      "vector",  "index",    "pworld",  "pref",    "nref",  "dpdu",      "dpdv",   "speed",
      "forward", "backward", "indexob", "indexma", "stmap", "disparity", "uvw",    "uvpass",
      "mv",      "flow",     "objid",   "matid",   "ng",    "ns",        "cputime"};
  static constexpr std::array<std::string_view, 15> kParts{
      "normal",  "depth",      "position",    "motion",     "velocity",
      "crypto",  "worldpoint", "pointworld",  "denoising",  "worldpos",
      "tangent", "binormal",   "barycentric", "multimatte", "sample count"};
  const auto has = [&name](std::string_view part) { return name.find(part) != std::string::npos; };
  return std::ranges::find(kNames, name) != kNames.end() || std::ranges::any_of(kParts, has) ||
         name.ends_with("_id") || name.ends_with("objectid") || name.ends_with("materialid");
}

int channel_of(const Layer& layer, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const auto found = layer.channels.find(name); found != layer.channels.end())
      return found->second;
  return -1;
}

std::optional<PictureChannels> colours_of(const Layer& layer) {
  if (is_data_name(layer.name)) return std::nullopt;
  PictureChannels found{layer.part,
                        {channel_of(layer, {"r", "red"}), channel_of(layer, {"g", "green"}),
                         channel_of(layer, {"b", "blue"})},
                        channel_of(layer, {"a", "alpha"}),
                        layer.name,
                        ""};
  const int grey = channel_of(layer, {"y", "l", "luminance", "grey", "gray"});
  const bool none = found.rgb == std::array{-1, -1, -1};
  if (none && grey >= 0 && channel_of(layer, {"x", "z", "ry", "by", "u", "v"}) < 0)
    found.rgb.fill(grey);
  if (std::ranges::count(found.rgb, -1)) return std::nullopt;
  return found;
}

// The lower, the sooner a layer is taken.
int rank_of(const std::string& layer) {
  std::string parents = in_lower_case(layer);
  const std::string name = cut_last(parents);
  if (name.empty()) return 0;
  if (name == "rgba" || name == "rgb") return 1;
  if (name == "combined") return parents == "composite" ? 2 : 3;
  return 4;
}

// Lists the layers of the first view, in the order of the file.
class Layers {
 public:
  explicit Layers(const std::vector<OIIO::ImageSpec>& parts) {
    for (std::size_t k = 0; k < parts.size(); ++k) add(parts, k);
  }
  std::vector<Layer> all;
  std::string view;

 private:
  void add(const std::vector<OIIO::ImageSpec>& parts, std::size_t k) {
    const OIIO::ImageSpec& spec = parts[k];
    std::string name(parts.size() > 1 ? spec.get_string_attribute("oiio:subimagename") : "");
    const std::string own_view(parts.size() > 1 ? spec.get_string_attribute("view") : "");
    if (view.empty()) view = own_view;
    if (spec.deep || (!own_view.empty() && own_view != view)) return;
    strip_view(name, own_view);
    const std::vector<std::string> views = view_names(spec);
    if (!views.empty()) view = views[0];
    for (int c = 0; c < spec.nchannels; ++c) {
      if (!spec.channelformat(c).is_floating_point()) continue;  // whole numbers are ids
      std::string layer = spec.channelnames[static_cast<std::size_t>(c)];
      const std::string channel = in_lower_case(cut_last(layer));
      if (!strip_other_views(layer, views)) continue;
      Layer& found = at(static_cast<int>(k), layer.empty() ? name : layer);
      found.channels.emplace(channel, c);
    }
  }
  static void strip_view(std::string& name, const std::string& view) {
    if (view.empty() || !name.ends_with(view)) return;
    name.resize(name.size() - view.size());
    while (!name.empty() && (name.back() == '.' || name.back() == '_')) name.pop_back();
  }
  // Says whether a layer is of the first view, whose name is then removed.
  static bool strip_other_views(std::string& layer, const std::vector<std::string>& views) {
    std::string rest = layer;
    const std::string last = cut_last(rest);
    const auto found = std::ranges::find(views, last);
    if (last.empty() || found == views.end()) return true;
    layer = rest;
    return found == views.begin();
  }
  Layer& at(int part, const std::string& name) {
    const auto same = [&](const Layer& l) { return l.part == part && l.name == name; };
    const auto found = std::ranges::find_if(all, same);
    if (found != all.end()) return *found;
    all.push_back({part, name, {}});
    return all.back();
  }
};

[[noreturn]] void refuse_layers(const char* why, const std::vector<std::string>& names,
                                const char* what_to_do) {
  constexpr std::size_t kMost = 40;
  std::vector<std::string> shown;
  for (std::size_t k = 0; k < std::min(names.size(), kMost); ++k)
    shown.push_back(short_name(names[k]));
  throw std::runtime_error(fmt::format("{}: {}{}{}", why, fmt::join(shown, ", "),
                                       names.size() > kMost ? ", ..." : "", what_to_do));
}

}  // namespace

std::string short_name(std::string_view name) {
  constexpr std::size_t kMost = 64;
  return printable(name.substr(0, kMost));
}

PictureChannels picture_channels(const std::vector<OIIO::ImageSpec>& parts) {
  const Layers layers(parts);
  std::vector<PictureChannels> best;
  int rank = 0;
  for (const Layer& layer : layers.all) {
    const auto found = colours_of(layer);
    if (!found) continue;
    const int own = rank_of(layer.name);
    if (!best.empty() && own > rank) continue;
    if (own < rank) best.clear();
    rank = own;
    best.push_back(*found);
  }
  std::vector<std::string> names;
  if (best.empty()) {
    for (const OIIO::ImageSpec& spec : parts)
      names.insert(names.end(), spec.channelnames.begin(), spec.channelnames.end());
    if (std::ranges::all_of(parts, [](const auto& spec) { return spec.deep; }))
      refuse_layers("the image has deep pixels", names, "");
    refuse_layers("none of its channels are colours", names,
                  "; a picture has R, G, B, alone or in a layer, or Y");
  }
  if (best.size() > 1) {
    for (const PictureChannels& one : best)
      names.push_back(one.layer.empty() ? fmt::format("part {}", one.part + 1) : one.layer);
    refuse_layers("several of its layers could be the picture", names,
                  "; keep one, or call it Combined");
  }
  best[0].view = layers.view;
  return best[0];
}

}  // namespace domefall
