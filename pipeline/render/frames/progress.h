// A Progress says how far a run is, either on the terminal or in a form that a queue manager reads.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "pipeline/base/stop_watch.h"

namespace domefall {

// A form prints a line on standard output for each frame that is made or found good.
enum class ProgressForm {
  kPlain,   // frame 12: 3 of 40
  kJson,    // {"frame":12,"done":3,"total":40,"made":true,"seconds":4.2}
  kOpenJd,  // openjd_progress: 7.5, and openjd_status: with the plain text
  // This form prints FRAME: 12 and PROGRESS: 100%.  Afanasy's generic parser counts the frames,
  // takes the percentage for that of the frame, and knows how many frames a task of a numbered
  // block has.
  kAfanasy,
};

// Throws InputError for other names than plain, json, openjd and afanasy.
ProgressForm progress_form(const std::string& name);

class Progress {
 public:
  // Without a form it draws a bar on the terminal, and is silent where there is none.
  explicit Progress(std::size_t total, std::optional<ProgressForm> form = std::nullopt);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Each counts one more frame, which was made or which was there and good.  Its number matters
  // only where a form prints it.
  void made(int frame = 0);
  void skipped(int frame = 0);

  // Ends the bar, which keeps its line.  What is said of the whole run comes after this.
  void end() const;

  std::size_t made_count() const { return made_; }
  std::size_t skipped_count() const { return skipped_; }
  double seconds() const { return watch_.seconds(); }

 private:
  void draw() const;
  std::string bar(std::size_t columns) const;
  void print(int frame, bool made) const;

  std::size_t total_, made_ = 0, skipped_ = 0;
  std::optional<ProgressForm> form_;
  bool terminal_;
  StopWatch watch_;
};

}  // namespace domefall
