// The processes of a farm note their work in the folder of the frames.
// DIR/farm/manifest/WRITER.jsonl is the file of one process, since no two machines may append to
// the same file.  A line of JSON says that a frame is begun, or that one of its files is made.
// Nothing depends on it.  A line that is lost or torn costs a look into the frame's own file.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace domefall {

// A MadeFile is a file of a frame, as its writer left it.
struct MadeFile {
  int frame = 0;
  std::string file;  // its path below the folder of the frames
  std::uint64_t size = 0;
  std::int64_t mtime_ns = 0;  // since 1970, by the clock of the file system
  std::string digest, key;    // as they stand in the file
  double seconds = 0;         // that the frame took, with all its files
  // This is the greatest value of its pixels, scene-linear, or for a graded one the code as a part
  // of white.
  double brightest = 0;
  std::string host;
  pid_t pid = 0;
};

struct BegunFrame {
  int frame = 0;
  double since_s = 0;  // since 1970, by the clock of the machine that makes it
  std::string host;
  pid_t pid = 0;
};

// A ManifestLine is one line of a manifest, whichever of the two it is.
struct ManifestLine {
  std::optional<MadeFile> made;
  std::optional<BegunFrame> begun;
};

std::string text_of(const MadeFile& made);
std::string text_of(const BegunFrame& begun);
// Returns nothing for what is no whole line of this kind.
std::optional<ManifestLine> parse_manifest_line(std::string_view line);

// Returns the folder of the manifests, in that of a farm's files beside the frames.
std::filesystem::path manifest_folder(const std::filesystem::path& frames);

// Writes this process's manifest into a folder of frames that has a farm folder, and nothing into
// any other.  The file is made by the first line, and locked while this lives, which tells others
// that the writer does.  It is not flushed to the disk.
class ManifestWriter {
 public:
  explicit ManifestWriter(std::filesystem::path frames);
  ~ManifestWriter();
  ManifestWriter(const ManifestWriter&) = delete;
  ManifestWriter& operator=(const ManifestWriter&) = delete;

  bool is_on() const { return on_; }

  // Any thread may call this and the next function.  Nothing is thrown where a line cannot be
  // written, because the frame is good without.
  void begin(int frame);
  // Notes a file that lies below the folder of the frames.  Size, time, digest and key are read
  // from it.
  void made(int frame, const std::filesystem::path& path, double seconds, double brightest);

 private:
  void append(const std::string& line);
  bool open_file();

  std::filesystem::path frames_;
  std::string host_;
  std::mutex mutex_;
  int descriptor_ = -1;
  bool on_ = false;
};

// A FrameWriter is a process that has written to a manifest.
struct FrameWriter {
  std::string host;
  pid_t pid = 0;
  // This says that it has surely ended (has_ended() in writer_id.h).  Of a process on another
  // machine nobody knows for a week.
  bool ended = false;
  double first_s = 0;                  // when it began its first frame, since 1970
  double last_sign_s = 0;              // when it last wrote a line, since 1970
  std::map<int, double> being_made;    // frames that it began and has not finished, and since when
  std::vector<std::int64_t> finished;  // when its frames became ready: mtime_ns of their last files
};

struct Manifest {
  // The lines of a file are found by MadeFile::file.  There are several where several processes
  // made it.
  std::unordered_map<std::string, std::vector<MadeFile>> files;
  std::vector<FrameWriter> writers;  // sorted by their files' names

  // Returns the line of a file as it lies on the disk, or null where there is none.
  const MadeFile* find(const std::string& file, std::uint64_t size, std::int64_t mtime_ns) const;
  const MadeFile* find(const std::string& file, const std::string& digest) const;
};

// Returns all manifests of a folder of frames, merged, read by so many threads.  What is torn, or
// written by others, is left out.  So is, with a warning on standard error, a manifest that cannot
// be read, because what it notes can be found out without.
Manifest read_manifest(const std::filesystem::path& frames, int threads);

}  // namespace domefall
