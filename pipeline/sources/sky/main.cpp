// domefall_make_sky IMAGE SIZE V OUT makes the .sky file OUT from a panorama of the kind that shows
// take.  The faces of the map have SIZE texels along an edge.  The panorama holds the light of
// stars fainter than V.  The build makes the shipped maps with this program, so that a show opens
// them without reading a panorama.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "pipeline/sources/sky/import_sky.h"

int main(int count, char** arguments) {
  if (count != 5) {
    std::fputs("domefall_make_sky IMAGE SIZE V OUT\n", stderr);
    return EXIT_FAILURE;
  }
  try {
    domefall::SkyImport import;
    import.image = arguments[1];
    import.size = std::stoi(arguments[2]);
    import.fainter_than = std::stod(arguments[3]);
    import.out = arguments[4];
    import_sky(import);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
