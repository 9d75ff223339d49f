// A note beside a plan tells of the work after its frames.  It is there while that work goes on,
// and stays where the work failed or was killed.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "farm/plan.h"

namespace domefall {

// Writes DIR/farm/conclusion_ID.txt, with the log that tells more if there is one.  An empty text
// removes it.  Throws as write_atomically().
void note_conclusion(const FarmPlan& plan, const std::string& text,
                     const std::filesystem::path& log);

// Returns the note of a plan with its log's last line, or an empty text if there is none.
std::string conclusion_of(const std::filesystem::path& out, const std::string& plan_id);

// Does the work that concludes a plan or a round of it, under such a note.
template <class Work>
void do_noted(const FarmPlan& plan, const std::filesystem::path& log, const Work& work) {
  note_conclusion(plan, "verification, movie and delivery: begun " + utc_now() + ", not ended",
                  log);
  try {
    work();
  } catch (const std::exception& error) {
    note_conclusion(plan, std::string("verification, movie and delivery: ") + error.what(), log);
    throw;
  }
  note_conclusion(plan, {}, {});
}

}  // namespace domefall
