// A line on the terminal that says how far a run is.  It is silent where there is no terminal.
#pragma once

#include <chrono>
#include <cstddef>

namespace domefall {

class Progress {
 public:
  explicit Progress(std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress& operator=(Progress&&) = delete;

  // Each counts one more frame: one that was made, or one that was there and good.
  void made();
  void skipped();

  std::size_t made_count() const { return made_; }
  std::size_t skipped_count() const { return skipped_; }
  double seconds() const;

 private:
  void draw() const;

  std::size_t total_, made_ = 0, skipped_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace domefall
