// Which fields of a request exclude each other.
#include <algorithm>

#include <geodisk/request.hpp>

namespace geodisk {
namespace {

using Field = RequestField;

constexpr RequestRule kRules[] = {
    {Field::is_exact, Field::darts, "darts stop at exactly stop_count samples"},
    {Field::is_exact, Field::stop_count, "an exact count is one already"},
    {Field::is_exact, Field::maximal, "an exact count drops the last samples, which leaves gaps"},
    {Field::maximal, Field::darts, "darts are no pool to complete"},
    {Field::maximal, Field::stop_count, "a count drops the last samples, which leaves gaps"},
    {Field::maximal, Field::class_factors, "gaps are those of samples without classes"},
    {Field::maximal, Field::metric, "gaps are found along the surface"},
    {Field::class_factors, Field::radii, "classes have the distances of their table"},
    {Field::class_factors, Field::metric, "classes go by distances along the surface"},
    {Field::features, Field::class_factors, "samples on features have no class"},
    {Field::features, Field::metric, "features keep distances along the surface"},
    {Field::features, Field::frame, "features are those of a whole mesh"},
    {Field::features, Field::split_from, "features are those of the mesh before it was split"},
    {Field::progressive, Field::darts, "darts fill no level"},
    {Field::progressive, Field::class_factors, "levels are sampled without classes"},
    {Field::progressive, Field::features, "each level would have features of its own"},
    {Field::progressive, Field::maximal, "each level has the gaps of its pool"},
    {Field::progressive, Field::metric, "levels keep distances along the surface"},
    {Field::progressive, Field::keep, "the first samples are those of the first levels"},
    {Field::progressive, Field::frame, "levels have frames of their own"},
    {Field::farthest, Field::existing, "existing samples come first"},
    {Field::farthest, Field::split_from, "samples are ordered where they are told"},
    {Field::farthest, Field::metric, "the order goes by distances along the surface"},
    {Field::metric, Field::radii, "distances through space do not vary"},
    {Field::metric, Field::frame, "frames are for distances along the surface"},
    {Field::frame, Field::count, "a frame has a distance already"},
    {Field::frame, Field::split_from, "samples in a frame are told on the faces that it samples"},
};

bool is_set(const SampleRequest& request, Field field) {
    const SampleParams& params = request.params;
    switch (field) {
    case Field::min_distance:
        return params.min_distance != 0;
    case Field::count:
        return request.count != 0;
    case Field::is_exact:
        return request.is_exact;
    case Field::darts:
        return params.darts != 0;
    case Field::stop_count:
        return params.stop_count != 0;
    case Field::maximal:
        return params.maximal;
    case Field::radii:
        return params.radii != nullptr;
    case Field::class_factors:
        return !params.class_factors.empty();
    case Field::existing:
        return !params.existing.empty();
    case Field::features:
        return request.features != 0;
    case Field::progressive:
        return request.order == SampleOrder::progressive;
    case Field::farthest:
        return request.order == SampleOrder::farthest;
    case Field::keep:
        return request.keep != 0;
    case Field::metric:
        return request.metric.has_value();
    case Field::frame:
        return request.frame != nullptr;
    case Field::split_from:
        return request.split_from != nullptr;
    }
    return false;
}

} // namespace

const char* to_string(RequestField field) noexcept {
    constexpr const char* kNames[] = {"min_distance", "count",    "is_exact",    "darts",
                                      "stop_count",   "maximal",  "radii",       "class_factors",
                                      "existing",     "features", "progressive", "farthest",
                                      "keep",         "metric",   "frame",       "split_from"};
    return kNames[static_cast<std::size_t>(field)];
}

std::span<const RequestRule> request_rules() noexcept {
    return kRules;
}

const RequestRule* broken_rule(const SampleRequest& request) noexcept {
    const auto* const found = std::ranges::find_if(kRules, [&](const RequestRule& rule) {
        return is_set(request, rule.field) && is_set(request, rule.other);
    });
    return found != std::end(kRules) ? found : nullptr;
}

} // namespace geodisk
