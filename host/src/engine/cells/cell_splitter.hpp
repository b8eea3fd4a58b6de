// CellSplitter: splits faces until it is known which sample is the nearest one where.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/cells/flat_pieces.hpp"
#include "engine/cells/grid_points.hpp"
#include "engine/cells/lower_parts.hpp"
#include "engine/cells/near_lights.hpp"

namespace geodisk {

/// A part of the cell of a sample, in units of the frame.
struct CellShare {
    std::uint32_t sample;
    double area;
    double doubt; ///< The area may be off by so much.
};

/// A triangle of the grid whose corners are nearest to three samples. Triangles of the grid that
/// touch, and of which none is provably nearest to one or two samples, are a knot.
struct Meeting {
    std::array<std::uint32_t, 3> samples; ///< Ascending.
    std::uint32_t knot;
    bool turns_back; ///< They turn the other way than the face.
};

/// A point of edges or at a vertex with a triangle of a knot.
struct KnotEnd {
    GridPoint point;
    std::uint32_t knot;
    auto operator<=>(const KnotEnd&) const = default;
};

/// Findings in some faces.
struct FoundCells {
    std::vector<CellShare> shares;
    std::vector<std::array<std::uint32_t, 2>> pairs; ///< Touching cells, the lower first.
    std::uint32_t knots = 0;                         ///< Their number, of these faces.
    std::vector<Meeting> meetings;
    std::vector<KnotEnd> ends; ///< Points where knots continue in other faces.
    double unreached = 0;      ///< Area that no disk reaches.
};

class CellSplitter {
  public:
    CellSplitter(const LitFaces& lit, const GridPoints& grid, const Closeness& closeness,
                 bool has_dual)
        : lit_(lit), grid_(grid), has_dual_(has_dual), near_(lit, closeness),
          flat_(lit, closeness) {}

    /// Finds the cells in a face with area.
    void split(std::uint32_t face, FoundCells& found);
    /// Sums what was found of each sample and each pair.
    static void merge(FoundCells& found);

  private:
    struct State {
        NearLights::Range lights;
        bool is_lit;   ///< The centroid of the part around it is.
        bool has_area; ///< Areas are known already.
    };
    void split(const GapCell& cell, const State& around);
    /// Finds areas and pairs in a part of a sliver.
    void split_sliver(const FacePart& part, double area, NearLights::Range around,
                      std::uint32_t nearest);
    void share_out(double area);
    /// Returns how many samples may be nearest in a cell, up to 3.
    std::uint32_t count_near(bool is_flat, std::span<const std::uint32_t> lights);
    void note_pair();
    /// Notes which samples may be nearest in a part of a sliver.
    void note_near(bool is_flat, std::span<const std::uint32_t> lights);
    void note_meeting(const GapCell& cell, std::span<const std::uint32_t> lights);
    /// Tells apart the knots of the face.
    void tie_knots();
    std::uint32_t nearest_at(const FacePlace& place, std::span<const std::uint32_t> lights) const;
    void give(std::uint32_t sample, double area, double doubt) {
        found_->shares.push_back({sample, area, doubt});
    }

    const LitFaces& lit_;
    const GridPoints& grid_;
    bool has_dual_;
    NearLights near_;
    FlatPieces flat_;
    LowerParts parts_;
    FoundCells* found_ = nullptr;
    std::uint64_t left_ = 0; ///< Cells that may still be split.
    bool meets_ = false;     ///< Three samples may meet in the sliver.
    /// Corners of the grid's triangles in knots, and meetings with their number as the knot.
    std::vector<std::array<GridPoint, 3>> knotted_;
    std::vector<Meeting> meetings_;
};

} // namespace geodisk
