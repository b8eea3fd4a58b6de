// A set of samples as one number, to compare sets by.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "files/samples/sample_file.hpp"

namespace geodisk::tools {

/// Returns the fingerprint of samples on a surface: 16 hexadecimal digits of FNV-1a with 64 bits,
/// over the face and the three float weights of each sample in order, every word as four bytes with
/// the lowest first. Equal sets have equal fingerprints; others practically never.
std::string fingerprint_of(std::span<const SampleRow> rows);

/// The same of samples in a box, over their coordinates in order, every double as two words with
/// the lower one first.
std::string fingerprint_of(std::span<const double> coordinates);

/// Key of the header entry with the digest.
inline constexpr std::string_view kDigest = "digest";

/// Returns the digest of samples on a surface: the sum of the fingerprints of each one by itself,
/// modulo 2^64. It is the same in any order.
std::uint64_t digest_number(std::span<const SampleRow> rows);
/// Returns it as it is written.
std::string digest_text(std::uint64_t number);
std::string digest_of(std::span<const SampleRow> rows);

/// Key of the header entry with the digest of the surface, where it has walls, a mask or radii that
/// vary: files of them may change.
inline constexpr std::string_view kSurfaceDigest = "surface_digest";

/// Throws UserError(bad_input) for a header with a digest that is none.
void check_digest(const Path& path, const SampleHeader& header);

} // namespace geodisk::tools
