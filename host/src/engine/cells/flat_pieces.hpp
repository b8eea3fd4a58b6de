// FlatPieces: the distances of samples in a part of a face that is so small, or so evenly lit, that
// linear functions tell which sample is the nearest where.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/cells/corner_functions.hpp"
#include "engine/cells/lower_parts.hpp"
#include "engine/cells/near_lights.hpp"
#include "engine/maximal/lit_faces.hpp"

namespace geodisk {

class FlatPieces {
  public:
    FlatPieces(const LitFaces& lit, const Closeness& closeness) : lit_(lit), tie_(closeness.tie) {}

    /// Level of detail at which distances are compared.
    enum class Detail : std::uint8_t {
        computed, ///< As they were computed.
        known,    ///< Up to the bound on their error.
    };
    /// Finds the distances of all lights that NearLights::look() found for a part of a face.
    /// Returns false if it is too large, or partly lit.
    bool find(const FacePart& part, const LitFaces::Target& target, const NearLights::View& view,
              std::span<const std::uint32_t> lights, Detail detail);

    // As find() found them. A sample may have several functions.

    std::span<const CornerValues> functions() const { return functions_; }
    std::span<const std::uint32_t> samples() const { return samples_; }
    /// Returns by how much functions may be off from linear ones and by rounding.
    double band() const { return band_; }
    /// Returns the largest difference of functions with which nearest() may still name a sample.
    double wide_band() const { return wide_band_; }
    /// Returns true if distances are so close to linear that areas are exact.
    bool is_exact() const { return is_exact_; }
    /// Returns the sample of each corner: the first of those that are nearest up to ties.
    std::array<std::uint32_t, 3> nearest() const;

  private:
    struct Piece {
        std::uint32_t sample;
        CornerFunction function;
    };
    /// Takes lights of one sample that differ by no more than `same` as one.
    void gather(const CornerFunctions& functions, std::span<const std::uint32_t> lights,
                double same);
    bool drop_beaten(double margin);

    const LitFaces& lit_;
    double tie_;
    std::vector<Piece> pieces_;
    std::vector<CornerValues> functions_;
    std::vector<std::uint32_t> samples_;
    double band_ = 0, wide_band_ = 0;
    bool is_exact_ = false;
};

} // namespace geodisk
