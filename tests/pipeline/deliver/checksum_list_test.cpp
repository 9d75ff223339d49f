#include "pipeline/deliver/checksum_list.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/image/errors.h"
#include "pipeline/image/scratch_folder.h"

namespace domefall {
namespace {

TEST(ChecksumList, HoldsTheSumsOfTheStandard) {
  const ScratchFolder folder;
  std::ofstream(folder / "abc") << "abc";
  std::ofstream(folder / "empty");
  // FIPS 180-2, appendix B.1, and the sum of no bytes.
  EXPECT_EQ(sha256_of_file(folder / "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(folder / "empty"),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(ChecksumList, IsReadBack) {
  const std::vector<ListedFile> files{{std::string(64, 'a'), "frames/a_00001.png"},
                                      {std::string(64, '0'), "audio/my sound.wav"}};
  EXPECT_EQ(parse_checksum_list(checksum_list(files)), files);
  EXPECT_TRUE(parse_checksum_list("").empty());
}

TEST(ChecksumList, IsRefusedWhereItIsBrokenOffOrLeadsOut) {
  const std::string sum(64, 'a');
  for (const std::string& text :
       {sum + "  a", sum + " a\n", sum + "  \n", sum.substr(1) + "  a\n", sum + "b  a\n",
        sum + "  ../a\n", sum + "  /etc/passwd\n", sum + "  b/../../a\n", std::string("\n"),
        std::string(64, 'G') + "  a\n"})
    EXPECT_THROW(parse_checksum_list(text), InputError) << text;
}

}  // namespace
}  // namespace domefall
