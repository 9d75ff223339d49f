// A note beside a plan that tells of the work after its frames: it is there while that goes on, and
// stays where it failed or was killed.
#pragma once

#include <exception>
#include <string>

#include "pipeline/farm/plan.h"

namespace domefall {

// Writes DIR/farm/conclusion_ID.txt, with the log of this job of Slurm if it is one; an empty text
// removes it.  Throws as write_atomically().
void note_conclusion(const FarmPlan& plan, const std::string& text);

// The note of a plan with its log's last line; empty if there is none.
std::string conclusion_of(const std::filesystem::path& out, const std::string& plan_id);

// Does the work that concludes a plan or a round of it, under such a note.
template <class Work>
void do_noted(const FarmPlan& plan, const Work& work) {
  note_conclusion(plan, "verification, movie and delivery: begun " + utc_now() + ", not ended");
  try {
    work();
  } catch (const std::exception& error) {
    note_conclusion(plan, std::string("verification, movie and delivery: ") + error.what());
    throw;
  }
  note_conclusion(plan, {});
}

}  // namespace domefall
