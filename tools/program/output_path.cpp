#include "program/output_path.hpp"

#include <filesystem>
#include <system_error>

#include "common/atomic_file.hpp"

namespace geodisk::tools {

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    if (std::filesystem::equivalent(a, b, ignored)) {
        return true;
    }
    // Paths of files that do not exist yet stay relative unless made absolute first.
    const auto canonical = [&](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    };
    return !canonical(a).empty() && canonical(a) == canonical(b);
}

void check_writable(const std::string& path) {
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

} // namespace geodisk::tools
