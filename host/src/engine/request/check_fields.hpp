// Refuses fields that exclude each other.
#pragma once

#include <geodisk/params.hpp>
#include <geodisk/request_rules.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Returns an error that names the fields of the first rule that is broken, if any is.
Result<Done> check_fields(RequestFields fields);

/// Checks parameters for whoever serves `field`, which they do not tell of.
inline Result<Done> check_fields(const SampleParams& params, RequestField field) {
    RequestFields fields = fields_of(params);
    fields.add(field);
    return check_fields(fields);
}

} // namespace geodisk
