// Memory for what is looked at all over: in large pages, where the system has them, so that finding a
// page costs nothing.
#pragma once

#include <cstddef>
#include <memory>

namespace domefall {

// Zeroed.  Throws std::bad_alloc.
std::shared_ptr<void> large_pages(std::size_t bytes);

}  // namespace domefall
