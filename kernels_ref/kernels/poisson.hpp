// Number of candidates of a face or a cell of a box. In float throughout, since it is part of the
// definition of the candidates.
#pragma once

#include <cstdint>

namespace geodisk::ref {

/// Returns a Poisson number for the mean, at most 2^24, from two random words: one for the integer
/// part of the mean, if it is at least 8, and one for the rest.
std::uint32_t poisson(float mean, std::uint32_t whole_word, std::uint32_t rest_word);

} // namespace geodisk::ref
