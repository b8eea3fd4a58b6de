#include "geodisk/checks/level_checks.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "files/samples/sample_columns.hpp"
#include "geodisk/reports/json.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Verdict on a level that is spaced, where some samples existed before.
constexpr const char* kButExisting = "all spaced, pairs of existing samples aside";

/// Returns the number of samples up to the end of a level, where levels come in order.
std::size_t end_of(std::span<const std::uint32_t> levels, std::uint32_t level) {
    return static_cast<std::size_t>(std::ranges::upper_bound(levels, level) - levels.begin());
}

/// The distances of all levels in the header.
std::vector<double> distances_in(const std::string& path, const std::string& text) {
    std::vector<std::string_view> words;
    split_tokens(text, words);
    std::vector<double> distances;
    for (const std::string_view word : words) {
        const std::optional<double> distance = parse_positive(word);
        if (!distance || (!distances.empty() && !(*distance < distances.back()))) {
            fail_input(path, "its header has the distances of levels " + in_quotes(text) +
                                 ", not positive numbers that fall");
        }
        distances.push_back(*distance);
    }
    if (distances.empty()) {
        fail_input(path,
                   "its header has no distances of levels in " + std::string(kLevelDistances));
    }
    return distances;
}

/// Checks the numbers of samples up to the end of each level, where the header has them. A file may
/// hold just the first samples.
void check_ends(const SampleFile& samples, std::span<const std::uint32_t> levels,
                std::size_t count) {
    const std::string* const text = samples.header.find(kLevelSamples);
    if (text == nullptr) {
        return;
    }
    std::vector<std::string_view> words;
    split_tokens(*text, words);
    if (words.size() != count) {
        fail_input(samples.path, "its header has " + counted(count, "level", "levels") +
                                     ", but the samples of " + std::to_string(words.size()));
    }
    for (std::uint32_t level = 0; level < count; ++level) {
        const std::size_t end = end_of(levels, level);
        const auto told = parse_integer<std::size_t>(words[level]);
        if (!told || std::min(*told, samples.rows.size()) != end) {
            fail_input(samples.path, "its header has " + in_quotes(words[level]) +
                                         " samples up to level " + std::to_string(level) +
                                         ", the column " + std::string(kLevelColumn) + " " +
                                         std::to_string(end));
        }
    }
}

void check_column(const std::string& path, std::span<const std::uint32_t> levels, std::size_t rows,
                  std::size_t count) {
    if (levels.size() != rows) {
        fail_input(path, "its header has distances of levels, but it has no column " +
                             std::string(kLevelColumn));
    }
    for (std::size_t i = 0; i < rows; ++i) {
        if (levels[i] >= count) {
            fail_input(path, "sample " + std::to_string(i) + " is of level " +
                                 std::to_string(levels[i]) + ", but the header has " +
                                 counted(count, "level", "levels") + ", numbered from 0");
        }
        if (i > 0 && levels[i] < levels[i - 1]) {
            fail_input(path, "sample " + std::to_string(i) +
                                 " is of an earlier level than the one before; levels come in "
                                 "order");
        }
    }
}

} // namespace

std::vector<LevelSpacing> check_levels(const SampleFile& samples, const MeshInput& mesh,
                                       std::span<const double> radii, const SpacingResult& last,
                                       ProgressLine& progress, const NotePairs& note) {
    const std::string* const text = samples.header.find(kLevelDistances);
    std::vector<LevelSpacing> found;
    if (text == nullptr) {
        return found;
    }
    const std::vector<double> distances = distances_in(samples.path, *text);
    const auto levels = samples.extra_values(kLevelColumn);
    check_column(samples.path, levels, samples.rows.size(), distances.size());
    check_ends(samples, levels, distances.size());
    const auto existing = samples.extra_values(kExistingColumn);
    for (std::uint32_t level = 0; level < distances.size(); ++level) {
        const std::size_t end = end_of(levels, level);
        if (level + 1 == distances.size()) {
            found.push_back({distances[level], end, last});
            break;
        }
        const double scale = distances[level] / distances.back();
        std::vector<double> own(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(end));
        for (double& radius : own) {
            radius *= scale;
        }
        ExistingSpacing spacing =
            check_spacing(mesh, std::span(samples.rows).first(end), PairDistances{own},
                          existing.first(existing.empty() ? 0 : end), progress, note);
        found.push_back({distances[level], end, std::move(spacing.others)});
        if (end == samples.rows.size()) {
            break; // The file ends here: later levels are not in it.
        }
    }
    return found;
}

std::string level_lines(const std::vector<LevelSpacing>& levels, bool has_existing) {
    std::string text;
    for (const LevelSpacing& level : levels) {
        text += (text.empty() ? "levels        " : "              ") + grouped(level.samples) +
                " samples at distance " + rounded(level.min_distance, 6) + ", " +
                (level.result.violations.empty()
                     ? (has_existing ? kButExisting : "all spaced")
                     : counted(level.result.violations.size(), "violation", "violations")) +
                '\n';
    }
    return text;
}

std::string level_fault(const std::vector<LevelSpacing>& levels) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (!levels[i].result.violations.empty()) {
            return violation_text(levels[i].result, rounded(levels[i].min_distance, 9)) +
                   ", the distance of level " + std::to_string(i);
        }
    }
    return {};
}

Json levels_json(const std::vector<LevelSpacing>& levels) {
    if (levels.empty()) {
        return nullptr;
    }
    Json list = Json::array();
    for (const LevelSpacing& level : levels) {
        list.push_back({{"min_distance", level.min_distance},
                        {"samples", level.samples},
                        {"smallest", pair_json(level.result.closest)},
                        {"violations", violations_json(level.result)}});
    }
    return list;
}

} // namespace geodisk::tools
