// Sanitizer of GCC or Clang that the tests are built with.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define GEODISK_HAS_ADDRESS_SANITIZER true
#elif defined(__SANITIZE_THREAD__)
#define GEODISK_HAS_THREAD_SANITIZER true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GEODISK_HAS_ADDRESS_SANITIZER true
#elif __has_feature(thread_sanitizer)
#define GEODISK_HAS_THREAD_SANITIZER true
#endif
#endif
#ifndef GEODISK_HAS_ADDRESS_SANITIZER
#define GEODISK_HAS_ADDRESS_SANITIZER false
#endif
#ifndef GEODISK_HAS_THREAD_SANITIZER
#define GEODISK_HAS_THREAD_SANITIZER false
#endif
