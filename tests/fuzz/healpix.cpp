// HEALPix maps in FITS files.
#include "pipeline/base/errors.h"
#include "pipeline/image/read_image.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void healpix(const std::uint8_t* data, std::size_t size) {
  const auto file = input_file(text_of(data, size));
  for (const int column : {1, 2}) try {
      read_healpix(file, column);
    } catch (const InputError&) {
    }
}

}  // namespace domefall::fuzz
