// A WorkerProcess is another program that does a part of the work, and may be killed, stopped, or
// slow to end.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace domefall {

class SignalInbox;

// A WorkerEnd is how a process ended.
struct WorkerEnd {
  int code = 0;    // its exit code
  int signal = 0;  // the signal that killed it, or 0

  // Says "exit code 75" or "killed by SIGKILL".
  std::string text() const;
};

class WorkerProcess {
 public:
  struct Way {
    int log = -1;               // what it says is copied to this descriptor; -1: to none
    bool own_session = true;    // what is typed at the terminal does not reach it
    bool ends_with_us = true;   // it is told to end (TERM) when this process has died
    bool ignores_term = false;  // it ignores TERM
    std::vector<std::string> environment = {};  // NAME=VALUE each; none: that of this process
  };

  // Starts a program that the PATH finds, with no standard input.  Throws TemporaryError if it
  // cannot be started.
  WorkerProcess(const std::vector<std::string>& arguments, const Way& way);
  // Tells the program to end, and does not wait for it.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  pid_t process() const { return process_; }
  // Returns a descriptor that can be read when the program has said something.
  int talk() const { return talk_; }

  // Sends a signal, which also reaches a process that is stopped.
  void tell(int signal) const;

  // Copies what the program has said since, and returns how it ended, if it has.
  std::optional<WorkerEnd> look();

  // Looks whether the program has been stopped, as by SIGSTOP, since the last look.  The first time
  // it is continued, and later it is killed.  Both are said on standard error.
  void handle_stop(const std::string& name);

  // These return its last line, and all that it said.  Of more than 128 KiB only the end is kept,
  // at least 64 KiB of it.
  std::string last_line() const;
  const std::string& said() const { return said_; }

 private:
  void copy();

  pid_t process_ = -1;
  int talk_ = -1, log_ = -1, stops_ = 0;
  std::string said_;
};

// Runs a program to its end and returns how it ended.  What it prints and says is in `said`.  A
// program that cannot be started has exit code 127.  With ignores_term it ignores TERM and outlives this
// process.  The environment is that of WorkerProcess::Way.
WorkerEnd run_program(const std::vector<std::string>& arguments, std::string& said,
                      bool ignores_term = false, std::vector<std::string> environment = {});

std::string signal_name(int signal);

}  // namespace domefall
