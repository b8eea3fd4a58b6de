// JSON as the commands report it.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "common/sample_file.hpp"
#include "geodisk/spacing_check.hpp"

namespace geodisk::tools {

using Json = nlohmann::ordered_json;

/// Indented, with a line break at the end. Paths and driver names may be anything; text that is not
/// UTF-8 is replaced rather than ending the program.
inline std::string text_of(const Json& document) {
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Distance, rows and candidates of a pair; null without one.
inline Json pair_json(const SampleFile& samples, const std::optional<ClosePair>& pair) {
    if (!pair) {
        return nullptr;
    }
    return {
        {"distance", pair->distance},
        {"samples", {pair->row_a, pair->row_b}},
        {"candidates", {samples.rows[pair->row_a].candidate, samples.rows[pair->row_b].candidate}}};
}

} // namespace geodisk::tools
