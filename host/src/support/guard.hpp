// The exception boundary: every public function that may allocate runs its body in `guarded`.
#pragma once

#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <geodisk/status.hpp>

namespace geodisk {

/// Runs `body`, which returns some Result<T>, and turns whatever it throws into an Error.
///
/// The messages below stay within the string's small buffer (15 characters in the usual standard
/// libraries): with no memory left, the report must not allocate.
template <class Body>
std::invoke_result_t<Body> guarded(Body&& body) noexcept {
    try {
        return std::forward<Body>(body)();
    } catch (const std::bad_alloc&) {
        return Error{Status::out_of_host_memory, "out of memory"};
    } catch (const std::length_error&) {
        return Error{Status::out_of_host_memory, "size too large"};
    } catch (...) {
        return Error{Status::internal, "unexpected"};
    }
}

} // namespace geodisk
