// Panoramas that a test writes for itself.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <filesystem>
#include <vector>

#include "pipeline/base/temporary_file.h"

namespace domefall {

// An OpenEXR file of floats, which is removed at the end of its life.  OpenEXR writes it, since
// OpenImageIO takes longer to load than most tests run.
class PanoramaFile {
 public:
  // value(k) is the number at k in an array [width / 2][width][3].
  template <class Value>
  PanoramaFile(int width, Value value) {
    std::vector<float> rgb;
    for (int k = 0; k < width * width / 2 * 3; ++k) rgb.push_back(value(k));
    Imf::Header header(width, width / 2);
    Imf::FrameBuffer buffer;
    const char* names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
      header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
      const std::size_t pixel = 3 * sizeof(float);
      buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rgb.data() + c), pixel,
                                         pixel * static_cast<std::size_t>(width)));
    }
    Imf::OutputFile file(path().c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(width / 2);
  }

  std::filesystem::path path() const { return folder_ / "panorama.exr"; }

 private:
  ScratchFolder folder_;
};

}  // namespace domefall
