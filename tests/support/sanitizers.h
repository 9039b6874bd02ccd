/// Whether the tests are built with the address or the thread sanitizer, by GCC or by
/// Clang. These own the heap: allocations cannot be counted, and limits on memory do not
/// bind.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PREHENSILE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PREHENSILE_SANITIZED 1
#endif
#endif
#ifndef PREHENSILE_SANITIZED
#define PREHENSILE_SANITIZED 0
#endif
