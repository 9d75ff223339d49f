// The parts of a file are made side by side and put down in their order.
#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <vector>

namespace domefall {

// Sets how many threads share the parts of one file.  With 0 (the start) the caller's thread makes
// them alone.  The files are the same.
void set_encoder_threads(int threads);
int encoder_threads();

// Calls make(part, slot) for the parts 0 to count - 1 on several threads, and put(part, slot) for
// one part after the other, in their order.  A slot is the memory of a part from its making until
// it is put.  One that was put serves another part.  Throws what make and put throw.
template <class Slot, class Make, class Put>
void make_in_order(int count, const Make& make, const Put& put) {
  const int threads = encoder_threads();
  if (threads <= 1 || count <= 1) {
    Slot slot;
    for (int part = 0; part < count; ++part) make(part, slot), put(part, slot);
    return;
  }
  // There are so many slots that no thread waits for the one that writes.
  const std::size_t tokens = 2 * static_cast<std::size_t>(threads);
  std::vector<Slot> slots(tokens);
  const auto slot_of = [&](int part) -> Slot& {
    return slots[static_cast<std::size_t>(part) % tokens];
  };
  int next = 0;
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_pipeline(
        tokens, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order,
                                            [&](tbb::flow_control& flow) {
                                              if (next == count) flow.stop();
                                              return next++;
                                            }) &
                    tbb::make_filter<int, int>(tbb::filter_mode::parallel,
                                               [&](int part) {
                                                 make(part, slot_of(part));
                                                 return part;
                                               }) &
                    tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order,
                                                [&](int part) { put(part, slot_of(part)); }));
  });
}

}  // namespace domefall
