// Candidates of a whole surface that processes tell each other of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/domain/drawn.hpp"
#include "parts/exchange.hpp"

namespace geodisk {

/// Candidates in dart order. Their faces are numbered in the whole.
using Darts = std::vector<DrawnCandidate>;

/// Dart order of a job whose faces have keys, or have none.
struct DartOrder {
    bool has_keys = false;

    bool operator()(const DrawnCandidate& a, const DrawnCandidate& b) const {
        return is_before(a, b, has_keys);
    }
};

/// Appends darts to a message.
void append(Bytes& bytes, std::span<const DrawnCandidate> darts);
/// Reads darts from a message of nothing else.
Darts darts_of(std::span<const std::byte> bytes);

} // namespace geodisk
