#include "c/c_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "c/c_call.hpp"
#include "engine/domain/classes.hpp"
#include "engine/domain/domain_impl.hpp"

namespace geodisk::c {
namespace {

/// Numbers of an attribute, at most 8.
using Row = std::array<double, 8>;

/// Computes attributes of the samples on surfaces.
class Places {
  public:
    Places(const DomainState& domain, const SampleSet& set) : domain_(domain), set_(set) {}

    /// Returns the number of the sample's surface.
    std::uint32_t part(std::size_t i) const {
        if (domain_.parts.size() == 1) {
            return 0;
        }
        const auto first = domain_.domain->first_faces();
        const auto after = std::upper_bound(first.begin(), first.end(), set_.samples[i].face);
        return static_cast<std::uint32_t>(after - first.begin() - 1);
    }
    /// Returns the sample's face in that surface.
    std::uint32_t face(std::size_t i) const {
        const std::uint32_t face = set_.samples[i].face;
        return domain_.parts.size() == 1 ? face : face - domain_.domain->first_faces()[part(i)];
    }

    Row position(std::size_t i) const {
        const Mesh& mesh = *domain_.parts[part(i)].mesh;
        Row sum{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const double* const at = vertex(mesh, face(i), corner);
            for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
                sum[axis] += double{set_.samples[i].weights[corner]} * at[axis];
            }
        }
        return sum;
    }

    Row normal(std::size_t i) const {
        const Mesh& mesh = *domain_.parts[part(i)].mesh;
        const double* const a = vertex(mesh, face(i), 0);
        // Normalize the edges first: products of very short or long ones overflow or underflow
        // double.
        const Vector ab = unit(difference(vertex(mesh, face(i), 1), a));
        const Vector ac = unit(difference(vertex(mesh, face(i), 2), a));
        const Vector n = unit({ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                               ab[0] * ac[1] - ab[1] * ac[0]});
        return {n[0], n[1], n[2]};
    }

    Row radius(std::size_t i) const {
        const SampleParams& params = domain_.parts[part(i)].params;
        double factor = 1;
        if (params.radii != nullptr) {
            factor = params.radii->factor_at(face(i), set_.samples[i].weights);
        } else if (!set_.classes.empty()) {
            factor = params.class_factors[(std::size_t{class_count(params)} + 1) * set_.classes[i]];
        }
        return {factor * params.min_distance / 2};
    }

    Row barycentric(std::size_t i) const {
        const auto& weights = set_.samples[i].weights;
        return {weights[0], weights[1], weights[2]};
    }

  private:
    using Vector = std::array<double, 3>;

    static const double* vertex(const Mesh& mesh, std::uint32_t face, std::size_t corner) {
        const std::uint32_t v = mesh.triangles[std::size_t{3} * face + corner];
        return mesh.positions.data() + std::size_t{mesh.dimension} * v;
    }
    static Vector difference(const double* b, const double* a) {
        return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    }
    /// Returns the vector with length 1; 0 if it has no length.
    static Vector unit(const Vector& v) {
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return length > 0 ? Vector{v[0] / length, v[1] / length, v[2] / length} : Vector{};
    }

    const DomainState& domain_;
    const SampleSet& set_;
};

bool is_integer(geodisk_attribute attribute) noexcept {
    return attribute == GEODISK_FACE || attribute == GEODISK_PART || attribute == GEODISK_CLASS ||
           attribute == GEODISK_FEATURE || attribute == GEODISK_LEVEL || attribute == GEODISK_ROW;
}

std::size_t count_of(const geodisk_samples& samples) noexcept {
    return samples.of->is_box() ? samples.set.points.size() / samples.of->domain->dimension()
                                : samples.set.samples.size();
}

/// Returns the dimension that all surfaces have; 0 if they differ.
std::uint32_t dimension_of(const DomainState& domain) noexcept {
    const std::uint32_t first = domain.parts[0].mesh->dimension;
    const bool same = std::ranges::all_of(
        domain.parts, [first](const Part& part) { return part.mesh->dimension == first; });
    return same ? first : 0;
}

std::uint32_t width_of(const geodisk_samples& samples, geodisk_attribute attribute) noexcept {
    const DomainState& domain = *samples.of;
    const RequestedSet& found = samples.found;
    if (domain.is_box()) {
        return attribute == GEODISK_POSITION ? domain.domain->dimension()
               : attribute == GEODISK_RADIUS ? 1
                                             : 0;
    }
    switch (attribute) {
    case GEODISK_FACE:
    case GEODISK_RADIUS:
    case GEODISK_PART:
        return 1;
    case GEODISK_CLASS:
        return domain.parts[0].params.class_factors.empty() ? 0 : 1;
    case GEODISK_FEATURE:
        return found.features.empty() ? 0 : 1;
    case GEODISK_LEVEL:
        return found.levels.count > 0 ? 1 : 0;
    case GEODISK_COVER:
    case GEODISK_ROW:
        return found.farthest ? 1 : 0;
    case GEODISK_BARYCENTRIC:
        return 3;
    case GEODISK_POSITION:
        return dimension_of(domain);
    case GEODISK_NORMAL:
        return dimension_of(domain) == 3 ? 3 : 0;
    default:
        return 0;
    }
}

Row numbers_of(const geodisk_samples& samples, geodisk_attribute attribute, std::size_t i) {
    const DomainState& domain = *samples.of;
    if (domain.is_box()) {
        Row row{};
        if (attribute == GEODISK_RADIUS) {
            row[0] = domain.min_distance / 2;
        } else {
            const std::uint32_t width = domain.domain->dimension();
            std::copy_n(&samples.set.points[i * width], width, row.begin());
        }
        return row;
    }
    const Places places(domain, samples.set);
    switch (attribute) {
    case GEODISK_BARYCENTRIC:
        return places.barycentric(i);
    case GEODISK_POSITION:
        return places.position(i);
    case GEODISK_NORMAL:
        return places.normal(i);
    case GEODISK_COVER:
        return {samples.found.farthest->distances[i]};
    default:
        return places.radius(i);
    }
}

/// The caller's array to write to.
struct Target {
    unsigned char* data;
    std::size_t stride;
};

template <class Number>
void write_numbers(const geodisk_samples& samples, geodisk_attribute attribute, std::uint32_t width,
                   const Target& to) {
    for (std::size_t i = 0; i < count_of(samples); ++i) {
        const Row row = numbers_of(samples, attribute, i);
        for (std::uint32_t k = 0; k < width; ++k) {
            const auto number = static_cast<Number>(row[k]);
            std::memcpy(to.data + i * to.stride + k * sizeof number, &number, sizeof number);
        }
    }
}

std::uint32_t integer_of(const geodisk_samples& samples, const Places& places,
                         geodisk_attribute attribute, std::size_t i) {
    const RequestedSet& found = samples.found;
    switch (attribute) {
    case GEODISK_FACE:
        return places.face(i);
    case GEODISK_PART:
        return places.part(i);
    case GEODISK_FEATURE:
        return static_cast<std::uint32_t>(found.features[i]);
    case GEODISK_LEVEL:
        return static_cast<std::uint32_t>(std::ranges::upper_bound(found.ends, i) -
                                          found.ends.begin());
    case GEODISK_ROW:
        return found.farthest->indices[i];
    default:
        return samples.set.classes[i];
    }
}

void write_integers(const geodisk_samples& samples, geodisk_attribute attribute, const Target& to) {
    const Places places(*samples.of, samples.set);
    for (std::size_t i = 0; i < count_of(samples); ++i) {
        const std::uint32_t number = integer_of(samples, places, attribute, i);
        std::memcpy(to.data + i * to.stride, &number, sizeof number);
    }
}

Result<Done> copy(const geodisk_samples& samples, geodisk_attribute attribute, geodisk_type type,
                  void* data, std::size_t stride, std::size_t capacity) {
    const std::uint32_t width = width_of(samples, attribute);
    if (width == 0) {
        return wrong("these samples have no such attribute");
    }
    const bool fits = is_integer(attribute) ? type == GEODISK_UINT32
                                            : type == GEODISK_FLOAT64 || type == GEODISK_FLOAT32;
    if (!fits) {
        return wrong(is_integer(attribute)
                         ? "this attribute takes GEODISK_UINT32"
                         : "this attribute takes GEODISK_FLOAT64 or GEODISK_FLOAT32");
    }
    const std::size_t bytes = width * (type == GEODISK_FLOAT64 ? sizeof(double) : sizeof(float));
    if (stride != 0 && stride < bytes) {
        return wrong("stride is " + std::to_string(stride) + ", but a sample takes " +
                     std::to_string(bytes) + " bytes");
    }
    if (capacity < count_of(samples)) {
        return wrong("capacity is " + std::to_string(capacity) + ", but there are " +
                     std::to_string(count_of(samples)) + " samples");
    }
    if (data == nullptr && count_of(samples) > 0) {
        return wrong("data is NULL");
    }
    const Target to{static_cast<unsigned char*>(data), stride != 0 ? stride : bytes};
    if (is_integer(attribute)) {
        write_integers(samples, attribute, to);
    } else if (type == GEODISK_FLOAT64) {
        write_numbers<double>(samples, attribute, width, to);
    } else {
        write_numbers<float>(samples, attribute, width, to);
    }
    return Done{};
}

geodisk_report report_of(const geodisk_samples& samples) {
    const RunReport& run = samples.set.report;
    const RequestedSet& found = samples.found;
    geodisk_report report{};
    report.samples = count_of(samples);
    report.candidates = run.candidates;
    report.batches = run.batches;
    report.dispatches = run.dispatches;
    report.disks = run.disks;
    report.windows = run.windows;
    report.device_bytes = run.device_bytes;
    report.min_distance = samples.of->min_distance;
    report.guard = run.guard;
    if (samples.of->parts.size() == 1) {
        const Part& part = samples.of->parts[0];
        report.rho = packing_density(effective_area(part.mesh->prepared, part.params),
                                     report.min_distance, static_cast<double>(report.samples));
    }
    report.compile_seconds = run.seconds.compile;
    report.upload_seconds = run.seconds.upload;
    report.sample_seconds = run.seconds.sample;
    report.readback_seconds = run.seconds.readback;
    const auto& domain = samples.of->domain;
    const std::uint64_t wanted = domain                    ? Domain::Impl::of(*domain).stop_count
                                 : samples.found.tries > 0 ? samples.of->parts[0].params.stop_count
                                                           : 0;
    const std::uint64_t made = report.samples + found.unkept;
    report.missing = static_cast<std::uint32_t>(wanted - std::min(wanted, made));
    report.existing = static_cast<std::uint32_t>(samples.set.existing);
    report.maximal_rounds = run.maximal.rounds;
    report.is_certified = run.maximal.certified ? 1 : 0;
    report.maximal_cells = run.maximal.cells;
    report.largest_gap = run.maximal.largest_gap;
    report.tries = found.tries;
    report.levels = found.levels.count;
    report.level_factor = found.levels.count > 0 ? found.levels.factor : 0;
    report.cut = found.cut;
    report.corners = found.corners;
    report.feature_length = found.feature_length;
    report.lacks_features = found.lacks_features ? 1 : 0;
    report.cover = found.farthest ? found.farthest->cover : 0;
    return report;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

size_t geodisk_samples_count(const geodisk_samples* samples) {
    return samples != nullptr ? count_of(*samples) : 0;
}

uint32_t geodisk_samples_width(const geodisk_samples* samples, geodisk_attribute attribute) {
    return samples != nullptr ? width_of(*samples, attribute) : 0;
}

geodisk_status geodisk_samples_copy(const geodisk_samples* samples, geodisk_attribute attribute,
                                    geodisk_type type, void* data, size_t stride, size_t capacity,
                                    geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        return samples != nullptr ? copy(*samples, attribute, type, data, stride, capacity)
                                  : wrong("samples is NULL");
    });
}

geodisk_status geodisk_samples_report(const geodisk_samples* samples, geodisk_report* report,
                                      geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        return samples != nullptr ? give(report, "report", report_of(*samples))
                                  : wrong("samples is NULL");
    });
}

void geodisk_samples_release(geodisk_samples* samples) {
    delete samples;
}

} // extern "C"
