// Memory for arrays that are read in no order.  It comes in large pages where the system has them,
// so that few of them are needed and the processor keeps all of their addresses.
#pragma once

#include <cstddef>
#include <memory>

namespace domefall {

// Returns so many bytes of 0.  Throws std::bad_alloc.
std::shared_ptr<void> large_pages(std::size_t bytes);

}  // namespace domefall
