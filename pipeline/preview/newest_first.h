// NewestFirst says who may have a picture made, of those who wait for one.  The newest request of
// each client wins, and nothing queues.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>

namespace domefall {

class NewestFirst {
 public:
  // A Ticket is for a client's picture, or for one of two kinds that it has made side by side.
  // `number` grows with each request of that name.
  struct Ticket {
    std::string name;
    long number = 0;
    // This says whether what is made gives way to a newer one of that name, and to all that cannot
    // be stopped themselves, which are soon done.
    bool can_stop = false;
  };

  enum class Turn { kNow, kOutdated, kTooMany };

  // Returns a ticket of the program itself, which waits as long as it must.
  static Ticket own_ticket() { return {}; }

  // Waits until no other picture is made.  After kNow the caller makes its own and then calls
  // leave().  kOutdated says that a newer request of that name has come.  kTooMany says that
  // kMostWaiting wait already, or that end() was called.
  Turn enter(const Ticket& ticket);
  void leave();
  // From now on nobody gets a turn, and what is made is to give way.
  void end();

  // This is set while the picture that is made is to give way.
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
