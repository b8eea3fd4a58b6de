#include "files/archives/zip_reader.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include "files/archives/checksum.hpp"
#include "files/archives/inflate.hpp"
#include "files/byte_order.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using U16 = std::uint16_t;
using U32 = std::uint32_t;

constexpr std::size_t kEndSize = 22, kEntrySize = 46, kLocalSize = 30;

class ZipReader {
  public:
    ZipReader(const Path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

    std::vector<ZipMember> read() {
        const std::size_t end = find_end();
        const auto count = at<U16>(end + 10);
        std::size_t place = at<U32>(end + 16);
        std::vector<ZipMember> members;
        for (U16 i = 0; i < count; ++i) {
            if (at<U32>(place) != 0x02014b50) {
                fail_damaged();
            }
            members.push_back(read_member(place));
            place += kEntrySize + at<U16>(place + 28) + at<U16>(place + 30) + at<U16>(place + 32);
        }
        return members;
    }

  private:
    /// The end of the directory is the last of the file, but for a comment.
    std::size_t find_end() const {
        const std::size_t end = bytes_.rfind("PK\x05\x06");
        if (end == std::string_view::npos || bytes_.size() - end < kEndSize) {
            fail_input(path_, "is no whole ZIP archive; the file may be cut short");
        }
        return end;
    }

    /// Reads the file whose entry in the directory begins at `entry`.
    ZipMember read_member(std::size_t entry) {
        const auto flags = at<U16>(entry + 8), method = at<U16>(entry + 10);
        const std::size_t stored = at<U32>(entry + 20), size = at<U32>(entry + 24);
        const std::size_t local = at<U32>(entry + 42);
        ZipMember member{std::string(part(entry + kEntrySize, at<U16>(entry + 28))), {}};
        constexpr U32 kIsElsewhere = 0xffffffff;
        if (stored == kIsElsewhere || size == kIsElsewhere || local == kIsElsewhere) {
            fail_input(path_, in_quotes(member.name) + " has 4 GiB or more; save it as .npy");
        }
        if ((flags & 1) != 0) {
            fail_input(path_, in_quotes(member.name) + " is encrypted; save it without a password");
        }
        if (at<U32>(local) != 0x04034b50) {
            fail_damaged();
        }
        const std::string_view content =
            part(local + kLocalSize + at<U16>(local + 26) + at<U16>(local + 28), stored);
        stored_ += stored; // Files that share bytes could be far larger than the archive.
        if (stored_ > bytes_.size()) {
            fail_damaged();
        }
        constexpr U16 kStored = 0, kDeflated = 8;
        if (method == kStored) {
            member.content = content;
        } else if (method == kDeflated) {
            std::optional<std::string> unpacked = inflated(path_, content, size);
            if (!unpacked) {
                fail_damaged();
            }
            member.content = std::move(*unpacked);
        } else {
            fail_input(path_, in_quotes(member.name) +
                                  " is compressed in a way that is not read; use numpy.savez");
        }
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION // Fuzzers are to get past the checksum.
        if (crc32_of(member.content) != at<U32>(entry + 16)) {
            fail_damaged();
        }
#endif
        return member;
    }

    template <class Value>
    Value at(std::size_t place) const {
        return value_of_bytes<Value>(part(place, sizeof(Value)).data());
    }

    std::string_view part(std::size_t place, std::size_t size) const {
        if (place > bytes_.size() || size > bytes_.size() - place) {
            fail_damaged();
        }
        return bytes_.substr(place, size);
    }

    [[noreturn]] void fail_damaged() const {
        fail_input(path_, "is a damaged ZIP archive; write it again");
    }

    const Path& path_;
    std::string_view bytes_;
    std::size_t stored_ = 0; ///< Bytes of the files so far, as they are in the archive.
};

} // namespace

std::vector<ZipMember> read_zip(const Path& path, std::string_view bytes) {
    return ZipReader(path, bytes).read();
}

} // namespace geodisk::tools
