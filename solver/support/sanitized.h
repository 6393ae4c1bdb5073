// Which sanitizer watches this build: g++ tells by macros, clang by features. Sanitizers reserve
// terabytes of address space, report on standard error and make system calls of their own.
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TWINARM_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define TWINARM_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define TWINARM_ADDRESS_SANITIZER
#endif
#if defined(__SANITIZE_THREAD__)
#define TWINARM_THREAD_SANITIZER
#endif
#if defined(TWINARM_ADDRESS_SANITIZER) || defined(TWINARM_THREAD_SANITIZER)
#define TWINARM_SANITIZED
#endif

namespace twinarm {

#ifdef TWINARM_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

}  // namespace twinarm
