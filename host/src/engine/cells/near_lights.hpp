// NearLights: which samples may be the nearest ones somewhere in a part of a face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

/// Keeps lights on a stack: those of a part of a face above those of the larger part it is in.
/// Lengths are in units of the frame.
class NearLights {
  public:
    struct Range {
        std::size_t first, end;
        bool empty() const { return first == end; }
    };
    /// What the lights of a part tell of its centroid.
    struct View {
        Range lights;          ///< Those that may be the nearest ones in the part.
        bool is_lit;           ///< The centroid is.
        std::uint32_t nearest; ///< Sample, if it is lit; of equally near ones the first.
        double distance;       ///< Of that sample.
    };

    /// Distances may be off by a quarter of `tolerance`.
    NearLights(const LitFaces& lit, double tolerance) : lit_(lit), tolerance_(tolerance) {}

    /// Begins again, with all lights of a face.
    Range begin(std::uint32_t face);
    /// Pushes the lights of a range that may be nearest somewhere in the target.
    View look(const LitFaces::Target& target, Range lights);
    /// Pops all lights above this range.
    void pop_to(Range lights) { stack_.resize(lights.end); }

    std::span<const std::uint32_t> at(Range lights) const {
        return std::span(stack_).subspan(lights.first, lights.end - lights.first);
    }
    std::uint32_t sample_of(std::uint32_t light) const { return lit_.record(light).sample_index; }
    /// Returns true if all lights of the range are those of one sample.
    bool is_single(Range lights) const;

  private:
    struct Seen {
        std::uint32_t light;
        double distance;
    };
    const LitFaces& lit_;
    double tolerance_;
    std::vector<std::uint32_t> stack_;
    std::vector<Seen> seen_;
};

} // namespace geodisk
