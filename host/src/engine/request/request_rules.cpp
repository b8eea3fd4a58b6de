// Fields of a request that exclude each other.
#include <algorithm>
#include <iterator>

#include <string>

#include <geodisk/request.hpp>

#include "engine/request/check_fields.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

using Field = RequestField;

constexpr RequestRule kRules[] = {
    {Field::is_exact, Field::darts, "darts stop at an exact count already"},
    {Field::is_exact, Field::stop_count, "an exact count is one to stop at"},
    {Field::is_exact, Field::maximal, "an exact count drops the last samples, which leaves gaps"},
    {Field::maximal, Field::darts, "darts are no pool to complete"},
    {Field::maximal, Field::stop_count, "a count drops the last samples, which leaves gaps"},
    {Field::maximal, Field::class_factors, "gaps are those of samples without classes"},
    {Field::maximal, Field::density, "a density leaves gaps by chance"},
    {Field::maximal, Field::metric, "gaps are found along the surface"},
    {Field::class_factors, Field::radii, "classes have the distances of their table"},
    {Field::class_factors, Field::metric, "classes go by distances along the surface"},
    {Field::class_counts, Field::count, "classes have numbers of their own"},
    {Field::class_counts, Field::stop_count, "classes have numbers of their own"},
    {Field::features, Field::class_factors, "samples on features have no class"},
    {Field::features, Field::density, "curves have no area that a density could fill"},
    {Field::features, Field::metric, "features keep distances along the surface"},
    {Field::features, Field::frame, "features are those of a whole mesh"},
    {Field::features, Field::split_from, "features are those of the mesh before it was split"},
    {Field::progressive, Field::darts, "darts fill no level"},
    {Field::progressive, Field::class_factors, "levels are sampled without classes"},
    {Field::progressive, Field::maximal, "each level has the gaps of its pool"},
    {Field::progressive, Field::metric, "levels keep distances along the surface"},
    {Field::progressive, Field::keep, "the first samples are those of the first levels"},
    {Field::progressive, Field::frame, "levels have frames of their own"},
    {Field::farthest, Field::split_from, "samples are ordered where they are told"},
    {Field::farthest, Field::metric, "the order goes by distances along the surface"},
    {Field::metric, Field::radii, "distances through space do not vary"},
    {Field::metric, Field::avoid, "disks to avoid lie along the surface"},
    {Field::metric, Field::frame, "frames are for distances along the surface"},
    {Field::frame, Field::count, "a frame has a distance already"},
    {Field::frame, Field::split_from, "samples in a frame are told on the faces that it samples"},
    {Field::at_vertices, Field::face_keys, "keys are of faces, and vertices go by their numbers"},
    {Field::at_vertices, Field::darts, "each vertex is one dart"},
    {Field::at_vertices, Field::maximal, "gaps are those between all points of the surface"},
    {Field::at_vertices, Field::density, "vertices have the density that they have"},
    {Field::at_vertices, Field::class_factors, "vertices are drawn without classes"},
    {Field::at_vertices, Field::features, "samples on features lie between vertices"},
    {Field::at_vertices, Field::metric, "vertices keep distances along the surface"},
    {Field::at_vertices, Field::frame, "vertices are those of a whole mesh"},
    {Field::at_vertices, Field::split_from, "vertices are those of the mesh before it was split"},
    {Field::update, Field::count, "an update keeps the distance"},
    {Field::update, Field::darts, "the last dart of a number may lie anywhere"},
    {Field::update, Field::stop_count, "the last sample of a number may lie anywhere"},
    {Field::update, Field::maximal, "gaps are filled from all over the surface"},
    {Field::update, Field::class_factors, "an update knows no classes"},
    {Field::update, Field::features, "features are those of a whole mesh"},
    {Field::update, Field::progressive, "each level would be an update of its own"},
    {Field::update, Field::farthest, "an edit changes the order of all samples"},
    {Field::update, Field::metric, "an edit reaches as far as distances along the surface"},
    {Field::update, Field::at_vertices, "an edit numbers vertices anew"},
    {Field::processes, Field::at_vertices, "processes draw the candidates of faces"},
    {Field::processes, Field::maximal, "gaps are found on the whole surface"},
    {Field::processes, Field::class_factors, "processes exchange samples without classes"},
    {Field::processes, Field::metric, "processes divide a surface by distances along it"},
    {Field::processes, Field::frame, "processes have the frame of their own surface"},
    {Field::processes, Field::update, "processes sample a surface anew"},
    {Field::frames, Field::at_vertices, "frames draw the candidates of faces"},
    {Field::frames, Field::count, "a distance is found for a count by several runs"},
    {Field::frames, Field::class_counts, "samples are left out when all are there"},
    {Field::frames, Field::maximal, "gaps are filled by several runs"},
    {Field::frames, Field::features, "features are a run of their own"},
    {Field::frames, Field::progressive, "each level is a run of its own"},
    {Field::frames, Field::farthest, "the order is found when all samples are there"},
    {Field::frames, Field::metric, "frames get samples by distances along the surface"},
};

static_assert(kRequestFields == static_cast<std::uint32_t>(Field::frames) + 1 &&
              kRequestFields <= 32);

} // namespace

RequestFields fields_of(const SampleParams& params) noexcept {
    RequestFields fields;
    fields.add(Field::min_distance, params.min_distance != 0);
    fields.add(Field::darts, params.darts != 0);
    fields.add(Field::stop_count, params.stop_count != 0);
    fields.add(Field::maximal, params.maximal);
    fields.add(Field::radii, params.radii != nullptr);
    fields.add(Field::density, params.radii != nullptr && !params.radii->packing().empty());
    fields.add(Field::class_factors, !params.class_factors.empty());
    fields.add(Field::face_keys, !params.face_keys.empty());
    fields.add(Field::existing, !params.existing.empty());
    fields.add(Field::avoid, !params.avoid.empty());
    return fields;
}

RequestFields fields_of(const SampleRequest& request) noexcept {
    RequestFields fields = fields_of(request.params);
    fields.add(Field::count, request.count != 0);
    fields.add(Field::is_exact, request.is_exact);
    fields.add(Field::class_counts, !request.class_counts.empty());
    fields.add(Field::features, request.features != 0);
    fields.add(Field::progressive, request.order == SampleOrder::progressive);
    fields.add(Field::farthest, request.order == SampleOrder::farthest);
    fields.add(Field::keep, request.keep != 0);
    fields.add(Field::metric, request.metric.has_value());
    fields.add(Field::frame, request.frame != nullptr);
    fields.add(Field::split_from, request.split_from != nullptr);
    fields.add(Field::at_vertices, request.at_vertices);
    return fields;
}

const char* to_string(RequestField field) noexcept {
    constexpr const char* kNames[] = {
        "min_distance", "count",      "is_exact",      "darts",        "stop_count", "maximal",
        "radii",        "density",    "class_factors", "class_counts", "face_keys",  "existing",
        "avoid",        "features",   "progressive",   "farthest",     "keep",       "metric",
        "frame",        "split_from", "at_vertices",   "update",       "processes",  "frames"};
    static_assert(std::size(kNames) == kRequestFields);
    return kNames[static_cast<std::size_t>(field)];
}

std::span<const RequestRule> request_rules() noexcept {
    return kRules;
}

const RequestRule* broken_rule(RequestFields fields) noexcept {
    const auto* const found = std::ranges::find_if(kRules, [&](const RequestRule& rule) {
        return fields.has(rule.field) && fields.has(rule.other);
    });
    return found != std::end(kRules) ? found : nullptr;
}

Result<Done> check_fields(RequestFields fields) {
    if (const RequestRule* const rule = broken_rule(fields)) {
        return invalid(std::string(to_string(rule->field)) + " and " + to_string(rule->other) +
                       " exclude each other: " + rule->reason);
    }
    return Done{};
}

} // namespace geodisk
