#include "engine/domain/classes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

double factor_of(const SampleParams& params, std::uint32_t a, std::uint32_t b) {
    return params.class_factors[std::size_t{class_count(params)} * a + b];
}

/// Returns the largest factor of a class.
double reach_of(const SampleParams& params, std::uint32_t a) {
    const std::uint32_t count = class_count(params);
    double reach = 0;
    for (std::uint32_t b = 0; b < count; ++b) {
        reach = std::max(reach, factor_of(params, a, b));
    }
    return reach;
}

/// Returns the candidates of a class per candidate with the minimum distance for all.
double density_of(const SampleParams& params, std::uint32_t a) {
    const double factor = factor_of(params, a, a);
    return 1 / (factor * factor);
}

std::string pair_text(std::uint32_t a, std::uint32_t b) {
    return "of classes " + std::to_string(a) + " and " + std::to_string(b);
}

Result<Done> check_factors(const SampleParams& params) {
    const std::uint32_t count = class_count(params);
    if (count < 2 || count > gpu::kMaxClasses ||
        std::size_t{count} * count != params.class_factors.size()) {
        return invalid("the table of classes has " + std::to_string(params.class_factors.size()) +
                       " factors; it takes K * K of them for 2 to 8 classes");
    }
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = 0; b < count; ++b) {
            const double factor = factor_of(params, a, b);
            const bool is_free = a != b && factor == 0;
            if (!is_free && !(factor >= kMinClassFactor && factor <= 1)) {
                return invalid("the factor " + pair_text(a, b) + " is " + number_text(factor) +
                               ", not " + (a == b ? "" : "0 or ") + "from " +
                               number_text(kMinClassFactor) + " to 1");
            }
            if (factor != factor_of(params, b, a)) {
                return invalid("the table of classes is not symmetric: it has two factors " +
                               pair_text(a, b));
            }
        }
    }
    return Done{};
}

Result<Done> check_avoid_classes(const SampleParams& params) {
    const auto classes = params.avoid_classes;
    if (!classes.empty() && classes.size() != params.avoid.size()) {
        return invalid("there are " + std::to_string(classes.size()) + " classes for " +
                       std::to_string(params.avoid.size()) + " disks to avoid");
    }
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (classes[i] != kAllClasses && classes[i] >= class_count(params)) {
            return invalid("point to avoid " + std::to_string(i) + " keeps out class " +
                           std::to_string(classes[i]) + ", but there are " +
                           std::to_string(class_count(params)) + ", numbered from 0");
        }
    }
    return Done{};
}

Result<Done> check_shares(const SampleParams& params, std::uint32_t faces) {
    const auto shares = params.class_shares;
    const std::size_t of_class = std::size_t{3} * faces;
    if (!shares.empty() && shares.size() != class_count(params) * of_class) {
        return invalid("there are " + std::to_string(shares.size()) + " shares of classes; " +
                       std::to_string(class_count(params)) + " classes take 3 for each of " +
                       std::to_string(faces) + " faces");
    }
    const auto wrong =
        std::ranges::find_if(shares, [](float share) { return !(share >= 0 && share <= 1); });
    if (wrong != shares.end()) {
        const auto at = static_cast<std::size_t>(wrong - shares.begin());
        return invalid("the share of class " + std::to_string(at / of_class) + " in face " +
                       std::to_string(at % of_class / 3) + " is " + number_text(*wrong) +
                       ", not from 0 to 1");
    }
    return Done{};
}

/// Returns the number of words of the shares, whole rows.
std::size_t share_words(const SampleParams& params) {
    return (params.class_shares.size() / 3 + 3) / 4 * 4;
}

/// Returns a share in units of 1 / kWholeShare. Only 0 is none.
std::uint32_t share_steps(float share) {
    const auto steps = std::lround(static_cast<double>(share) * gpu::kWholeShare);
    return share > 0 ? static_cast<std::uint32_t>(std::max(steps, 1L)) : 0;
}

} // namespace

std::uint32_t class_count(const SampleParams& params) noexcept {
    std::uint32_t count = 1;
    while (std::size_t{count} * count < params.class_factors.size()) {
        ++count;
    }
    return count;
}

double class_density(const SampleParams& params) noexcept {
    if (params.class_factors.empty()) {
        return 1;
    }
    double density = 0;
    for (std::uint32_t a = 0; a < class_count(params); ++a) {
        density += density_of(params, a);
    }
    return density;
}

double class_crowding(const SampleParams& params) noexcept {
    double most = params.class_factors.empty() ? 1 : 0;
    const std::uint32_t count = params.class_factors.empty() ? 0 : class_count(params);
    for (std::uint32_t a = 0; a < count; ++a) {
        double conflicts = 0;
        for (std::uint32_t b = 0; b < count; ++b) {
            const double factor = factor_of(params, a, b);
            conflicts += density_of(params, b) * factor * factor;
        }
        most = std::max(most, conflicts);
    }
    return most;
}

float class_cells_per_unit(const SampleParams& params) noexcept {
    double least = 1;
    for (std::uint32_t a = 0; a < class_count(params); ++a) {
        least = std::min(least, reach_of(params, a));
    }
    const auto half = static_cast<float>(least / 2);
    return std::bit_cast<float>(0x7f000000u - (std::bit_cast<std::uint32_t>(half) & 0x7f800000u));
}

Result<Done> check_classes(const SampleParams& params, std::uint32_t faces) {
    if (params.class_factors.empty()) {
        const char* const what = !params.existing_classes.empty() ? "existing samples have classes"
                                 : !params.avoid_classes.empty()  ? "disks to avoid have classes"
                                 : !params.class_shares.empty()   ? "classes have shares"
                                                                  : nullptr;
        return what == nullptr ? Result<Done>(Done{})
                               : invalid(std::string(what) + ", but there is no table of classes");
    }
    GEODISK_TRY(check_factors(params));
    GEODISK_TRY(check_avoid_classes(params));
    GEODISK_TRY(check_shares(params, faces));
    if (!params.existing_classes.empty() &&
        params.existing_classes.size() != params.existing.size()) {
        return invalid("there are " + std::to_string(params.existing_classes.size()) +
                       " classes for " + std::to_string(params.existing.size()) +
                       " existing samples");
    }
    for (std::size_t i = 0; i < params.existing_classes.size(); ++i) {
        if (params.existing_classes[i] >= class_count(params)) {
            return invalid("existing sample " + std::to_string(i) + " has class " +
                           std::to_string(params.existing_classes[i]) + ", but there are " +
                           std::to_string(class_count(params)) + ", numbered from 0");
        }
    }
    return Done{};
}

std::size_t class_bytes(const SampleParams& params) {
    return params.class_factors.empty()
               ? 0
               : sizeof(ClassWords) + share_words(params) * sizeof(std::uint32_t);
}

ClassWords class_table(const SampleParams& params) {
    ClassWords table{};
    const auto word_of = [](double x) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(x));
    };
    std::fill_n(table.begin(), gpu::kMaxClasses, ~0u);
    const std::uint32_t count = class_count(params);
    const double all = class_density(params);
    double below = 0, densest = 0;
    for (std::uint32_t a = 0; a < count; ++a) {
        densest = std::max(densest, density_of(params, a));
    }
    for (std::uint32_t a = 0; a < count; ++a) {
        table[gpu::kClassTurns + a] =
            static_cast<std::uint32_t>(density_of(params, a) / densest * 0x1p31);
        below += density_of(params, a);
        if (a + 1 < count) {
            table[a] = static_cast<std::uint32_t>(below / all * 0x1p32) - 1;
        }
        table[gpu::kClassReaches + a] = word_of(reach_of(params, a));
        for (std::uint32_t b = 0; b < count; ++b) {
            table[gpu::kClassDistances + gpu::kMaxClasses * a + b] =
                word_of(factor_of(params, a, b));
        }
    }
    table[gpu::kClassCells] = std::bit_cast<std::uint32_t>(class_cells_per_unit(params));
    table[gpu::kClassShares] = params.class_shares.empty() ? 0 : count;
    return table;
}

std::uint32_t priority_with_class(const ClassWords& table, std::uint32_t priority,
                                  std::uint32_t random) noexcept {
    std::uint32_t number = 0;
    for (std::uint32_t a = 0; a + 1 < gpu::kMaxClasses; ++a) {
        number += random > table[a] ? 1u : 0u;
    }
    const std::uint64_t turned = std::uint64_t{priority << 1} * table[gpu::kClassTurns + number];
    return (static_cast<std::uint32_t>(turned >> 32) & ~gpu::kClassMask) | number;
}

void add_classes(const SampleParams& params, UploadParts& parts) {
    if (params.class_factors.empty()) {
        return;
    }
    const ClassWords table = class_table(params);
    const std::uint32_t count = class_count(params);
    parts.push_back({sizeof table[0], table.size(),
                     [table](std::size_t begin, std::size_t end, std::byte* out) {
                         std::memcpy(out, &table[begin], (end - begin) * sizeof table[0]);
                     }});
    parts.push_back(
        {sizeof(std::uint32_t), share_words(params),
         [count, shares = params.class_shares](std::size_t begin, std::size_t end, std::byte* out) {
             const std::size_t words = shares.size() / 3;
             for (std::size_t i = begin; i < end; ++i, out += sizeof(std::uint32_t)) {
                 std::uint32_t word = 0;
                 const std::size_t of_face = 3 * (words / count * (i % count) + i / count);
                 for (std::size_t k = 0; k < 3 && i < words; ++k) {
                     word |= share_steps(shares[of_face + k]) << (k * gpu::kShareBits);
                 }
                 std::memcpy(out, &word, sizeof word);
             }
         }});
}

} // namespace geodisk
