// JSON documents as text.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "program/safe_text.hpp"

namespace geodisk::tools {

/// Returns `document` indented by `indent` blanks, or on one line for -1. Paths and driver names
/// may be anything: U+FFFD stands for bytes that are no UTF-8, and control characters are escaped.
inline std::string json_text(const nlohmann::ordered_json& document, int indent) {
    return escaped_json(
        document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace geodisk::tools
