// Values of command line options that need more than a number: lengths with a unit, sizes, seeds.
// All parsers throw UserError(usage) naming the option and what it takes.
#pragma once

#include <cstdint>
#include <string>

namespace geodisk::tools {

/// A positive length, in mesh units or relative to the diagonal of the bounding box.
struct Length {
    double value = 0;
    bool is_percent = false;

    double in_mesh_units(double diagonal) const {
        return is_percent ? value / 100 * diagonal : value;
    }
};

/// "0.25" or "1.5%".
Length parse_length(const std::string& option, const std::string& text);

/// A whole number of at least 1, also as "1e6".
double parse_count(const std::string& option, const std::string& text);

/// A real number of [low, high].
double parse_ratio(const std::string& option, const std::string& text, double low, double high);

/// All of 64 bits, decimal or hexadecimal with 0x.
std::uint64_t parse_seed(const std::string& option, const std::string& text);

/// Metres per unit of length: a number, or "mm", "cm", "m", "km", "in" or "ft".
double parse_units(const std::string& option, const std::string& text);

/// Bytes, with K, M or G for powers of 1024.
std::uint64_t parse_bytes(const std::string& option, const std::string& text);

} // namespace geodisk::tools
