#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/output_file.h"
#include "pipeline/cli/star_page.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/sky/catalogue/amend/hipparcos_repair.h"
#include "pipeline/sky/catalogue/amend/star_corrections.h"
#include "pipeline/sky/catalogue/amend/star_names.h"
#include "pipeline/sky/catalogue/count_text.h"
#include "pipeline/sky/catalogue/import/catalogue_formats.h"
#include "pipeline/sky/catalogue/star_file.h"

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

void say(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

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
  verb->add_option("INPUT", o->inputs, "files, or the folder they are in")
      ->type_name(kFileType)
      ->required();
  verb->add_option("--out", o->out, "the .stars file to write")->type_name(kFileType)->required();
  verb->add_option("--faintest", o->faintest, "leave out fainter stars than this V")
      ->check(number_in(kBrightestV, kFaintestV));
  verb->add_option("--hipparcos", o->hipparcos,
                   "V, colours and missing stars from d3-celestial's stars.N.json")
      ->type_name(kFileType);
  verb->add_option("--names", o->names, "names by Hipparcos number: d3-celestial's starnames.json")
      ->type_name(kFileType);
  verb->add_option("--corrections", o->corrections, "CSV of corrections made by hand")
      ->type_name(kFileType);
  verb->callback([o] { import(*o); });
}

void add_stars_info(CLI::App& stars) {
  auto* verb = stars.add_subcommand("info", "Say what a .stars catalogue holds");
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  verb->add_option("FILE", *file, ".stars file")->type_name(kFileType)->required();
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
