// Number of candidates of a run and its end: options of the commands that sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <geodisk/levels.hpp>
#include <geodisk/params.hpp>
#include <geodisk/request_rules.hpp>

namespace geodisk::tools {

class Command;

/// Fields, with the options that set them.
class GivenFields {
  public:
    /// Notes that an option, as it was given, sets a field.
    void add(RequestField field, const std::string& option, bool is_set = true);
    /// Throws UserError(usage) for two options whose fields exclude each other.
    void check() const;

  private:
    RequestFields fields_;
    std::array<std::string, kRequestFields> options_;
};

/// Returns true for "darts", and for "pdts", as the paper calls the method.
inline bool names_darts(std::string_view method) {
    return method == "darts" || method == "pdts";
}

/// As given on the command line.
struct MethodOptions {
    std::string method = "pool", pool_ratio, darts;
    bool exact = false;
    bool is_dense = false, is_maximal = false;
    std::string order = "dart", levels, level_factor, keep;

    bool throws_darts() const { return names_darts(method); }
};

/// Adds --method, --darts, --pool-ratio, --dense and --maximal; `options` must outlive the parsing.
/// Samples have room in `domain`: "the surface".
void add_method_options(Command command, MethodOptions& options, const std::string& domain);

/// The options, checked.
struct Method {
    bool throws_darts = false; ///< --method darts.
    bool is_dense = false;
    /// The numbers of the job that these options tell. `stop_count` is the value of --count, if
    /// darts stop at it; `darts` is 0 if not given.
    SampleParams params;
    /// Values of --count, if it has one for each class; else empty.
    std::vector<std::uint32_t> class_counts;
    bool has_levels = false;  ///< --order progressive.
    bool is_farthest = false; ///< --order farthest.
    std::uint32_t keep = 0;   ///< Value of --keep; 0 for all.
    Levels levels{0};         ///< Their factor, and their number if that was given; else 0.

    /// Darts to throw where there is room for so many samples: where a count alone is to stop them,
    /// they end at a number that leaves hardly any gap.
    std::uint32_t darts_for(double samples) const;
    /// Returns by how much the distance for a count is larger than for the default pool.
    double distance_factor() const;
    /// Samples to reckon with where there is room for so many, at least one.
    double expected(double samples) const;
    /// A count asked for, with no number of darts that would do, must be reached: throws
    /// UserError(usage) if there are fewer samples.
    void check_count(std::uint64_t samples, double min_distance, std::uint64_t thrown) const;
    /// Checks in the same way that each class has as many samples as asked for.
    void check_classes(std::span<const std::uint8_t> classes, double min_distance,
                       std::uint64_t thrown) const;
};

/// Returns the samples to keep of a farthest-point order, if there is one; 0 for all. Throws
/// UserError(usage).
std::uint32_t parse_keep(const std::string& keep, bool is_farthest);

/// Adds --keep to what has --order farthest.
void add_keep_option(Command command, std::string& keep, const std::string& group = "Options");

/// Adds --order and those that go with it.
void add_order_options(Command command, MethodOptions& options);

/// Checks that there is a count for each class, if there are such counts. Throws UserError(usage).
void check_class_counts(const Method& method, std::size_t classes);

/// Returns the fields that the options set, with --count.
GivenFields given_fields(const MethodOptions& options, const std::string& count);

/// Throws UserError(usage) for values out of range and options that contradict each other.
Method parse_method(const MethodOptions& options, const std::string& count);

/// A number of samples that chooses the distance.
struct WantedCount {
    double samples = 0; ///< Value of --count; 0 if the distance is given.
    bool is_exact = false;
};

/// Returns what --count asks for, where it chooses the distance, with `pool_ratio` candidates per
/// sample. Throws UserError(usage) for values out of range, and --exact where no count chooses the
/// distance.
WantedCount parse_wanted_count(const MethodOptions& options, const std::string& count,
                               double pool_ratio);

/// Adds --exact, to the group of --count.
void add_exact_option(Command command, MethodOptions& options, const std::string& group);

/// Throws UserError(usage) unless just one of the options in `given`, names and values, tells the
/// distance. --count does so only where darts do not stop at it.
void check_one_distance(const MethodOptions& options,
                        const std::vector<std::pair<std::string, std::string>>& given);

} // namespace geodisk::tools
