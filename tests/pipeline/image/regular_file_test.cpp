// What is opened for reading: regular files, and nothing that could be waited for.
#include "pipeline/base/regular_file.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <string>

#include "pipeline/base/child_program.h"
#include "pipeline/base/csv_file.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/image/read_image.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

class RegularFiles : public TestFolder {
 protected:
  fs::path pipe() const {
    EXPECT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    return folder_ / "pipe";
  }
  fs::path socket_file() const {
    const fs::path path = folder_ / "socket";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    EXPECT_LT(path.string().size(), sizeof address.sun_path);
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    close(socket);
    return path;
  }
};

// Every reader of this package; of those of others, each opens its files by one of these.
const std::pair<const char*, std::function<void(const fs::path&)>> kReaders[] = {
    {"whole", [](const fs::path& file) { read_file(file, 100); }},
    {"start", [](const fs::path& file) { start_of_file(file, 8); }},
    {"mapped", [](const fs::path& file) { MappedFile{file}; }},
    {"table", [](const fs::path& file) { CsvFile{file}; }},
    {"digest", [](const fs::path& file) { Digest().add_file(file); }},
    {"picture", [](const fs::path& file) { read_image(file); }},
    {"large picture", [](const fs::path& file) { read_light_image(file, PixelEncoding::kOfFile); }},
    {"HEALPix", [](const fs::path& file) { read_healpix(file, 1); }},
};

// Each of these would hang, but for the socket, which cannot be opened.
TEST_F(RegularFiles, AreReadAndPipesSocketsDevicesAndFoldersAreNamedAsWhatTheyAre) {
  const std::pair<fs::path, const char*> others[] = {{pipe(), "this is a pipe; only"},
                                                     {socket_file(), "this is a socket; only"},
                                                     {"/dev/zero", "this is a device; only"},
                                                     {folder_, "this is a folder; only"}};
  for (const auto& reader : kReaders)
    for (const auto& other : others)
      EXPECT_THAT(message_of([&] { reader.second(other.first); }),
                  HasSubstr(other.first.string() + ": " + other.second))
          << reader.first;
}

TEST_F(RegularFiles, BehindALinkCountAsWhatItPointsTo) {
  put(folder_ / "file", "text");
  fs::create_symlink("file", folder_ / "link");
  EXPECT_EQ(read_file(folder_ / "link", 100), "text");
  fs::create_symlink(pipe(), folder_ / "to_pipe");
  EXPECT_THROW(start_of_file(folder_ / "to_pipe", 1), InputError);
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THROW(RegularFile(folder_ / "circle"), InputError);
}

// Files of /proc have no size, and some wait for news when they are read.
TEST_F(RegularFiles, AreReadToTheSizeThatTheySay) {
  EXPECT_EQ(read_file("/proc/self/stat", 100), "");
  put(folder_ / "file", "0123456789");
  EXPECT_EQ(read_file(folder_ / "file", 10), "0123456789");
  EXPECT_EQ(start_of_file(folder_ / "file", 4), "0123");
  EXPECT_EQ(start_of_file(folder_ / "file", 40), "0123456789");
  EXPECT_THAT(message_of([&] { read_file(folder_ / "file", 9); }),
              EndsWith("the file has 10 bytes; at most 9 can be read"));
  RegularFile file(folder_ / "file");
  char bytes[8];
  EXPECT_EQ(file.read(bytes, 8), 8u);
  fs::resize_file(folder_ / "file", 9);
  EXPECT_EQ(file.read(bytes, 8), 1u) << "another program has shortened it";
  EXPECT_EQ(file.read(bytes, 8), 0u);
}

TEST_F(RegularFiles, ThatAreMissingMayBeThereElsewhereButNotWhereTheUserNamedThem) {
  const fs::path none = folder_ / "none";
  const auto message = EndsWith("none: No such file or directory");
  EXPECT_THAT(message_of<TemporaryError>([&] { MappedFile{none}; }), message);
  EXPECT_THAT(message_of<TemporaryError>([&] { Digest().add_file(none); }), message);
  EXPECT_THAT(message_of<TemporaryError>([&] { read_image(none); }), message);
  EXPECT_THAT(message_of([&] { require_file(none); }), message);
  EXPECT_THROW(RegularFile(folder_ / std::string(300, 'x')), InputError);
  EXPECT_FALSE(is_readable_file(none));
  EXPECT_FALSE(is_readable_file(folder_));
  put(none, "");
  EXPECT_TRUE(is_readable_file(none));
  EXPECT_EQ(require_file(none), none);
}

TEST(MemoryFile, HoldsWhatItAndOthersWrite) {
  const MemoryFile file("a test's file");
  const std::string text(200000, 'a');
  file.append(text);
  std::ofstream(file.path(), std::ios::app) << "by name";
  EXPECT_EQ(file.contents(), text + "by name");
}

}  // namespace
}  // namespace domefall
