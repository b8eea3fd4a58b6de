// NearLights: which samples may be the nearest ones somewhere in a part of a face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/cells/corner_functions.hpp"
#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

/// Accuracy of distances, in units of the frame.
struct Closeness {
    double error; ///< Distances of disks with the radius 1 are at most so far from exact ones.
    double tie;   ///< Distances that differ by less count as equal.
};

/// Keeps lights on a stack: those of a part of a face above those of the larger part it is in.
/// Lengths are in units of the frame.
class NearLights {
  public:
    struct Range {
        std::size_t first, end;
        bool empty() const { return first == end; }
    };
    /// Information that the lights of a part give about its centroid.
    struct View {
        Range lights;          ///< Those that may be the nearest ones in the part.
        bool is_lit;           ///< The centroid is.
        std::uint32_t nearest; ///< Sample, if it is lit; of equally near ones the first.
        double distance;       ///< Distance of that sample.
        double error;          ///< Bound on the error of the distances of all these lights.
    };

    NearLights(const LitFaces& lit, const Closeness& closeness)
        : lit_(lit), closeness_(closeness) {}

    /// Begins again, with all lights of a face.
    Range begin(std::uint32_t face);
    /// Pushes the lights of a range that may be nearest somewhere in the part of the target.
    View look(const FacePart& part, const LitFaces::Target& target, Range lights);
    /// Pops all lights above this range.
    void pop_to(Range lights) { stack_.resize(lights.end); }

    std::span<const std::uint32_t> at(Range lights) const {
        return std::span(stack_).subspan(lights.first, lights.end - lights.first);
    }
    /// Returns a bound on the error of distances, where disks have the radius 1.
    double error() const { return closeness_.error; }
    std::uint32_t sample_of(std::uint32_t light) const { return lit_.record(light).sample_index; }
    /// Returns the nearest sample of a point by lights of its face: the first of those that tie.
    /// Has the sample ~0 if none lights it.
    struct Nearest {
        std::uint32_t sample;
        double distance;
    };
    Nearest nearest_at(const LitFaces::Target& point, std::span<const std::uint32_t> lights) const;
    /// Returns true if all lights of the range are those of one sample.
    bool is_single(Range lights) const;

  private:
    /// Drops lights that one of a few others beats all over the part.
    void drop_beaten(const FacePart& part, const LitFaces::Target& target, double margin,
                     View& view);
    struct Seen {
        std::uint32_t light;
        double distance;
    };
    const LitFaces& lit_;
    Closeness closeness_;
    std::vector<std::uint32_t> stack_;
    std::vector<Seen> seen_;
    std::vector<CornerFunction> functions_;
};

} // namespace geodisk
