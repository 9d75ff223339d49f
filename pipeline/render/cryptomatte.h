// A Cryptomatte says which objects a pixel belongs to, and how much of it is each one's, as
// compositing programs read it: the public specification of Psyop, version 1.2.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

// Returns the number by which an object's name is known: MurmurHash3 of 32 bits, as a float that is
// neither infinite nor denormal.
float cryptomatte_id(const std::string& name);

class Cryptomatte {
 public:
  // `objects` are all that the show has.  A pixel can tell as many of them apart, up to 6.
  Cryptomatte(int width, int height, const std::vector<std::string>& objects);

  // Adds an object that covers this part of each pixel, 0 to 1, [height][width].  It lies in front
  // of those that were added before, or beside them.
  void add(const std::string& name, const std::vector<float>& covered);
  void add_in_front(const std::string& name, const std::vector<float>& covered);

  const ChannelImage& image() const { return image_; }
  // Returns the attributes of the file's header, among them the manifest of all objects.
  std::vector<std::pair<std::string, std::string>> attributes() const;

 private:
  ChannelImage image_;
  std::vector<std::string> objects_;
};

}  // namespace domefall
