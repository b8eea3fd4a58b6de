#include "geodisk/options/given_fields.hpp"

#include <cstddef>

#include "program/failure.hpp"

namespace geodisk::tools {

void GivenFields::add(RequestField field, const std::string& option, bool is_set) {
    if (is_set) {
        fields_.add(field);
        options_[static_cast<std::size_t>(field)] = option;
    }
}

void GivenFields::check() const {
    const auto option = [&](RequestField field) -> const std::string& {
        return options_[static_cast<std::size_t>(field)];
    };
    if (const RequestRule* const rule = broken_rule(fields_)) {
        fail_usage(option(rule->field) + " and " + option(rule->other) +
                   " exclude each other: " + rule->reason);
    }
}

} // namespace geodisk::tools
