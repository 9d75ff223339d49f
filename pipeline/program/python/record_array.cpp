#include "pipeline/program/python/record_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace py = pybind11;

namespace domefall {
namespace {

py::dtype record_type(const std::vector<RecordColumn>& columns) {
  py::list fields;
  for (const auto& [name, kind] : columns) {
    const std::string text = fmt::format("U{}", RecordArray::kMostLetters);
    fields.append(py::make_tuple(name, kind == CellKind::kCount    ? "i4"
                                       : kind == CellKind::kNumber ? "f8"
                                                                   : text));
  }
  return py::dtype::from_args(fields);
}

}  // namespace

RecordArray::RecordArray(const std::vector<RecordColumn>& columns,
                         const std::vector<py::ssize_t>& shape)
    : array_(record_type(columns), shape),
      size_(static_cast<std::size_t>(array_.size())),
      record_bytes_(static_cast<std::size_t>(array_.itemsize())),
      first_(static_cast<char*>(array_.mutable_data())) {}

void RecordArray::start(std::size_t record) { next_ = first_ + record * record_bytes_; }

void RecordArray::add(int count) {
  std::memcpy(next_, &count, sizeof count);
  next_ += sizeof count;
}

void RecordArray::add(double number) {
  std::memcpy(next_, &number, sizeof number);
  next_ += sizeof number;
}

// numpy keeps four bytes for each letter, and fills the cell with zeros.
void RecordArray::add(std::string_view text) {
  assert(text.size() <= kMostLetters);
  std::array<char32_t, kMostLetters> letters{};
  std::copy_n(text.begin(), std::min(text.size(), kMostLetters), letters.begin());
  std::memcpy(next_, letters.data(), sizeof letters);
  next_ += sizeof letters;
}

}  // namespace domefall
