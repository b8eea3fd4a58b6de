// JSON as the commands report it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "geodisk/reports/json_type.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/json_text.hpp"

namespace geodisk::tools {

/// Indented, with a line break at the end.
inline std::string text_of(const Json& document) {
    return json_text(document, 2) + '\n';
}

/// Null without a value.
template <class Value>
Json json_of(const std::optional<Value>& value) {
    return value ? Json(*value) : Json(nullptr);
}

/// Returns the warnings about a mesh; `first` is null where there is no place.
inline Json warnings_json(std::span<const MeshWarning> warnings) {
    Json list = Json::array();
    for (const MeshWarning& warning : warnings) {
        list.push_back({{"kind", warning.kind},
                        {"count", warning.count},
                        {"first", warning.first.empty() ? Json(nullptr) : Json(warning.first)},
                        {"message", warning.message},
                        {"file", warning.file}});
    }
    return list;
}

} // namespace geodisk::tools
