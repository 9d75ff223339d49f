// Catalogues of stars for import: the first byte names the format, or what is laid over them.
#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/sources/stars/amend_catalogue.h"
#include "pipeline/sources/stars/catalogue_formats.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {
namespace {

void check(const RawCatalogue& catalogue) {
  for (const CatalogueStar& star : catalogue.stars)
    if (!std::isfinite(star.v) || !std::isfinite(star.direction.v.x)) std::abort();
}

RawCatalogue sirius() {
  CatalogueStar star;
  star.direction.v = {1, 0, 0};
  star.v = -1.44f;
  star.hip = 32349;
  RawCatalogue catalogue;
  catalogue.stars.push_back(star);
  return catalogue;
}

}  // namespace

void catalogue(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const auto file = input_file(text_of(data + 1, size - 1));
  const auto formats = catalogue_formats();
  const std::size_t choice = (data[0] - std::size_t{'0'}) % (formats.size() + 4);
  try {
    RawCatalogue catalogue = sirius();
    if (choice < formats.size())
      catalogue = formats[choice].import({file}).catalogue;
    else if (choice == formats.size())
      apply_corrections(catalogue, file);
    else if (choice == formats.size() + 1)
      add_names(catalogue, file);
    else if (choice == formats.size() + 2)
      guess_format({file});
    else
      read_star_catalogue(file, 6, 2100);
    check(catalogue);
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
