#pragma once

#include <algorithm>

namespace ghtrack::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

/// The number of samples, a tenth of it in the slow builds that look for undefined behaviour and
/// races; there at least as many as a statistic needs.
constexpr int samples(int usual, int least = 1) {
  return kSanitized ? std::max(usual / 10, least) : usual;
}

}  // namespace ghtrack::testing
