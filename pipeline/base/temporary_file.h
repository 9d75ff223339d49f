// Files under temporary names, scratch folders, and what becomes of those whose writer died.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

namespace domefall {

// Returns where a symbolic link leads, or a link to a link, or else the path itself.  Nothing need
// be there.  A link for which `is_end` holds is taken for an end itself.  Throws as
// throw_file_error().
std::filesystem::path end_of_links(
    const std::filesystem::path& path, bool (*is_end)(const std::filesystem::path&) =
                                           [](const std::filesystem::path&) { return false; });

// A TemporaryFile is an empty file beside `path`, open for reading and writing and locked for as
// long as this lives.  Its name is .NAME.domefall-<who writes it>-<count>.tmp, where NAME is the
// beginning of that of `path` (writer_id.h).  Where `path` is a symbolic link, the file at its end
// is meant, so that the link stays.  It is removed if it does not become `path`, also where a
// signal ends the program.
class TemporaryFile {
 public:
  // Throws InputError where `path` is something that no file may replace, such as a folder, a
  // device or a pipe.  Throws as throw_file_error() where no file can be made.
  explicit TemporaryFile(const std::filesystem::path& path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& path() const { return path_; }

  // Gives the file, written and flushed, its name, once, and flushes the folder.  Throws as
  // throw_file_error().  A file that was at `path` is then still there.
  void put_in_place();

 private:
  void create(std::uint64_t device);
  bool lock() const;
  void discard();

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

// Has the names in a folder written to the disk.  Throws as throw_file_error().
void flush_folder(const std::filesystem::path& folder);

// Makes a folder and those above it, and removes what dead writers left in it.  Throws InputError
// where the path leads through a file or round a circle of links, or is too long, and TemporaryError
// for any other failure.
void make_folder(const std::filesystem::path& folder);

// Removes from a folder (not from those below it) the files that TemporaryFile made and whose
// writers have surely ended (has_ended() in writer_id.h), and nothing else.  Returns how many were
// removed.  A folder that cannot be read has none.  Nothing is thrown.
int sweep_temporaries(const std::filesystem::path& folder);

// A ScratchFolder is a new folder in $TMPDIR, or /tmp, that only this user may enter.  It is removed
// with all that it holds, also where a signal ends the program.  What a program that was killed has
// left there is removed by the next ScratchFolder of the same user.
class ScratchFolder {
 public:
  // Throws TemporaryError if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  // Makes the folder of this name, whose end mkdtemp() fills in.  Returns false if a sweep took it
  // at once.
  bool make(std::string name);

  std::filesystem::path path_;
  int lock_ = -1;  // held on the folder for as long as it is used
};

// The list of what would stay behind if the program ended now, so that a signal can end it at any
// moment and leave nothing.  While this lives, remove_unfinished() waits.  Whoever makes something
// unfinished, names it or removes it does so under one, so that the list and the disk agree.
class UnfinishedList {
 public:
  UnfinishedList();
  void add(const std::filesystem::path& path);
  // Takes from the list what is finished, or removed.
  void drop(const std::filesystem::path& path);

 private:
  std::unique_lock<std::mutex> held_;
};

// Removes all that is unfinished, folders with what they hold.  Whoever begins or finishes
// something afterwards waits for ever, because this is for a program that is about to end.
void remove_unfinished() noexcept;

}  // namespace domefall
