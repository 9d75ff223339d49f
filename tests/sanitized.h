// Whether sanitizers look at what this build does, which takes ten times as long.
#pragma once

namespace domefall {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

// How many of something a test tries.  Under sanitizers, which find what one way through the code
// does wrong, fewer will do.
constexpr int tries(int usually, int sanitized) { return kSanitized ? sanitized : usually; }

}  // namespace domefall
