// A fixture for tables of broken shows and the messages about them.
#pragma once

#include <vector>

#include "tests/pipeline/show/show_file.h"

namespace domefall {

class ShowMistakes : public ShowFile {
 protected:
  struct Mistake {
    const char* name;
    std::string yaml;
    // The message without the file's name, with which every line begins: "3:7: size must be ...".
    std::string told;
  };

  static inline const std::string kHole = "black_hole: {mass_solar: 1}\n";
  // These two lines are right.
  static inline const std::string kShow =
      kHole + "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\n";

  static std::string moving(const std::string& trajectory) {
    return kHole + "timeline:\n  - {duration_s: 2, trajectory: " + trajectory + "}\n";
  }

  void expect_complaints(const std::vector<Mistake>& mistakes) {
    EXPECT_EQ(complaint(kShow), "");
    for (const Mistake& m : mistakes) {
      std::string told = "show.yaml:" + m.told;
      for (auto at = told.find('\n'); at != std::string::npos; at = told.find('\n', at + 1))
        told.insert(at + 1, "show.yaml:");
      EXPECT_EQ(complaint(m.yaml), told) << m.name;
    }
  }
};

}  // namespace domefall
