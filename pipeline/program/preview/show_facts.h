// These facts are what the page of the live preview knows of a show besides its pictures, as JSON.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "pipeline/program/preview/live_show.h"

namespace domefall {

// Returns the show's times, names and choices, and what its observer's instruments say along it.
// It takes some 0.1 s for a long show.
std::string show_facts(const LiveShow::Version& version, int threads);

// A WarningFinder finds a part of what `check` warns of while nothing else is to be done: jumps,
// stars that blind behind the hole, titles that nobody sees, and where the show is brightest and
// darkest.  A short show takes 0.1 s, a long one seconds.
class WarningFinder {
 public:
  // The show must outlive this.
  explicit WarningFinder(LiveShow& show);
  ~WarningFinder();
  WarningFinder(const WarningFinder&) = delete;
  WarningFinder& operator=(const WarningFinder&) = delete;

  // Returns the warnings of the present version, or says that they are not found yet, as JSON.
  std::string as_json() const;

 private:
  void find();

  LiveShow& show_;
  mutable std::mutex mutex_;  // of the two that follow
  int revision_ = 0;
  std::string found_;
  std::atomic<bool> stop_ = false;
  std::thread finding_;
};

}  // namespace domefall
