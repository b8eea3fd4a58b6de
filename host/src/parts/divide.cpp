// Divides a surface: finds the halo of each part, and who must know whose samples.
#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include <geodisk/params.hpp>

#include "engine/domain/stages.hpp"
#include "engine/request/check_fields.hpp"
#include "parts/halo.hpp"
#include "parts/part.hpp"
#include "parts/reach.hpp"
#include "parts/sample_parts.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

std::uint32_t stages_at_once(const Stages& stages, double max_candidates) {
    const double most = std::max(1.0, max_candidates / stages.expected(0));
    return static_cast<std::uint32_t>(std::min<double>(stages.max_at_once(), most));
}

/// Faces of all parts that are known so far.
class Division {
  public:
    Division(const WholeSurface& whole, const JobFrame& frame,
             std::span<const std::uint32_t> owners, std::uint32_t processes)
        : mesh_(whole.mesh), params_(whole.params), list_(whole.list), owners_(owners),
          is_shared_(whole.is_shared),
          from_(whole.checkpoints != nullptr ? whole.checkpoints->from : nullptr), halo_(mesh_) {
        const CheckpointTerms terms(whole.checkpoints);
        for (std::uint32_t process = 0; process < processes; ++process) {
            Part& part = parts_.emplace_back(part_for(params_, frame, whole.max_candidates, terms));
            if (!list_.empty()) {
                part.is_listed = true;
                part.max_stages = 1;
            }
        }
        for (const KeepOut& avoided : params_.avoid) {
            avoided_ = std::max(avoided_, avoided.radius * (1 + halo_margin(frame)));
        }
        if (params_.radii != nullptr) {
            reaches_ = reaches(mesh_, *params_.radii, params_.min_distance);
        }
    }

    /// Chooses the faces of a part, and notes which of them their owners must tell it of.
    void choose(std::uint32_t process, std::span<const std::uint32_t> own) {
        Part& part = parts_[process];
        const double unit = part.reach;
        double largest = 0;
        for (const std::uint32_t face : own) {
            largest = std::max(largest, bound(face));
        }
        largest = largest > 0 ? largest : 1;
        part.reach = unit * largest;
        const std::vector<std::uint32_t> found =
            halo_.search(own, std::max(unit * widths_for(largest).all, 2 * avoided_));
        const auto widths = [&](std::uint32_t face) {
            return widths_for(std::min(largest, bound(face)));
        };
        const auto is_within = [&](std::uint32_t face) {
            return halo_.nearest_corner(face) <= unit * widths(face).near;
        };
        for (const std::uint32_t face : found) {
            if (halo_.nearest_corner(face) > std::max(unit * widths(face).all, 2 * avoided_)) {
                continue;
            }
            part.faces.push_back(face);
            part.roles.push_back(owners_[face] == process ? FaceRole::own
                                 : is_within(face)        ? FaceRole::near
                                                          : FaceRole::surface);
            if (part.has_keys) {
                part.keys.push_back(params_.face_keys[face]);
            }
            if (!params_.face_mask.empty()) {
                part.mask.push_back(params_.face_mask[face]);
            }
            if (part.roles.back() == FaceRole::near) {
                asked_[{owners_[face], process}].push_back(face);
            }
        }
        for (std::size_t i = 0; i < params_.existing.size(); ++i) {
            Sample sample = params_.existing[i];
            if (is_within(sample.face)) {
                sample.face = part.local(sample.face);
                part.existing.push_back(sample);
                if (!params_.existing_classes.empty()) {
                    part.existing_classes.push_back(params_.existing_classes[i]);
                }
            }
        }
        for (std::uint32_t i = 0; i < list_.size(); ++i) {
            if (is_within(list_[i].face)) {
                part.listed.push_back({0, i, list_[i]});
            }
        }
        if (from_ != nullptr) {
            std::ranges::copy_if(
                from_->samples, std::back_inserter(part.settled),
                [&](const DrawnCandidate& dart) { return is_within(dart.point.face); });
        }
        for (std::size_t i = 0; i < params_.avoid.size(); ++i) {
            KeepOut avoided = params_.avoid[i];
            if (halo_.nearest_corner(avoided.center.face) <= avoided_) {
                avoided.center.face = part.local(avoided.center.face);
                part.avoid.push_back(avoided);
                if (!params_.avoid_classes.empty()) {
                    part.avoid_classes.push_back(params_.avoid_classes[i]);
                }
            }
        }
    }

    /// Links neighbours, once all parts have their faces.
    void link() {
        for (const auto& [pair, faces] : asked_) {
            const auto [owner, other] = pair;
            Neighbour& neighbour = neighbour_of(owner, other);
            for (const std::uint32_t face : faces) {
                neighbour.faces.push_back(parts_[owner].local(face));
            }
            neighbour_of(other, owner); // It sends too, if only nothing.
        }
    }

    /// Returns the message of a part.
    Result<Bytes> message(std::uint32_t process) {
        Part& part = parts_[process];
        if (!is_shared_) {
            auto mesh = mesh_.part(part.faces);
            GEODISK_TRY(mesh);
            part.mesh = std::move(*mesh);
            if (params_.radii != nullptr) {
                part.radii = params_.radii->on_part(part.mesh, part.faces);
            }
        }
        auto bytes = message_of(part);
        part = {}; // Only one is held at a time.
        return bytes;
    }

  private:
    /// Returns how far conflicts may be from a face, in minimum distances.
    double bound(std::uint32_t face) const {
        const auto at = [&](std::uint32_t h) { return reaches_[mesh_.half_edges()[h].origin]; };
        const std::uint32_t h = 3 * face;
        return reaches_.empty() ? 1 : std::max({at(h), at(h + 1), at(h + 2)});
    }
    Neighbour& neighbour_of(std::uint32_t process, std::uint32_t other) {
        auto& all = parts_[process].neighbours;
        const auto at = std::ranges::lower_bound(all, other, {}, &Neighbour::process);
        return at != all.end() && at->process == other ? *at : *all.insert(at, {other, {}});
    }

    const PreparedMesh& mesh_;
    const SampleParams& params_;
    std::span<const ListedCandidate> list_;
    std::span<const std::uint32_t> owners_;
    bool is_shared_;
    std::vector<Part> parts_;
    const Checkpoint* from_;
    HaloSearch halo_;
    double avoided_ = 0;          ///< The largest distance from a point to avoid.
    std::vector<double> reaches_; ///< See reaches(); empty if radii do not vary.
    /// Faces of the first process whose samples the second one must know.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> asked_;
};

} // namespace

Part part_for(const SampleParams& params, const JobFrame& frame, double max_candidates,
              const CheckpointTerms& checkpoints) {
    Part part;
    part.frame = frame;
    part.reach = params.min_distance * (1 + halo_margin(frame));
    part.of_whole = numbers_of(params);
    part.all_existing = static_cast<std::uint32_t>(params.existing.size());
    part.checkpoints = checkpoints;
    part.max_stages = stages_at_once(stages_in(frame, params), max_candidates);
    if (checkpoints.is_saved) {
        part.max_stages = std::min(part.max_stages, checkpoints.stages);
    }
    part.has_keys = !params.face_keys.empty();
    part.class_factors.assign(params.class_factors.begin(), params.class_factors.end());
    return part;
}

Result<std::vector<Bytes>> divide(const WholeSurface& whole, const JobFrame& frame,
                                  std::span<const std::uint32_t> owners, std::uint32_t processes) {
    return guarded([&]() -> Result<std::vector<Bytes>> {
        if (!whole.is_checked) {
            GEODISK_TRY(check_fields(whole.params, RequestField::processes));
        }
        Division division(whole, frame, owners, processes);
        std::vector<std::vector<std::uint32_t>> own(processes);
        for (std::uint32_t face = 0; face < owners.size(); ++face) {
            own[owners[face]].push_back(face);
        }
        for (std::uint32_t process = 0; process < processes; ++process) {
            division.choose(process, own[process]);
        }
        division.link();
        std::vector<Bytes> messages;
        for (std::uint32_t process = 0; process < processes; ++process) {
            auto message = division.message(process);
            GEODISK_TRY(message);
            messages.push_back(std::move(*message));
        }
        return messages;
    });
}

} // namespace geodisk
