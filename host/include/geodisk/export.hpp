// GEODISK_API: marks what a shared build of geodisk exports. Empty in a static build. A build that
// defines it itself keeps its definition.
// Stable.
#pragma once

#ifndef GEODISK_API
#if !defined(GEODISK_SHARED)
#define GEODISK_API
#elif defined(_WIN32) && defined(GEODISK_EXPORTS)
#define GEODISK_API __declspec(dllexport)
#elif defined(_WIN32)
#define GEODISK_API __declspec(dllimport)
#else
#define GEODISK_API __attribute__((visibility("default")))
#endif
#endif
