// How many candidates a face or a cell of a box has. In float throughout, being part of the
// definition of the candidates.
#pragma once

#include <cstdint>

namespace geodisk::ref {

/// A number from the Poisson law of the mean, at most 2^24, by two random words: that of the mean's
/// whole part, where it is at least 8, and that of the rest.
std::uint32_t poisson(float mean, std::uint32_t whole_word, std::uint32_t rest_word);

} // namespace geodisk::ref
