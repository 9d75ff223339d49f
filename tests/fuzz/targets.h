// What the fuzzer can do with an input, one function for each kind of file that Domefall reads.
#pragma once

#include <cstddef>
#include <cstdint>

namespace domefall::fuzz {

// A target reads the bytes as a file of its kind.  It fails where an exception is not caught, where
// a sanitizer reports something, and where an input takes too much time or memory.
using Target = void(const std::uint8_t* data, std::size_t size);

Target catalogue, colour_config, frame, healpix, picture, show, sky_file, star_file, table;

}  // namespace domefall::fuzz
