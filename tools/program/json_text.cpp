#include "program/json_text.hpp"

#include <nlohmann/json.hpp>

#include "program/safe_text.hpp"

namespace geodisk::tools {

std::string json_text(const nlohmann::ordered_json& document, int indent) {
    return escaped_json(
        document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace geodisk::tools
