// Arrays of numpy in an .npz archive.
#pragma once

#include <span>
#include <string>

#include "files/archives/zip_writer.hpp"
#include "files/byte_order.hpp"
#include "files/output/block_writer.hpp"

namespace geodisk::tools {

/// Returns a .npy file of version 1.0 without its content: `type` and `shape` as numpy writes them,
/// "<f8" and "(2, 3)".
std::string array_header(const std::string& type, const std::string& shape);

/// Returns a .npy file with an array; `type` is that of its values.
template <class Value>
std::string shaped_array(const std::string& type, std::span<const Value> values,
                         const std::string& shape) {
    std::string bytes = array_header(type, shape);
    const std::size_t first = bytes.size();
    bytes.resize(first + values.size_bytes());
    for_rows(values.size(), [&](std::size_t i) {
        store_little_endian(bytes.data() + first + i * sizeof(Value), values[i]);
    });
    return bytes;
}

/// Adds an array.
template <class Value>
void add_shaped(ZipWriter& zip, const std::string& name, const std::string& type,
                std::span<const Value> values, const std::string& shape) {
    zip.add(name + ".npy", shaped_array(type, values, shape));
}

/// Adds an array of one dimension, or of rows of `columns` values.
template <class Value>
void add_array(ZipWriter& zip, const std::string& name, const std::string& type,
               std::span<const Value> values, std::size_t columns = 1) {
    const std::string rows = std::to_string(values.size() / columns);
    add_shaped<Value>(zip, name, type, values,
                      '(' + rows + (columns == 1 ? ",)" : ", " + std::to_string(columns) + ')'));
}

} // namespace geodisk::tools
