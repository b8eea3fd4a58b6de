// Refuses fields that exclude each other.
#pragma once

#include <geodisk/request_rules.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Returns an error that names the fields of the first rule that is broken, if any is.
Result<Done> check_fields(RequestFields fields);

} // namespace geodisk
