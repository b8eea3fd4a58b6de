// Candidates as bytes, for processes to tell each other of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <geodisk/exchange.hpp>

#include "constants.h"
#include "engine/domain/drawn.hpp"

namespace geodisk {

/// Returns the class of a candidate, if samples have any.
inline std::uint8_t class_of(const DrawnCandidate& dart) {
    return static_cast<std::uint8_t>(dart.priority & gpu::kClassMask);
}

/// Appends darts to a message.
void append(Bytes& bytes, std::span<const DrawnCandidate> darts);
/// Reads darts from a message of nothing else.
Darts darts_of(std::span<const std::byte> bytes);

} // namespace geodisk
