// for_each_field: the fields of a job by name, for whoever writes, reads, sends or compares them.
// Experimental.
#pragma once

#include <type_traits>

#include <geodisk/params.hpp>

namespace geodisk {

/// Calls `visit(name, value)` for each field of SampleParams, in their order. A field that is
/// forgotten here does not compile.
template <class Params, class Visitor>
constexpr void for_each_field(Params& params, Visitor&& visit) {
    static_assert(std::is_same_v<std::remove_const_t<Params>, SampleParams>);
    auto& [min_distance, seed, pool_ratio, darts, stop_count, radii, face_keys, face_mask, existing,
           avoid, class_factors, existing_classes, avoid_classes, class_shares, maximal] = params;
    visit("min_distance", min_distance);
    visit("seed", seed);
    visit("pool_ratio", pool_ratio);
    visit("darts", darts);
    visit("stop_count", stop_count);
    visit("radii", radii);
    visit("face_keys", face_keys);
    visit("face_mask", face_mask);
    visit("existing", existing);
    visit("avoid", avoid);
    visit("class_factors", class_factors);
    visit("existing_classes", existing_classes);
    visit("avoid_classes", avoid_classes);
    visit("class_shares", class_shares);
    visit("maximal", maximal);
}

/// Calls `visit(name, value)` for the fields that are numbers, and no data of the caller's.
template <class Params, class Visitor>
constexpr void for_each_number(Params& params, Visitor&& visit) {
    for_each_field(params, [&]<class Field>(const char* name, Field& value) {
        if constexpr (std::is_arithmetic_v<std::remove_const_t<Field>>) {
            visit(name, value);
        }
    });
}

/// Returns a job with the same numbers, which refers to no data.
constexpr SampleParams numbers_of(SampleParams params) {
    for_each_field(params, []<class Field>(const char*, Field& value) {
        if constexpr (!std::is_arithmetic_v<Field>) {
            value = Field{};
        }
    });
    return params;
}

} // namespace geodisk
