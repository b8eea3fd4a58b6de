// GEODISK_TRY: hands a failure on to the caller.
#pragma once

#include <utility>

/// Returns the error of a Result from the function around it, if the result holds one. Not with a
/// lambda as part of the argument.
#define GEODISK_TRY(...)                                                                           \
    do {                                                                                           \
        if (auto&& tried = (__VA_ARGS__); !tried) {                                                \
            return std::move(tried).error();                                                       \
        }                                                                                          \
    } while (false)

/// As GEODISK_TRY, in a coroutine.
#define GEODISK_CO_TRY(...)                                                                        \
    do {                                                                                           \
        if (auto&& tried = (__VA_ARGS__); !tried) {                                                \
            co_return std::move(tried).error();                                                    \
        }                                                                                          \
    } while (false)
