// A SignalInbox keeps the signals that a program gets while it looks after other processes, until
// it asks for them.
#pragma once

#include <csignal>
#include <map>
#include <vector>

namespace domefall {

// There is one at a time.  While it lives, INT, TERM, HUP, USR1 and CHLD wake wait() and do nothing
// else.  A signal other than CHLD that the program was started to ignore stays ignored.
class SignalInbox {
 public:
  // Throws TemporaryError where no pipe can be opened.
  SignalInbox();
  ~SignalInbox();
  SignalInbox(const SignalInbox&) = delete;
  SignalInbox& operator=(const SignalInbox&) = delete;

  // Returns the signals since the last call, in their order, without CHLD.
  std::vector<int> take();

  // Returns when a signal comes, when one of the descriptors can be read, or after that time.
  void wait(double seconds, const std::vector<int>& descriptors = {}) const;

 private:
  std::map<int, struct sigaction> before_;
};

}  // namespace domefall
