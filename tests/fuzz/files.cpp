// Any bytes as a file of one kind: GEODISK_FUZZER names the kind and, behind a '_', the format.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "fuzz/reader.hpp"
#include "program/failure.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include "unit/test_files.hpp"

using namespace geodisk::test;
using geodisk::tools::TemporaryFolder;
using geodisk::tools::UserError;

namespace {

constexpr std::string_view kName = GEODISK_FUZZER;

/// Returns the row of the fuzzer.
const Reader& own_reader() {
    for (const Reader& reader : kReaders) {
        if (kName == reader.kind || kName.starts_with(std::string(reader.kind) + '_')) {
            return reader;
        }
    }
    __builtin_trap();
}

/// Returns the format, or "" for a kind of one format.
std::string own_format() {
    return std::string(kName.substr(std::min(own_reader().kind.size() + 1, kName.size())));
}

} // namespace

/// Writes the seeds into the corpus, which is the last argument.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    const std::filesystem::path corpus = (*arguments)[*count - 1];
    if (*count < 2 || !std::filesystem::is_directory(corpus)) {
        return 0;
    }
    int number = 0;
    for (const std::string& seed : own_reader().seeds(own_format())) {
        std::ofstream(corpus / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    static const Reader& reader = own_reader();
    static const std::string name =
        own_format().empty() ? std::string(reader.file) : "fuzzed." + own_format();
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        reader.read({folder.write(name, bytes), bytes});
    } catch (const UserError& error) {
        require_in_fuzzer(!std::string_view(error.what()).empty());
    }
    return 0;
}
