// JSON documents as text.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace geodisk::tools {

/// Returns `document` indented by `indent` blanks, or on one line for -1. Paths and driver names
/// may be anything: U+FFFD stands for bytes that are no UTF-8, and control characters are escaped.
std::string json_text(const nlohmann::ordered_json& document, int indent);

} // namespace geodisk::tools
