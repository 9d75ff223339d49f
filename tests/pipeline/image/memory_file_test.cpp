#include "pipeline/image/memory_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace domefall {
namespace {

TEST(MemoryFile, HoldsWhatItAndOthersWrite) {
  const MemoryFile file("a test's file");
  const std::string text(200000, 'a');
  file.append(text);
  std::ofstream(file.path(), std::ios::app) << "by name";
  EXPECT_EQ(file.contents(), text + "by name");
}

TEST(MemoryFile, IsReadFromItsBeginningAfterRewind) {
  const MemoryFile file("a test's file");
  file.append("script");
  char first = 0;
  EXPECT_EQ(::read(file.number(), &first, 1), 0);
  file.rewind();
  EXPECT_EQ(::read(file.number(), &first, 1), 1);
  EXPECT_EQ(first, 's');
}

}  // namespace
}  // namespace domefall
