// UploadParts: the data to upload to a buffer, written record by record.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace geodisk {

/// Records side by side.
struct UploadPart {
    std::size_t record_bytes;
    std::size_t records;
    /// Writes records `begin` to `end`. Several threads call it at once. It does not throw.
    std::function<void(std::size_t begin, std::size_t end, std::byte* out)> write;

    std::size_t bytes() const { return record_bytes * records; }
};

/// All data of a buffer, in order.
using UploadParts = std::vector<UploadPart>;

} // namespace geodisk
