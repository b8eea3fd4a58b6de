// DartSet: accepted candidates of a surface, by dart order and by face.
#pragma once

#include <cstddef>
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

/// A sample, and its number among those that the caller gave.
struct NumberedSample {
    Sample sample;
    std::size_t number;
};

class DartSet {
  public:
    /// Finds the candidates that samples are, and puts them in dart order. All lie in faces of the
    /// mesh. Errors: `invalid_argument` for one that is no candidate, with its number.
    static Result<DartSet> find(const MeshView& mesh, const SampleParams& params,
                                const JobFrame& frame, std::vector<NumberedSample> samples,
                                const ThreadOptions& threads);

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
