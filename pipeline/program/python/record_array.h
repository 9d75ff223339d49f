// A RecordArray is a structured array of numpy that is filled cell by cell.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

enum class CellKind { kCount, kNumber, kText };  // int32, float64, text of up to kMostLetters

struct RecordColumn {
  std::string name;
  CellKind kind;
};

class RecordArray {
 public:
  static constexpr std::size_t kMostLetters = 16;

  // Makes an array whose memory is not yet initialised.  Throws pybind11::error_already_set.
  RecordArray(const std::vector<RecordColumn>& columns,
              const std::vector<pybind11::ssize_t>& shape);

  std::size_t size() const { return size_; }

  // After start(), the add() functions fill the cells of that record in the order of the columns,
  // each with a value of its column's kind.  None of them needs Python's lock.  A text is ASCII and
  // at most kMostLetters long.
  void start(std::size_t record);
  void add(int count);
  void add(double number);
  void add(std::string_view text);

  const pybind11::array& array() const { return array_; }

 private:
  pybind11::array array_;
  std::size_t size_, record_bytes_;
  char* first_;
  char* next_ = nullptr;
};

}  // namespace domefall
