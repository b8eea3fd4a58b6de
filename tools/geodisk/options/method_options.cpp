#include "geodisk/options/method_options.hpp"

#include <algorithm>
#include <cmath>

#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

/// Darts for each sample there is room for, after which a count counts as out of reach.
constexpr double kDartsPerSample = 1000;

/// Pool ratio of --dense.
constexpr double kDensePoolRatio = 100;

constexpr const char* kMethodGroup = "Method";

void check_method(const MethodOptions& options) {
    if (options.method != "pool" && options.method != "psdp" && !options.throws_darts()) {
        fail_choice("--method", options.method, std::vector<std::string>{"pool", "darts"});
    }
    if (options.throws_darts() && !options.pool_ratio.empty()) {
        fail_usage("--pool-ratio is for --method pool; with darts, give the number of darts by "
                   "--darts");
    }
    if (!options.throws_darts() && !options.darts.empty()) {
        fail_usage("--darts is for --method darts; with pool, give the number of candidates by "
                   "--pool-ratio");
    }
}

/// Checks that --dense contradicts nothing.
void check_filling(const MethodOptions& options) {
    if (options.is_dense && options.throws_darts()) {
        fail_usage("--dense is for --method pool; with darts, raise --darts");
    }
    if (options.is_dense && !options.pool_ratio.empty()) {
        fail_usage("--dense is a --pool-ratio of 100; give just one of them");
    }
    if (options.is_maximal && options.is_dense) {
        fail_usage("--maximal leaves no gaps, so --dense adds nothing; give just one of them");
    }
}

/// A count that candidates, whose index has 32 bits, can reach.
std::uint32_t parse_candidates(const std::string& option, const std::string& text) {
    const double value = parse_count(option, text);
    if (value > kMaxCandidates) {
        fail_usage(option + ": " + in_quotes(text) + " is too many; the maximum is " +
                   grouped(kMaxCandidates));
    }
    return static_cast<std::uint32_t>(value);
}

/// Returns true for a number for each class.
bool has_class_counts(const std::string& count) {
    return count.find(',') != std::string::npos;
}

std::vector<std::uint32_t> parse_class_counts(const std::string& count) {
    std::vector<std::uint32_t> counts;
    for (std::string word : parts_of(count)) {
        word.erase(std::remove(word.begin(), word.end(), ' '), word.end());
        counts.push_back(parse_candidates("--count", word));
    }
    return counts;
}

void parse_order(const MethodOptions& options, Method& method) {
    check_choice("--order", options.order,
                 std::vector<std::string>{"dart", "progressive", "farthest"});
    method.has_levels = options.order == "progressive";
    method.is_farthest = options.order == "farthest";
    method.keep = parse_keep(options.keep, method.is_farthest);
    if (!method.has_levels && !(options.levels.empty() && options.level_factor.empty())) {
        fail_usage(std::string(options.levels.empty() ? "--level-factor" : "--levels") +
                   " is for --order progressive");
    }
    if (!options.levels.empty()) {
        const double count = parse_count("--levels", options.levels);
        if (count > kMaxLevels) {
            fail_usage("--levels: " + in_quotes(options.levels) + " is too many; the maximum is " +
                       std::to_string(kMaxLevels));
        }
        method.levels.count = static_cast<std::uint32_t>(count);
    }
    if (!options.level_factor.empty()) {
        method.levels.factor =
            parse_ratio("--level-factor", options.level_factor, kMinLevelFactor, kMaxLevelFactor);
    }
}

} // namespace

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

std::uint32_t Method::darts_for(double samples) const {
    if ((params.stop_count == 0 && class_counts.empty()) || params.darts != 0) {
        return params.darts;
    }
    return static_cast<std::uint32_t>(
        std::min<double>(kMaxCandidates, std::ceil(kDartsPerSample * std::max(1.0, samples))));
}

double Method::distance_factor() const {
    // By packing density.
    return params.maximal ? 0.778 / 0.721 : is_dense ? 0.752 / 0.721 : 1;
}

double Method::expected(double samples) const {
    const double room = std::max(1.0, samples);
    return params.stop_count != 0 ? std::min<double>(room, params.stop_count) : room;
}

void Method::check_count(std::uint64_t samples, double min_distance, std::uint64_t thrown) const {
    if (params.darts == 0 && samples < params.stop_count) {
        fail_usage("--count: placed only " + grouped(samples) + " of " +
                   grouped(params.stop_count) + " samples at distance " + rounded(min_distance, 6) +
                   " with " + grouped(thrown) +
                   " darts; lower --count or the distance, or accept fewer samples with --darts");
    }
}

void Method::check_classes(std::span<const std::uint8_t> classes, double min_distance,
                           std::uint64_t thrown) const {
    for (std::size_t k = 0; k < class_counts.size(); ++k) {
        const auto samples = static_cast<std::uint64_t>(std::ranges::count(classes, k));
        if (params.darts == 0 && samples < class_counts[k]) {
            fail_usage("--count: placed only " + grouped(samples) + " of " +
                       grouped(class_counts[k]) + " samples of class " + std::to_string(k) +
                       ", where the largest distance is " + rounded(min_distance, 6) + ", with " +
                       grouped(thrown) +
                       " darts; lower the count or the distances, or accept fewer samples with "
                       "--darts");
        }
    }
}

GivenFields given_fields(const MethodOptions& options, const std::string& count) {
    using Field = RequestField;
    const bool is_darts = options.throws_darts();
    const Field field = has_class_counts(count) ? Field::class_counts
                        : is_darts              ? Field::stop_count
                                                : Field::count;
    GivenFields given;
    given.add(field, "--count", !count.empty());
    given.add(Field::is_exact, "--exact", options.exact);
    given.add(Field::darts, "--method darts", is_darts);
    given.add(Field::maximal, "--maximal", options.is_maximal);
    given.add(Field::progressive, "--order progressive", options.order == "progressive");
    given.add(Field::farthest, "--order farthest", options.order == "farthest");
    given.add(Field::keep, "--keep", !options.keep.empty());
    return given;
}

Method parse_method(const MethodOptions& options, const std::string& count) {
    given_fields(options, count).check();
    check_method(options);
    check_filling(options);
    if (has_class_counts(count) && !options.throws_darts()) {
        fail_usage("--count: " + in_quotes(count) +
                   " is a number for each class, which takes --method darts; with a pool, --count "
                   "is the number of all samples together");
    }
    Method method;
    method.throws_darts = options.throws_darts();
    method.is_dense = options.is_dense;
    method.params.maximal = options.is_maximal;
    method.params.pool_ratio = options.is_dense ? kDensePoolRatio : method.params.pool_ratio;
    if (!options.pool_ratio.empty()) {
        method.params.pool_ratio = parse_ratio("--pool-ratio", options.pool_ratio, 1, 10000);
    }
    if (method.throws_darts) {
        if (count.empty() && options.darts.empty()) {
            fail_usage("--method darts needs a number to stop at; give --count, --darts or both");
        }
        if (has_class_counts(count)) {
            method.class_counts = parse_class_counts(count);
        } else {
            method.params.stop_count = count.empty() ? 0 : parse_candidates("--count", count);
        }
        method.params.darts =
            options.darts.empty() ? 0 : parse_candidates("--darts", options.darts);
    }
    parse_order(options, method);
    return method;
}

WantedCount parse_wanted_count(const MethodOptions& options, const std::string& count,
                               double pool_ratio) {
    if (options.exact && count.empty()) {
        fail_usage("--exact needs a number of samples; give --count instead of a distance");
    }
    if (count.empty() || options.throws_darts()) {
        return {};
    }
    const double samples =
        options.exact ? parse_candidates("--count", count) : parse_count("--count", count);
    if (samples * pool_ratio > kMaxCandidates) {
        fail_usage("--count: " + in_quotes(count) + " samples need a pool of " +
                   rounded(samples * pool_ratio, 3) + " candidates, the maximum is " +
                   grouped(kMaxCandidates) + "; lower --count" +
                   (pool_ratio > kDefaultPoolRatio ? " or the pool ratio" : ""));
    }
    return {samples, options.exact};
}

void check_one_distance(const MethodOptions& options,
                        const std::vector<std::pair<std::string, std::string>>& given) {
    std::vector<std::string> possible, found;
    for (const auto& [name, value] : given) {
        if (options.throws_darts() && name == "--count") {
            continue;
        }
        possible.push_back(name);
        if (!value.empty()) {
            found.push_back(name);
        }
    }
    if (found.empty()) {
        fail_usage(std::string("no distance given; ") +
                   (options.throws_darts() ? "with --method darts " : "") + "give " +
                   (possible.size() > 1 ? "one of " : "") + listed(possible));
    }
    if (found.size() > 1) {
        fail_usage(listed(found) + " contradict each other; give just one of them");
    }
}

void check_class_counts(const Method& method, std::size_t classes) {
    const std::size_t counts = method.class_counts.size();
    if (counts != 0 && counts != classes) {
        fail_usage(
            "--count has " + std::to_string(counts) + " numbers, one for each class, but " +
            (classes == 0 ? "there are no --classes" : "--classes has " + std::to_string(classes)));
    }
}

void add_exact_option(Command command, MethodOptions& options, const std::string& group) {
    command.add_flag("--exact", options.exact,
                     "Place exactly --count samples: the first N of a run that has\n"
                     "up to 1 % more. Takes 1 to 6 runs, at most 12",
                     group);
}

std::uint32_t parse_keep(const std::string& keep, bool is_farthest) {
    if (keep.empty()) {
        return 0;
    }
    if (!is_farthest) {
        fail_usage("--keep is for --order farthest");
    }
    return parse_candidates("--keep", keep);
}

void add_keep_option(Command command, std::string& keep, const std::string& group) {
    command.add_option("--keep", keep, "K", "Keep only the first K samples of --order farthest",
                       group);
}

void add_order_options(Command command, MethodOptions& options) {
    command
        .add_option("--order", options.order, "NAME",
                    "dart: dart order; progressive: in levels, coarse to fine, each\n"
                    "with half the distance of the one before. Samples up to the end\n"
                    "of a level keep its distance (column level). farthest: after the\n"
                    "first sample, or those of --existing, always the one farthest from\n"
                    "all before it along the surface (column cover: that distance;\n"
                    "column row: place in dart order, from 0)",
                    kMethodGroup)
        .offers({"dart", "progressive", "farthest"})
        .shows_default();
    command.add_option("--levels", options.levels, "K",
                       "Number of levels of --order progressive, 1 to 32 (default: the\n"
                       "first level has at least 16 samples)",
                       kMethodGroup);
    command
        .add_option("--level-factor", options.level_factor, "S",
                    "Distance of a level, divided by that of the next, 1.1 to 8", kMethodGroup)
        .shows_default(exact_text(kLevelFactor));
    add_keep_option(command, options.keep, kMethodGroup);
}

void add_method_options(Command command, MethodOptions& options, const std::string& domain) {
    command
        .add_option("--method", options.method, "NAME",
                    "pool: sample a pool of candidates; darts: throw darts until\n"
                    "there are --count samples or --darts are thrown (aliases\n"
                    "psdp and pdts, as in the paper)",
                    kMethodGroup)
        .offers({"pool", "darts"})
        .shows_default();
    command.add_option("--darts,--throws", options.darts, "K",
                       "Maximum number of darts, up to 4294967295; fewer samples than\n"
                       "--count are then no error (default 1000 per sample that fits\n" +
                           domain + ")",
                       kMethodGroup);
    command
        .add_option("--pool-ratio", options.pool_ratio, "Q",
                    "Candidates in the pool per expected sample, 1 to 10000; more\n"
                    "candidates leave fewer gaps",
                    kMethodGroup)
        .shows_default(exact_text(kDefaultPoolRatio));
    command.add_flag("--dense", options.is_dense,
                     "Fill more gaps: a --pool-ratio of 100, for a packing density rho\n"
                     "of 0.75 instead of 0.72",
                     kMethodGroup);
    command.add_flag("--maximal", options.is_maximal,
                     "Fill all gaps until no sample fits anywhere, and certify it (rho\n"
                     "about 0.78); surfaces with geodesic distances only",
                     kMethodGroup);
}

} // namespace geodisk::tools
