// Exact geodesic disks over a pool: kernels/detect as a DiskQuery.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baselines/disk_query.hpp"
#include "geodisk/mesh.hpp"
#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

class GeodesicDisks : public DiskQuery {
  public:
    /// Makes a pool on a mesh, which must outlive the object. Distances are compared with
    /// `tolerances.limit` times `min_distance`, which is in mesh units.
    GeodesicDisks(const PreparedMesh& mesh, double min_distance,
                  std::span<const FacePoint<double>> by_rank, const Tolerances& tolerances);
    GeodesicDisks(const GeodesicDisks&) = delete;
    GeodesicDisks& operator=(const GeodesicDisks&) = delete;

    std::uint32_t size() const override { return static_cast<std::uint32_t>(places_.size()); }
    void find(std::uint32_t center, std::span<const std::uint8_t> wanted,
              std::vector<std::uint32_t>& found) override;

  private:
    Surface<double> surface_;
    Bins<double> bins_;
    Detector<double> detector_;
    std::vector<std::uint32_t> places_;   ///< Places in the bins, by rank.
    std::vector<std::uint32_t> found_in_; ///< Last disk that found a candidate, by rank.
    std::uint32_t disk_ = 0;
};

} // namespace geodisk::ref
