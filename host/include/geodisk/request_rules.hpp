// RequestRule: which fields of a request exclude each other, for all front ends.
// Stable.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/export.hpp>

namespace geodisk {

struct SampleParams;
struct SampleRequest;

/// Parts of a request, and those who serve it.
enum class RequestField : std::uint8_t {
    min_distance,
    count,
    is_exact,
    darts,
    stop_count,
    maximal,
    radii,
    density, ///< Radii that are made from a density.
    class_factors,
    class_counts,
    face_keys,
    existing,
    avoid,
    features,
    progressive, ///< SampleOrder::progressive.
    farthest,    ///< SampleOrder::farthest.
    keep,
    metric,
    frame,
    split_from,
    at_vertices,
    update,    ///< Samples that follow an edit of their mesh (Updater).
    processes, ///< Several processes that divide a surface.
    frames,    ///< Frames of an engine, into which a run is recorded (FrameSampler).
};

/// Number of fields.
inline constexpr std::uint32_t kRequestFields = 24;

/// Returns the name of a field as spelled above.
GEODISK_API const char* to_string(RequestField field) noexcept;

/// Fields that are set.
class RequestFields {
  public:
    constexpr RequestFields() noexcept = default;
    /// Adds a field, if it is set.
    constexpr void add(RequestField field, bool is_set = true) noexcept {
        bits_ |= std::uint32_t{is_set} << static_cast<unsigned>(field);
    }
    /// Returns true if the field is set.
    constexpr bool has(RequestField field) const noexcept {
        return (bits_ >> static_cast<unsigned>(field) & 1) != 0;
    }

  private:
    std::uint32_t bits_ = 0;
};

/// Returns the fields that parameters set.
GEODISK_API RequestFields fields_of(const SampleParams& params) noexcept;
/// Returns the fields that a request sets.
GEODISK_API RequestFields fields_of(const SampleRequest& request) noexcept;

/// Two fields that exclude each other.
struct RequestRule {
    RequestField field, other;
    const char* reason; ///< A sentence without a full stop.
};

/// Returns all rules.
GEODISK_API std::span<const RequestRule> request_rules() noexcept;

/// Returns the first rule that forbids two of these fields together, or null. Front ends name both
/// as their users spell them.
GEODISK_API const RequestRule* broken_rule(RequestFields fields) noexcept;

} // namespace geodisk
