// Who may have a picture made, of those who wait for one: the newest request of each client wins,
// and nothing queues.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>

namespace domefall {

class NewestFirst {
 public:
  // A client's picture, or one of two kinds that it has made side by side.  `number` grows with
  // each request of that name.
  struct Ticket {
    std::string name;
    long number = 0;
    // Whether what is made gives way to a newer one of that name, and to all that cannot be stopped
    // themselves: those are soon done.
    bool can_stop = false;
  };

  enum class Turn { kNow, kOutdated, kTooMany };

  // A ticket of the program itself, which waits as long as it must.
  static Ticket own_ticket() { return {}; }

  // Waits until no other picture is made.  kNow: the caller makes its own and then calls leave().
  // kOutdated: a newer request of that name has come.  kTooMany: kMostWaiting wait already, or
  // end() was called.
  Turn enter(const Ticket& ticket);
  void leave();
  // From now on nobody gets a turn, and what is made is to give way.
  void end();

  // Set while the picture that is made is to give way.
  const std::atomic<bool>& stop() const { return stop_; }

  static constexpr int kMostWaiting = 32;

 private:
  bool is_outdated(const Ticket& ticket) const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, long> newest_;
  int waiting_ = 0;
  bool busy_ = false, ended_ = false;
  Ticket made_;  // whose turn it is, while busy_
  std::atomic<bool> stop_ = false;
};

}  // namespace domefall
