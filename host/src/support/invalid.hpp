// Makes `invalid_argument` errors.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <geodisk/status.hpp>

namespace geodisk {

inline Error invalid(std::string message, std::uint64_t element = kNoElement) {
    return Error{Status::invalid_argument, std::move(message), element};
}

} // namespace geodisk
