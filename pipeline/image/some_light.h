// A sky whose values are negative without exception, as after a subtraction or in the logarithm,
// would be black without a word.
#pragma once

#include <filesystem>

namespace domefall {

// `least` and `most` are of a file's values, and 0.  Throws InputError naming the file where
// nothing exceeds 0 and something is below it.  All zeros are black because somebody wanted it so.
void check_light(const std::filesystem::path& file, double least, double most);

}  // namespace domefall
