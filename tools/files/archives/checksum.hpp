// The checksum of ZIP archives.
#pragma once

#include <cstdint>
#include <string_view>

namespace geodisk::tools {

/// Returns the CRC-32 of ISO 3309, as ZIP and PNG have it. Several threads compute it.
std::uint32_t crc32_of(std::string_view bytes);

} // namespace geodisk::tools
