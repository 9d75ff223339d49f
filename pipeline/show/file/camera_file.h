// Reads cameras that other programs have animated.
#pragma once

#include <filesystem>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// A CameraSample is how a camera is turned at an instant, as camera_world.h says.
struct CameraSample {
  double at_s;  // show seconds
  M33d world_from_camera;
};

// Returns the samples of a .chan file, whose rotations are about z, then x, then y, or of the camera
// in a USD stage that is written as text, in the order of their instants; at least one.  Frame 0, or
// time code 0, is the show's start.  Of several cameras in a stage the one that moves counts.
// Places, sizes and lenses do not.  Throws InputError with the line for what cannot be read, and as
// RegularFile.
std::vector<CameraSample> read_camera_file(const std::filesystem::path& file,
                                           double frames_per_second);

}  // namespace domefall
