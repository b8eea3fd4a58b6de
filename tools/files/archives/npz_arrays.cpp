#include "files/archives/npz_arrays.hpp"

namespace geodisk::tools {

std::string array_header(const std::string& type, const std::string& shape) {
    std::string text =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    constexpr std::size_t kBefore = 10, kAlignment = 64;
    text.append(kAlignment - (kBefore + text.size() + 1) % kAlignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    append_little_endian(header, static_cast<std::uint16_t>(text.size()));
    return header + text;
}

} // namespace geodisk::tools
