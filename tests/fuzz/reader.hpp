// Readers of files and bytes, each a row of a table. files.cpp makes a fuzzer of a row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "program/path.hpp"

namespace geodisk::test {

/// Bytes of a fuzzer, and the file that holds them.
struct FuzzedFile {
    tools::Path path;
    std::string_view bytes;
};

/// One kind of files or bytes.
struct Reader {
    std::string_view kind; ///< The fuzzer is called KIND, or KIND_FORMAT.
    std::string_view file; ///< Name of the file; that of a FORMAT is "fuzzed.FORMAT".
    /// Reads the file. UserError is as good as success. What is wrong traps.
    void (*read)(const FuzzedFile& file);
    /// Returns files of the kind that begin the corpus.
    std::vector<std::string> (*seeds)(const std::string& format);
};

/// Those of the fuzzer's library: file_readers.cpp or byte_readers.cpp.
extern const std::span<const Reader> kReaders;

/// Ends the fuzzer unless `holds`.
inline void require_in_fuzzer(bool holds) {
    if (!holds) {
        __builtin_trap();
    }
}

} // namespace geodisk::test
