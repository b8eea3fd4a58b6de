// Options that exclude each other, by the table of rules of the library.
#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <geodisk/request_rules.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

/// Options that set a field.
struct FieldOptions {
    std::string named; ///< As errors name it.
    Arguments options;
};

/// Returns the options for a field; null where `geodisk sample` has none.
std::optional<FieldOptions> options_for(RequestField field) {
    switch (field) {
    case RequestField::count:
        return FieldOptions{"--count", {"-n", "20"}};
    case RequestField::is_exact:
        return FieldOptions{"--exact", {"--exact"}};
    case RequestField::darts:
        return FieldOptions{"--method darts", {"--method", "darts", "--darts", "9"}};
    case RequestField::stop_count:
        return FieldOptions{"--count", {"-n", "20", "--method", "darts"}};
    case RequestField::maximal:
        return FieldOptions{"--maximal", {"--maximal"}};
    case RequestField::radii:
        return FieldOptions{"--radius-factor", {"--radius-factor", "curvature"}};
    case RequestField::density:
        return FieldOptions{"--density", {"--density", "curvature"}};
    case RequestField::class_factors:
        return FieldOptions{"--classes", {"--classes", "2"}};
    case RequestField::existing:
        return FieldOptions{"--existing", {"--existing", "a.csv"}};
    case RequestField::avoid:
        return FieldOptions{"--avoid", {"--avoid", "a.csv:0.1"}};
    case RequestField::features:
        return FieldOptions{"--features", {"--features", "30"}};
    case RequestField::progressive:
        return FieldOptions{"--order progressive", {"--order", "progressive"}};
    case RequestField::farthest:
        return FieldOptions{"--order farthest", {"--order", "farthest"}};
    case RequestField::keep:
        return FieldOptions{"--keep", {"--keep", "3"}};
    case RequestField::metric:
        return FieldOptions{"--metric euclidean", {"--metric", "euclidean"}};
    case RequestField::at_vertices:
        return FieldOptions{"--at-vertices", {"--at-vertices"}};
    case RequestField::update:
        return FieldOptions{"--from", {"--from", "old.ply"}};
    case RequestField::class_counts: // --count has them, or else a field that excludes them.
    case RequestField::min_distance:
    case RequestField::face_keys:
    case RequestField::frame:
    case RequestField::split_from:
    case RequestField::processes: // See tests of geodisk_mpi.
    case RequestField::frames:    // See tests of FrameSampler.
        break;
    }
    return std::nullopt;
}

/// Returns the fields that the options of two set.
RequestFields fields_with(RequestField a, RequestField b) {
    RequestFields fields;
    for (const RequestField field : {a, b}) {
        fields.add(field);
        fields.add(RequestField::darts, field == RequestField::stop_count);
        fields.add(RequestField::radii, field == RequestField::density);
    }
    return fields;
}

/// Returns what an error calls a field where the options of two are given.
std::string named(RequestField field, RequestField a, RequestField b) {
    const bool is_density = a == RequestField::density || b == RequestField::density;
    return field == RequestField::radii && is_density ? "--density" : options_for(field)->named;
}

/// Returns what a run with the options of two fields prints.
Outcome run_with(const TemporaryFolder& folder, const FieldOptions& a, const FieldOptions& b) {
    const Arguments begin{"sample", "nowhere.ply", "-o", "out.csv"};
    return run(folder, joined(joined(begin, a.options), b.options));
}

} // namespace

TEST_CASE("options are refused by name where their fields exclude each other, and nowhere else") {
    const TemporaryFolder folder;
    for (std::uint32_t i = 0; i < kRequestFields; ++i) {
        for (std::uint32_t k = 0; k < i; ++k) {
            const auto a = static_cast<RequestField>(i), b = static_cast<RequestField>(k);
            const auto first = options_for(a), second = options_for(b);
            // Given twice, an option is refused in another way.
            if (!first || !second || first->options[0] == second->options[0]) {
                continue;
            }
            const Outcome outcome = run_with(folder, *first, *second);
            INFO(first->named, " ", second->named, ": ", outcome.err);
            CHECK(outcome.status != 0);
            if (const RequestRule* const rule = broken_rule(fields_with(a, b))) {
                CHECK(outcome.status == 2);
                CHECK(contains(outcome.err, named(rule->field, a, b) + " and " +
                                                named(rule->other, a, b) +
                                                " exclude each other: " + rule->reason));
            } else {
                CHECK_FALSE(contains(outcome.err, "exclude each other"));
            }
        }
    }
    CHECK_FALSE(std::filesystem::exists(folder / "out.csv"));
}

} // namespace geodisk::test
