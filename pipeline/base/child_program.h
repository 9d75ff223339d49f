// A ChildProgram is another program, run as a part of this one.  It never outlives it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/regular_file.h"

namespace domefall {

struct ChildOutcome {
  int status = 0;    // as waitpid() tells it
  std::string said;  // the last lines of its standard error

  bool good() const;
  bool killed() const;  // by a signal
  // Says "ended with code 1" or "was ended by signal 9 (Killed)", then what the program said.
  std::string text() const;
};

// Starts a program that the PATH finds, with an argument vector and no shell.  It begins as a copy of
// this process in which all signals are held back: prepare(parent) arranges its descriptors and
// signals there, and may call nothing that could take a lock.  Without an `environment` (NAME=VALUE
// each) it has that of this process.  Returns the process, or an errno with a minus.
pid_t start_program(std::vector<std::string> arguments, std::vector<std::string> environment,
                    const std::function<void(pid_t parent)>& prepare);

// The exit code of a copy that could not become its program.
inline constexpr int kCannotStart = 127;

// A Pipe has an end to read from and one to write to, which programs that are started do not inherit.
// Throws TemporaryError, which begins with the program's name, if none can be made.
struct Pipe {
  explicit Pipe(const std::string& program);

  int from = -1, to = -1;
};

// Runs the program of a name that the PATH finds, with an argument vector and no shell.  Its
// standard error is read all the time, so that it never waits for that.  The kernel kills it when
// the thread that started it ends, whatever ended that.  Signals to the terminal's group do not
// reach it.
class ChildProgram {
 public:
  // `arguments` begin with the name.  `kept` are descriptors of this process that the program
  // shares under the same numbers.  Throws TemporaryError if it cannot be started.  If it is not on
  // the PATH, the message says that Debian's `package` has it.
  ChildProgram(std::vector<std::string> arguments, const std::vector<int>& kept,
               const std::string& package);
  // Kills the program if it has not been waited for.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  // Writes to its standard input.  Returns false if it does not read any more.
  bool write(const void* bytes, std::size_t count) const {
    return write_all(input_, {static_cast<const char*>(bytes), count});
  }

  // Closes its standard input, and waits until the program has ended.  This may be called once.
  ChildOutcome wait();
  // Returns its standard output, which is complete after wait(), unless it has more than
  // kMostOutput bytes.  Then little more than the first kMostOutput are kept.
  const std::string& output() const { return output_; }
  static constexpr std::size_t kMostOutput = 1 << 20;
  // Returns how many bytes it has written to its standard output, kept or not, after wait().
  std::uint64_t output_bytes() const { return output_bytes_; }

 private:
  pid_t process_ = -1;
  int input_ = -1;
  std::string output_;
  std::uint64_t output_bytes_ = 0;
  std::future<std::string> said_;
  std::future<void> read_;
};

// A MemoryFile is a file in memory, for what another program or library reads from a file, or
// writes to one.  It has no name in any folder and is gone with its users, so that
// nothing is left behind, however the program ends.
class MemoryFile {
 public:
  // `purpose` is what errors call it.  Throws TemporaryError if there is no memory for it.
  explicit MemoryFile(const std::string& purpose);

  // Throw TemporaryError.  All that the file holds is returned, whoever wrote it.
  void append(std::string_view bytes) const;
  std::string contents() const;

  // Returns the descriptor, which programs that this one starts do not inherit unless they are
  // given it.
  int number() const { return descriptor_.number(); }
  // Returns a path under which this process and those that inherit the descriptor may open it.
  std::string path() const;

 private:
  std::string purpose_;
  Descriptor descriptor_;
};

}  // namespace domefall
