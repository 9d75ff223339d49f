// An OpenEXR file has any number of layers, each with channels of its own, in one part or several.
// This file finds the one that is the picture.
#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

struct PictureChannels {
  int part = 0;
  std::array<int, 3> rgb{0, 1, 2};  // channels of the part; the same one three times for grey
  int alpha = -1;                   // likewise, and -1 if there is none
  std::string layer;                // "" for the channels R, G, B themselves
  std::string view;                 // of a stereo picture
};

// Takes the channels R, G, B (or Y alone) themselves, or else the layer `rgba`, or `Combined`, as
// Blender calls it, or else the only layer of colours.  Case does not matter.  The first view of
// several is taken.  Throws std::runtime_error with the layers if several could be the picture, and
// with the channels if none is: normals, depths, positions, motions, coordinates and ids are no
// colours, whatever their channels are called.
PictureChannels picture_channels(const std::vector<OIIO::ImageSpec>& parts);

// Returns a file's name for something, short and without control characters.
std::string short_name(std::string_view name);

}  // namespace domefall
