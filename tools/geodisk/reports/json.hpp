// JSON as the commands report it.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace geodisk::tools {

using Json = nlohmann::ordered_json;

/// Indented, with a line break at the end. Paths and driver names may be anything; text that is not
/// UTF-8 is replaced rather than ending the program.
inline std::string text_of(const Json& document) {
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Null without a value.
template <class Value>
Json json_of(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

} // namespace geodisk::tools
