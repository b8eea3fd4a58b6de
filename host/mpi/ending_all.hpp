// Ends all processes by an error that only one of them knows.
#pragma once

#include <type_traits>
#include <utility>

#include "geodisk/mpi.hpp"
#include "support/guard.hpp"

namespace geodisk {

/// Returns what `work` returns, a Result. Ends all processes by what it throws, if the options say
/// how, or else returns it as an error.
template <class Work>
std::invoke_result_t<Work> ending_all(const ProcessOptions& options, const Work& work) noexcept {
    auto result = guarded([&]() -> Result<std::invoke_result_t<Work>> { return work(); });
    if (result) {
        return std::move(*result);
    }
    if (options.ends_all) {
        options.ends_all(result.error());
    }
    return std::move(result).error();
}

} // namespace geodisk
