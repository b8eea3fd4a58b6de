// GEODISK_TRY: hands a failure on to the caller.
#pragma once

#include <utility>

/// Returns the error of a Result from the function around it, if the result holds one. Not with a
/// lambda as part of the argument.
#define GEODISK_TRY(...) GEODISK_TRY_BY(return, __VA_ARGS__)

/// Does the same in a coroutine.
#define GEODISK_CO_TRY(...) GEODISK_TRY_BY(co_return, __VA_ARGS__)

/// Leaves the function by `keyword`. For the two above.
#define GEODISK_TRY_BY(keyword, ...)                                                               \
    do {                                                                                           \
        if (auto&& tried = (__VA_ARGS__); !tried) {                                                \
            keyword std::move(tried).error();                                                      \
        }                                                                                          \
    } while (false)
