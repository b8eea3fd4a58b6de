// Switch between languages: these headers are read by GLSL and by C++.
#ifndef GEODISK_SHARED_ABI_H
#define GEODISK_SHARED_ABI_H

#ifdef __cplusplus
#include <cstdint>
#define GEODISK_BEGIN_SHARED namespace geodisk::gpu { using uint = std::uint32_t;
#define GEODISK_END_SHARED }
#define GEODISK_CONST inline constexpr
#else
#define GEODISK_BEGIN_SHARED
#define GEODISK_END_SHARED
#define GEODISK_CONST const
#endif

#endif
