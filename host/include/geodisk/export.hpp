// GEODISK_API: marks what a shared build of geodisk exports. Empty in a static build. A build may
// define it otherwise before.
#pragma once

#if defined(GEODISK_API)
// As the build defines it.
#elif !defined(GEODISK_SHARED)
#define GEODISK_API
#elif defined(_WIN32) && defined(GEODISK_EXPORTS)
#define GEODISK_API __declspec(dllexport)
#elif defined(_WIN32)
#define GEODISK_API __declspec(dllimport)
#else
#define GEODISK_API __attribute__((visibility("default")))
#endif
