// DartSet: accepted candidates of a surface, by dart order and by face.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <geodisk/mesh_view.hpp>
#include <geodisk/params.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>

#include "engine/domain/drawn.hpp"

namespace geodisk {

class DartSet {
  public:
    /// Finds the candidates that samples are, and puts them in dart order. Errors:
    /// `invalid_argument` for one that is no candidate, with its index from `first_index` on.
    static Result<DartSet> find(const MeshView& mesh, const SampleParams& params,
                                const JobFrame& frame, std::span<const Sample> samples,
                                std::size_t first_index, const ThreadOptions& threads);

    const Darts& in_order() const { return in_order_; }
    /// Returns those of a face.
    std::span<const DrawnCandidate> on_face(std::uint32_t face) const;

    /// Removes some, and adds others; both are in dart order.
    void replace(const Darts& removed, const Darts& added, bool has_keys);

  private:
    Darts in_order_;
    std::unordered_map<std::uint32_t, Darts> on_face_;
};

} // namespace geodisk
