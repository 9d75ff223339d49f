// A USD stage that is written as text (.usda), as far as the motion of its objects goes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// A UsdValue has the numbers and the texts of a value, in their order and without its brackets.
struct UsdValue {
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

struct UsdAttribute {
  UsdValue fixed;                      // what holds where there are no samples
  std::map<double, UsdValue> samples;  // by time codes

  // Returns the value at a time code.  Between samples numbers change evenly.
  UsdValue at(double time) const;
};

struct UsdPrim {
  std::string type, path;
  int line = 0;
  const UsdPrim* parent = nullptr;
  std::map<std::string, UsdAttribute, std::less<>> attributes;
  std::vector<std::unique_ptr<UsdPrim>> children;
};

struct UsdStage {
  double codes_per_second = 24;
  bool z_is_up = false;
  UsdPrim root;
};

// Reads a stage.  References, variants and other files are not followed.  `file` is named in
// messages.  Throws InputError with the line for what is no such text.
UsdStage read_usd_stage(const std::string& file, std::string_view text);

}  // namespace domefall
