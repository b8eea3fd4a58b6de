// A page of `geodisk report`, read without a browser.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace geodisk::test {

struct PageFile {
    std::string text;
    nlohmann::ordered_json facts;
    std::map<std::string, std::vector<double>> arrays; ///< Numbers as the page's script reads them.
};

/// Throws where the page is not made as it should be.
PageFile read_page(const std::filesystem::path& path);

} // namespace geodisk::test
