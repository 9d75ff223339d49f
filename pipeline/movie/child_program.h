// A ChildProgram is another program, run as a part of this one.  It never outlives it.
#pragma once

#include <sys/types.h>

#include <functional>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/image/descriptor.h"

namespace domefall {

struct ChildOutcome {
  int status = 0;    // as waitpid() tells it
  std::string said;  // the last lines of its standard error

  bool good() const;
  bool killed() const;  // by a signal
  // Says "ended with code 1" or "was ended by signal 9 (Killed)", then what the program said.
  std::string text() const;
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
  ChildProgram(ChildProgram&&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  ChildProgram& operator=(ChildProgram&&) = delete;

  // Writes to its standard input.  Returns false if it does not read any more.
  bool write(const void* bytes, std::size_t count) const;

  // Closes its standard input, and waits until the program has ended.  This may be called once.
  ChildOutcome wait();
  // Returns its standard output, which is complete after wait(), unless it has more than
  // kMostOutput bytes.  Then little more than the first kMostOutput are kept.
  const std::string& output() const { return output_; }
  static constexpr std::size_t kMostOutput = 1 << 20;

 private:
  pid_t process_ = -1;
  int input_ = -1;
  std::string output_;
  std::future<std::string> said_;
  std::future<void> read_;
};

}  // namespace domefall
