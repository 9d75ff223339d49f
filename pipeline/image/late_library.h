// Libraries of our own are loaded when they are first needed, since what they bring would slow
// every start of the program.
#pragma once

#include <string>

namespace domefall {

// An Interface is what stands on one side of such a library and is used on the other.
class Interface {
 public:
  Interface() = default;
  virtual ~Interface() = default;
  Interface(const Interface&) = delete;
  Interface(Interface&&) = delete;
  Interface& operator=(const Interface&) = delete;
  Interface& operator=(Interface&&) = delete;
};

// Loads lib<name>.so, which is never unloaded, and returns what its function <name>, of the type
// `const Interface* ()` and C linkage, points to.  The dynamic linker looks in the program's
// RUNPATH, which CMakeLists.txt sets for the build tree and for an installation.  Throws
// TemporaryError saying that the part of the program that does `work` ("reads images") cannot be
// loaded, and why.
const Interface& load_library(const std::string& name, const char* work);

// Loads a library whose function returns a T, which derives from Interface.
template <class T>
const T& late_library(const std::string& name, const char* work) {
  return static_cast<const T&>(load_library(name, work));
}

}  // namespace domefall
