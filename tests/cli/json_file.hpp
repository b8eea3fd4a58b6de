// JSON that the programs write.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {

using Json = nlohmann::json;

/// Returns the document in a file of the folder.
inline Json json_in(const TemporaryFolder& folder, const std::string& name) {
    return Json::parse(bytes_of(folder / name));
}

} // namespace geodisk::test
