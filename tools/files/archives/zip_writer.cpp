#include "files/archives/zip_writer.hpp"

#include <limits>

#include "files/archives/checksum.hpp"
#include "files/byte_order.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

template <class... Values>
void append_all(std::string& bytes, Values... values) {
    (append_little_endian(bytes, values), ...);
}

using U16 = std::uint16_t;
using U32 = std::uint32_t;

constexpr U16 kVersion = 20;
constexpr U16 kFirstDay = 1 << 5 | 1;

} // namespace

void ZipWriter::add(std::string_view name, std::string_view content) {
    if (content.size() > std::numeric_limits<U32>::max()) {
        write(content); // Which refuses it.
    }
    const U32 size = static_cast<U32>(content.size());
    std::string common; // To the local header and the directory.
    // Flags, method, time, date, checksum, size as stored and as read, sizes of name and more.
    append_all(common, kVersion, U16{0}, U16{0}, U16{0}, kFirstDay, crc32_of(content), size, size,
               static_cast<U16>(name.size()), U16{0});
    append_all(directory_, U32{0x02014b50}, kVersion);
    directory_ += common;
    // Comment, disk, attributes twice, place of the local header.
    append_all(directory_, U16{0}, U16{0}, U16{0}, U32{0}, static_cast<U32>(offset_));
    directory_ += name;
    ++count_;
    std::string header;
    append_all(header, U32{0x04034b50});
    write(header + common + std::string(name));
    write(content);
}

void ZipWriter::finish() {
    const auto start = static_cast<U32>(offset_);
    std::string end;
    append_all(end, U32{0x06054b50}, U16{0}, U16{0}, count_, count_,
               static_cast<U32>(directory_.size()), start, U16{0});
    write(directory_ + end);
}

void ZipWriter::write(std::string_view bytes) {
    offset_ += bytes.size();
    if (offset_ > std::numeric_limits<U32>::max()) {
        fail_output("the samples take more than the 4 GiB of an .npz file; use .ply or .csv");
    }
    file_.write(bytes);
}

} // namespace geodisk::tools
