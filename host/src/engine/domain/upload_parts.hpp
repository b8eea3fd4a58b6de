// UploadParts: the data to upload to a buffer, written record by record.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
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

/// Returns the part that uploads these records, which must outlive it.
template <class Record>
UploadPart upload_part(std::span<const Record> records) {
    return {sizeof(Record), records.size(),
            [records](std::size_t begin, std::size_t end, std::byte* out) {
                std::memcpy(out, &records[begin], (end - begin) * sizeof(Record));
            }};
}

} // namespace geodisk
