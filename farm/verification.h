// `domefall farm verify` reads every byte of a show's frames.
#pragma once

#include "farm/farm_frames.h"

namespace domefall {

// Prints what is found as a page or as JSON.  With `repair` it first has the frames made again that
// are not good, and looks at them again; it leaves alone what is no file, such as a folder of a
// frame's name.  Throws std::runtime_error where not all is there and good, TemporaryError where
// something cannot be read, and InputError if the folder to repair is another show's.  Also throws as
// FarmFrames and run_frames().
void verify_folder(const FarmRequest& request, bool json, bool repair);

}  // namespace domefall
