// Candidates as bytes, for processes to tell each other of.
#pragma once

#include <cstddef>
#include <span>

#include <geodisk/exchange.hpp>

#include "engine/domain/drawn.hpp"

namespace geodisk {

/// Appends darts to a message.
void append(Bytes& bytes, std::span<const DrawnCandidate> darts);
/// Reads darts from a message of nothing else.
Darts darts_of(std::span<const std::byte> bytes);

} // namespace geodisk
