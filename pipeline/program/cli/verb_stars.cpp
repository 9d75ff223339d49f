#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/utf8.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_file.h"

namespace domefall {
namespace {

struct StarOptions {
  std::string format, out, hipparcos, names, corrections;
  std::vector<std::string> inputs;
  double faintest = kFaintestV;
};

std::vector<std::string_view> format_list() {
  std::vector<std::string_view> names;
  for (const CatalogueFormat& each : catalogue_formats()) names.push_back(each.name);
  names.emplace_back("auto");
  return names;
}

std::string format_names() { return fmt::format("{}", fmt::join(format_list(), ", ")); }

const CatalogueFormat& catalogue_format(const std::string& format, const Paths& inputs) {
  if (format == "auto") {
    if (const CatalogueFormat* guessed = guess_format(inputs)) return *guessed;
    throw InputError(fmt::format("{}: not known by how it begins; name the format: {}",
                                 inputs.front().string(), format_names()));
  }
  for (const CatalogueFormat& each : catalogue_formats())
    if (each.name == format) return each;
  throw InputError(fmt::format("format {}: must be one of {}", format, format_names()));
}

void repair(RawCatalogue& catalogue, const std::string& file) {
  const ImportedCatalogue hipparcos = import_d3_celestial({file});
  const HipparcosRepair done = repair_by_hipparcos(catalogue, hipparcos.catalogue);
  say(fmt::format("{}: V of {}, colour of {} that had none, {} added", file,
                  counted(done.stars, "star"), with_commas(done.colours),
                  counted(done.added, "star")));
  catalogue.text.source += "; V and colours by " + hipparcos.catalogue.text.source;
  catalogue.text.licence += "; " + hipparcos.catalogue.text.licence;
}

std::size_t without_colour(const std::vector<CatalogueStar>& stars) {
  return static_cast<std::size_t>(std::count_if(
      stars.begin(), stars.end(), [](const CatalogueStar& s) { return s.colour == kNoColour; }));
}

void say_result(const RawCatalogue& catalogue, const std::string& out) {
  say(fmt::format("{}: {}, V {:.2f} to {:.2f}, {}, {} without colour, drawn as B-V {}", out,
                  counted(catalogue.stars.size(), "star"), catalogue.stars.front().v,
                  catalogue.stars.back().v, counted(catalogue.names.size(), "name"),
                  with_commas(without_colour(catalogue.stars)), kAssumedColour));
}

void import(const StarOptions& o) {
  const Paths inputs(o.inputs.begin(), o.inputs.end());
  Paths all = inputs;
  for (const std::string& input : {o.hipparcos, o.names, o.corrections})
    if (!input.empty()) all.emplace_back(input);
  for (const std::filesystem::path& input : all) {
    std::error_code error;  // a folder that cannot be looked at is told when it is read
    if (!std::filesystem::is_directory(input, error)) require_file(input);
    refuse_overwriting(o.out, input);
  }
  OutputFile out(o.out);
  const CatalogueFormat& format = catalogue_format(o.format, inputs);
  if (o.format == "auto") say(fmt::format("taken as {}", format.title));
  ImportedCatalogue imported = format.import(inputs);
  RawCatalogue& catalogue = imported.catalogue;
  say(fmt::format("{}: {}", format.title, counted(catalogue.stars.size(), "star")));
  for (const std::string& note : imported.notes) say(note);
  if (!o.hipparcos.empty()) repair(catalogue, o.hipparcos);
  if (!o.names.empty()) add_names(catalogue, o.names);
  if (!o.corrections.empty())
    say(fmt::format("{}: {}", o.corrections,
                    counted(apply_corrections(catalogue, o.corrections), "correction")));
  keep_brighter(catalogue, o.faintest);
  if (catalogue.stars.empty()) throw InputError(o.inputs.front() + ": no star is left to write");
  sort_by_brightness(catalogue);
  catalogue.text.made =
      fmt::format("domefall " DOMEFALL_VERSION " stars import {}{}{}{}", format.name,
                  o.hipparcos.empty() ? "" : " --hipparcos", o.names.empty() ? "" : " --names",
                  o.corrections.empty() ? "" : " --corrections");
  write_star_file(out.path(), catalogue);
  out.finish();
  say_result(catalogue, o.out);
}

void add_stars_import(CLI::App& stars) {
  auto* verb = stars.add_subcommand("import", "Make a .stars catalogue from one of another format");
  auto o = std::make_shared<StarOptions>();
  verb->add_option("FORMAT", o->format, "of the catalogue; auto: told by how it begins")
      ->type_name(one_of(format_list()))
      ->required();
  add_file(*verb, "INPUT", o->inputs, "files, or the folder they are in")->required();
  add_file(*verb, "--out", o->out, "the .stars file to write")->required();
  verb->add_option("--faintest", o->faintest, "leave out fainter stars than this V")
      ->check(number_in(kBrightestV, kFaintestV));
  add_file(*verb, "--hipparcos", o->hipparcos,
           "V, colours and missing stars from d3-celestial's stars.N.json");
  add_file(*verb, "--names", o->names, "names by Hipparcos number: d3-celestial's starnames.json");
  add_file(*verb, "--corrections", o->corrections, "CSV of corrections made by hand");
  verb->callback([o] { import(*o); });
}

constexpr int kFirstLimit = -1, kLastLimit = 20;

struct Count {
  double limit;
  std::size_t stars;  // of V <= limit
};

struct Facts {
  std::vector<Count> counts;  // from the first limit that a star meets to the one that all meet
  std::size_t colourless = 0, moving = 0;
  double brightest = 0, faintest = 0;
  std::vector<StarName> names;
};

Facts facts_of(const StarFile& file) {
  // Making stars of all records throws an error that names the byte of a record that is no star.
  stars_of(file, std::numeric_limits<double>::infinity(), file.epoch());
  const auto stars = file.up_to(std::numeric_limits<double>::infinity());
  Facts facts;
  std::vector<double> limits;
  for (int v = kFirstLimit; v <= kLastLimit; ++v) limits.push_back(v);
  limits.insert(std::find(limits.begin(), limits.end(), 7.0), 6.5);
  for (const double limit : limits) {
    const std::size_t met = file.up_to(limit).size();
    if (met > 0) facts.counts.push_back({limit, met});
    if (met == stars.size()) break;
  }
  for (const StarRecord& star : stars) {
    if (star.colour == kNoColour) ++facts.colourless;
    if (star.pm_ra != 0 || star.pm_dec != 0) ++facts.moving;
  }
  if (!stars.empty()) {
    facts.brightest = stars.front().v;
    facts.faintest = stars.back().v;
  }
  facts.names = file.names(stars.size());
  return facts;
}

std::string line(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("{:12} {}\n", name, printable(value));
}

// Returns a magnitude without the decimals that a float adds to it.
double rounded(double v) { return std::round(v * 1e4) / 1e4; }

// Both pages read and check the whole file, and throw InputError where it is damaged.
std::string star_page(const StarFile& file) {
  const Facts facts = facts_of(file);
  std::string page =
      line("source", file.text().source) + line("licence", file.text().licence) +
      line("made", file.text().made) + line("epoch", fmt::format("J{:.2f}", file.epoch())) +
      line("stars", with_commas(file.size())) +
      line("V", fmt::format("{:.2f} to {:.2f}", facts.brightest, facts.faintest)) +
      line("names", with_commas(facts.names.size())) +
      line("no colour", with_commas(facts.colourless)) +
      line("moving", fmt::format("{}, with a proper motion", with_commas(facts.moving)));
  for (const Count& count : facts.counts)
    page += line(fmt::format("V <= {:g}", count.limit), with_commas(count.stars));
  return page;
}

std::string star_json(const StarFile& file) {
  const Facts facts = facts_of(file);
  nlohmann::ordered_json json = {{"source", file.text().source},
                                 {"licence", file.text().licence},
                                 {"made", file.text().made},
                                 {"epoch", file.epoch()},
                                 {"stars", file.size()},
                                 {"names", facts.names.size()},
                                 {"brightest_v", rounded(facts.brightest)},
                                 {"faintest_v", rounded(facts.faintest)},
                                 {"without_colour", facts.colourless},
                                 {"with_proper_motion", facts.moving},
                                 {"fingerprint", file.fingerprint()}};
  json["counts"] = nlohmann::ordered_json::array();
  for (const Count& count : facts.counts)
    json["counts"].push_back({{"v_up_to", count.limit}, {"stars", count.stars}});
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void add_stars_info(CLI::App& stars) {
  auto* verb = stars.add_subcommand("info", "Say what a .stars catalogue holds");
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  add_file(*verb, "FILE", *file, ".stars file")->required();
  verb->add_flag("--json", *json, "the same facts as JSON, for other programs");
  verb->callback([file, json] {
    require_file(*file);
    const StarFile stars_file(*file);
    const std::string text = *json ? star_json(stars_file) : star_page(stars_file);
    std::fwrite(text.data(), 1, text.size(), stdout);
  });
}

}  // namespace

void add_stars(CLI::App& app) {
  auto* stars = app.add_subcommand("stars", "Import star catalogues and look into them");
  stars->require_subcommand(1);
  add_stars_import(*stars);
  add_stars_info(*stars);
}

}  // namespace domefall
