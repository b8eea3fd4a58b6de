#include "parts/part_run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/domain/listed.hpp"
#include "parts/halo.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Width of the border, in minimum distances: hardly any chain of decisions is longer.
constexpr double kBorder = 6;

} // namespace

PartRun::PartRun(const Part& part, Runner& runner, ProgressCallback progress)
    : part_(part), runner_(runner), progress_(std::move(progress)), order_{part.has_keys},
      draw_(part.draw()), stages_(part.is_listed ? part.list_stages() : draw_.stages()) {
    std::vector<std::uint8_t> is_near(part.faces.size());
    for (std::size_t face = 0; face < is_near.size(); ++face) {
        is_near[face] = part.roles[face] == FaceRole::near ? 1 : 0;
    }
    from_near_ = distances_from(part.mesh, is_near, (kBorder + 2) * part.reach);
    for (std::uint32_t face = 0; face < is_near.size(); ++face) {
        if (nearest_corner(part.mesh, from_near_, face) <= kBorder * part.reach) {
            border_reach_ = std::max(border_reach_, farthest_corner(part.mesh, from_near_, face));
        }
    }
    border_reach_ += part.reach;
    for (std::size_t i = 0; i < part.existing.size(); ++i) {
        settle(part.existing[i], part.existing_classes.empty() ? 0 : part.existing_classes[i]);
    }
    for (const DrawnCandidate& dart : part.settled) {
        settle(dart);
        if (is_own(dart)) {
            settled_own_.push_back(dart);
        }
    }
}

void PartRun::settle(const DrawnCandidate& dart) {
    Sample sample = to_sample(dart.point);
    sample.face = local(dart);
    settle(sample, class_of(dart));
}

void PartRun::settle(const Sample& sample, std::uint8_t number) {
    const bool is_near = nearest_corner(part_.mesh, from_near_, sample.face) <= border_reach_;
    for (Settled* const settled : {&settled_, is_near ? &settled_near_ : nullptr}) {
        if (settled != nullptr) {
            settled->samples.push_back(sample);
        }
        if (settled != nullptr && !part_.class_factors.empty()) {
            settled->classes.push_back(number);
        }
    }
}

void PartRun::begin(std::uint32_t first_stage, std::uint32_t stages) {
    for (const Darts* const darts : {&own_, &near_}) {
        for (const DrawnCandidate& dart : *darts) {
            settle(dart);
        }
    }
    settled_own_.insert(settled_own_.end(), own_.begin(), own_.end());
    own_.clear();
    near_.clear();
    drawn_.clear();
    is_decided_ = false;
    own_count_ = 0;
    if (part_.is_listed) {
        drawn_ = part_.listed;
        count_own();
        return;
    }
    for (std::uint32_t face = 0; face < part_.mesh.face_count(); ++face) {
        if (part_.roles[face] == FaceRole::surface) {
            continue;
        }
        const std::size_t first = drawn_.size();
        for (std::uint32_t stage = first_stage; stage < first_stage + stages; ++stage) {
            draw_.draw(face, stage, drawn_);
        }
        own_count_ += part_.roles[face] == FaceRole::own ? drawn_.size() - first : 0;
        for (std::size_t i = first; i < drawn_.size(); ++i) {
            drawn_[i].point.face = part_.faces[face];
        }
    }
    drawn_.shrink_to_fit(); // A process with many parts holds those of all.
    std::ranges::sort(drawn_, order_);
}

std::uint64_t PartRun::own_up_to(std::uint32_t stage, std::uint32_t priority) const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(drawn_, [&](const DrawnCandidate& dart) {
            return std::pair(dart.stage, dart.priority) <= std::pair(stage, priority) &&
                   is_own(dart);
        }));
}

void PartRun::end_at(std::uint32_t priority) {
    std::erase_if(drawn_, [&](const DrawnCandidate& dart) { return dart.priority > priority; });
    count_own();
}

void PartRun::count_own() {
    own_count_ = static_cast<std::uint64_t>(
        std::ranges::count_if(drawn_, [&](const DrawnCandidate& dart) { return is_own(dart); }));
}

Darts PartRun::samples() const {
    Darts all = settled_own_;
    all.insert(all.end(), own_.begin(), own_.end());
    return all;
}

std::uint32_t PartRun::local(const DrawnCandidate& dart) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(part_.faces, dart.point.face) -
                                      part_.faces.begin());
}

bool PartRun::is_own(const DrawnCandidate& dart) const {
    return part_.roles[local(dart)] == FaceRole::own;
}

Result<Darts> PartRun::accepted_of(const Darts& candidates, const Settled& settled) {
    Darts accepted;
    if (candidates.empty()) {
        return accepted;
    }
    std::vector<ListedCandidate> list;
    std::vector<std::uint8_t> classes;
    list.reserve(candidates.size());
    for (const DrawnCandidate& dart : candidates) {
        list.push_back({local(dart), dart.point.weight1, dart.point.weight2});
        if (!part_.class_factors.empty()) {
            classes.push_back(class_of(dart));
        }
    }
    SampleParams params = part_.params();
    params.existing = settled.samples;
    params.existing_classes = settled.classes;
    const auto domain = listed_domain(part_.mesh, params, part_.frame, list, classes);
    GEODISK_TRY(domain);
    const auto set = runner_.sample_and_wait(*domain, progress_);
    GEODISK_TRY(set);
    report_.starts += set->report.starts;
    report_.add(set->report);
    const auto places = places_of(std::span(set->samples).subspan(set->existing), list);
    GEODISK_TRY(places);
    for (const std::size_t place : *places) {
        accepted.push_back(candidates[place]);
    }
    return accepted;
}

bool PartRun::has_to_decide(const Darts* near) const {
    return own_count_ != 0 && (near == nullptr ? !is_decided_ : *near != near_);
}

Result<Darts> PartRun::decide(const Darts* near) {
    if (!has_to_decide(near)) {
        if (near != nullptr) {
            near_ = *near;
        }
        return own_;
    }
    is_decided_ = true;
    Result<Darts> all = Darts();
    if (near == nullptr) {
        all = accepted_of(drawn_, settled_);
        ++whole_runs_;
        std::erase_if(drawn_, [&](const DrawnCandidate& dart) { return !is_own(dart); });
        drawn_.shrink_to_fit();
    } else {
        auto border = decide_border(*near);
        GEODISK_TRY(border);
        all = *border ? Result<Darts>(std::move(**border)) : decide_all(*near);
    }
    if (!all) {
        return all;
    }
    own_.clear();
    near_.clear();
    for (const DrawnCandidate& dart : *all) {
        (is_own(dart) ? own_ : near_).push_back(dart);
    }
    if (near != nullptr) {
        near_ = *near; // Own samples may reject some.
    }
    return own_;
}

Result<Darts> PartRun::decide_all(const Darts& near) {
    Darts candidates;
    candidates.reserve(drawn_.size() + near.size());
    std::ranges::merge(drawn_, near, std::back_inserter(candidates), order_);
    ++whole_runs_;
    return accepted_of(candidates, settled_);
}

Result<std::optional<Darts>> PartRun::decide_border(const Darts& near) {
    const double width = kBorder * part_.reach;
    const auto is_within = [&](const DrawnCandidate& dart, double distance) {
        return nearest_corner(part_.mesh, from_near_, local(dart)) <= distance;
    };
    Darts own, kept, candidates;
    std::ranges::copy_if(drawn_, std::back_inserter(own),
                         [&](const DrawnCandidate& dart) { return is_within(dart, width); });
    // Samples beyond the border reject candidates in it, and stay as they are.
    std::ranges::copy_if(own_, std::back_inserter(kept), [&](const DrawnCandidate& dart) {
        return !is_within(dart, width) && is_within(dart, border_reach_);
    });
    Darts fixed;
    std::ranges::merge(kept, near, std::back_inserter(fixed), order_);
    std::ranges::merge(own, fixed, std::back_inserter(candidates), order_);
    auto accepted = accepted_of(candidates, settled_near_);
    GEODISK_TRY(accepted);
    ++border_runs_;
    std::erase_if(*accepted, [&](const DrawnCandidate& dart) { return !is_own(dart); });
    Darts before, changed, beyond;
    std::ranges::copy_if(own_, std::back_inserter(before), [&](const DrawnCandidate& dart) {
        return is_within(dart, border_reach_);
    });
    std::ranges::set_symmetric_difference(before, *accepted, std::back_inserter(changed), order_);
    const bool is_far = std::ranges::any_of(changed, [&](const DrawnCandidate& dart) {
        return farthest_corner(part_.mesh, from_near_, local(dart)) > width - part_.reach;
    });
    if (is_far) {
        return std::optional<Darts>();
    }
    std::ranges::copy_if(own_, std::back_inserter(beyond), [&](const DrawnCandidate& dart) {
        return !is_within(dart, border_reach_);
    });
    Darts all;
    std::ranges::merge(*accepted, beyond, std::back_inserter(all), order_);
    return std::optional(std::move(all));
}

} // namespace geodisk
