// A Descriptor is a file descriptor that is closed with its owner.
#pragma once

#include <unistd.h>

namespace domefall {

class Descriptor {
 public:
  // A descriptor of -1, which open() returns where it fails, is none and closes nothing.
  explicit Descriptor(int opened) : number_(opened) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace domefall
