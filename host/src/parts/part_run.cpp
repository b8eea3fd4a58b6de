#include "parts/part_run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/domain/listed.hpp"
#include "parts/surroundings.hpp"
#include "support/free_memory.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// A piece of a part is cut out if the part has at least so many times as many faces.
constexpr std::size_t kMinRatio = 2;

/// Returns some faces of a part; null if that is no gain. Disks around points to avoid may be
/// larger than any other.
std::unique_ptr<Part> cut_out(const Part& part, const Surroundings& around) {
    const bool is_small = around.faces().size() <= part.faces.size() / kMinRatio;
    return is_small && !around.faces().empty() && around.is_complete() && part.avoid.empty()
               ? part.cut_out(around.faces())
               : nullptr;
}

} // namespace

PartRun::PartRun(Exchange& exchange, Part& part, Runner& runner, ProgressCallback progress)
    : exchange_(exchange), part_(part), runner_(runner),
      progress_(std::move(progress)), order_{part.has_keys}, stages_(part.stages()) {
    std::ranges::copy_if(part.settled, std::back_inserter(settled_own_),
                         [&](const DrawnCandidate& dart) { return is_own(dart); });
}

void PartRun::prepare() {
    is_prepared_ = true;
    std::vector<std::uint32_t> near;
    for (std::uint32_t face = 0; face < part_.faces.size(); ++face) {
        if (part_.roles[face] == FaceRole::near) {
            near.push_back(face);
        }
    }
    const Surroundings around(part_, near);
    border_ = cut_out(part_, around);
    from_near_ = border_ ? around.distances_on(*border_) : around.distances();
    if (border_ && part_.of_mesh != nullptr) { // MeshTurn makes its mesh again.
        border_->of_mesh = part_.of_mesh;
        border_->of_radii = part_.of_radii;
        border_->mesh = {};
        border_->radii.reset();
    }
    for (std::size_t i = 0; i < part_.existing.size(); ++i) {
        settle(part_.existing[i], part_.existing_classes.empty() ? 0 : part_.existing_classes[i]);
    }
    for (const DrawnCandidate& dart : part_.settled) {
        settle(dart);
    }
}

void PartRun::settle(const DrawnCandidate& dart) {
    Sample sample = to_sample(dart.point);
    sample.face = part_.local(dart.point.face);
    settle(sample, class_of(dart));
}

void PartRun::settle(const Sample& sample, std::uint8_t number) {
    const auto add = [&](Settled& settled, std::uint32_t face) {
        settled.samples.push_back(sample);
        settled.samples.back().face = face;
        if (!part_.class_factors.empty()) {
            settled.classes.push_back(number);
        }
    };
    add(settled_, sample.face);
    const std::uint32_t face = part_.faces[sample.face];
    if (border().has(face)) {
        add(settled_in_border_, border().local(face));
    }
}

void PartRun::begin(std::uint32_t first_stage, std::uint32_t stages) {
    if (!is_prepared_) {
        prepare();
    }
    for (const Darts* const darts : {&own_, &near_}) {
        for (const DrawnCandidate& dart : *darts) {
            settle(dart);
        }
    }
    settled_own_.insert(settled_own_.end(), own_.begin(), own_.end());
    accepted_.clear();
    own_.clear();
    near_.clear();
    drawn_.clear();
    drawn_near_.clear();
    drawn_in_border_.clear();
    is_decided_ = false;
    if (part_.is_listed) {
        for (const DrawnCandidate& dart : part_.listed) {
            take({&dart, 1}, part_.local(dart.point.face));
        }
        return;
    }
    const CandidateDraw draw = part_.draw();
    Darts of_face;
    for (std::uint32_t face = 0; face < part_.mesh.face_count(); ++face) {
        of_face.clear();
        for (std::uint32_t stage = first_stage;
             part_.roles[face] != FaceRole::surface && stage < first_stage + stages; ++stage) {
            draw.draw(face, stage, of_face);
        }
        for (DrawnCandidate& dart : of_face) {
            dart.point.face = part_.faces[face];
        }
        take(of_face, face);
    }
    for (Darts* const darts : {&drawn_, &drawn_near_, &drawn_in_border_}) {
        darts->shrink_to_fit(); // A process with many parts holds those of all.
        std::ranges::sort(*darts, order_);
    }
}

void PartRun::take(std::span<const DrawnCandidate> darts, std::uint32_t face) {
    const bool is_own = part_.roles[face] == FaceRole::own;
    Darts& drawn = is_own ? drawn_ : drawn_near_;
    drawn.insert(drawn.end(), darts.begin(), darts.end());
    if (is_own && !darts.empty() && border().has(part_.faces[face])) {
        drawn_in_border_.insert(drawn_in_border_.end(), darts.begin(), darts.end());
    }
}

std::uint64_t PartRun::own_up_to(std::uint32_t stage, std::uint32_t priority) const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(drawn_, [&](const DrawnCandidate& dart) {
            return std::pair(dart.stage, dart.priority) <= std::pair(stage, priority);
        }));
}

void PartRun::end_at(std::uint32_t priority) {
    for (Darts* const darts : {&drawn_, &drawn_near_, &drawn_in_border_}) {
        std::erase_if(*darts, [&](const DrawnCandidate& dart) { return dart.priority > priority; });
    }
}

Darts PartRun::samples() const {
    Darts all = settled_own_;
    all.insert(all.end(), own_.begin(), own_.end());
    return all;
}

bool PartRun::is_own(const DrawnCandidate& dart) const {
    return part_.roles[part_.local(dart.point.face)] == FaceRole::own;
}

Result<Darts> PartRun::accepted_of(const Part& part, const Darts& candidates,
                                   const Settled& settled) {
    Darts accepted;
    if (candidates.empty()) {
        return accepted;
    }
    std::vector<ListedCandidate> list;
    std::vector<std::uint8_t> classes;
    list.reserve(candidates.size());
    for (const DrawnCandidate& dart : candidates) {
        list.push_back({part.local(dart.point.face), dart.point.weight1, dart.point.weight2});
        if (!part.class_factors.empty()) {
            classes.push_back(class_of(dart));
        }
    }
    SampleParams params = part.params();
    params.existing = settled.samples;
    params.existing_classes = settled.classes;
    const auto domain = listed_domain(part.mesh, params, part.frame, list, classes);
    GEODISK_TRY(domain);
    std::unique_lock<std::mutex> device = exchange_.device();
    const auto set = runner_.sample_and_wait(*domain, progress_);
    GEODISK_TRY(set);
    device = {};
    report_.starts += set->report.starts;
    report_.add(set->report);
    const auto places = places_of(std::span(set->samples).subspan(set->existing), list);
    GEODISK_TRY(places);
    for (const std::size_t place : *places) {
        accepted.push_back(candidates[place]);
    }
    return accepted;
}

Darts PartRun::merged(const Darts& some, const Darts& others) const {
    Darts all;
    all.reserve(some.size() + others.size());
    std::ranges::merge(some, others, std::back_inserter(all), order_);
    return all;
}

void PartRun::note(Darts accepted) {
    accepted_ = std::move(accepted);
    own_.clear();
    std::ranges::copy_if(accepted_, std::back_inserter(own_),
                         [&](const DrawnCandidate& dart) { return is_own(dart); });
}

Darts PartRun::decided(const Darts& near) {
    near_ = near; // Own samples may have rejected some of them.
    return own_;
}

Result<Darts> PartRun::decide_first() {
    if (is_decided()) {
        return own_;
    }
    auto accepted = accepted_of(part_, merged(drawn_, drawn_near_), settled_);
    GEODISK_TRY(accepted);
    is_decided_ = true;
    ++whole_runs_;
    free_memory(drawn_near_);
    note(std::move(*accepted));
    near_.clear();
    std::ranges::copy_if(accepted_, std::back_inserter(near_),
                         [&](const DrawnCandidate& dart) { return !is_own(dart); });
    return own_;
}

Result<Darts> PartRun::decide_all(const Darts& near) {
    auto accepted = accepted_of(part_, merged(drawn_, near), settled_);
    GEODISK_TRY(accepted);
    ++whole_runs_;
    note(std::move(*accepted));
    return decided(near);
}

// Decisions stay right where no change reaches them. Two near samples that are too close to each
// other never both stay: once one of them changes, the candidates around it are decided anew.
Result<std::optional<Darts>> PartRun::decide_border(const Darts& near) {
    const Part& border = this->border();
    Darts changed;
    std::ranges::set_symmetric_difference(near, near_, std::back_inserter(changed), order_);
    std::vector<std::uint32_t> faces;
    for (const DrawnCandidate& dart : changed) {
        faces.push_back(border.local(dart.point.face));
    }
    const Surroundings around(border, faces, from_near_);
    if (border_ && !around.is_complete()) {
        return std::optional<Darts>();
    }
    Darts candidates, before, beyond;
    for (const Darts* const darts : {&std::as_const(drawn_in_border_), &near}) {
        std::ranges::copy_if(*darts, std::back_inserter(candidates),
                             [&](const DrawnCandidate& dart) { return around.is_within(dart); });
    }
    for (const DrawnCandidate& dart : accepted_) {
        (around.is_reached(dart) ? before : beyond).push_back(dart);
        if (around.is_reached(dart) && !around.is_within(dart)) {
            candidates.push_back(dart);
        }
    }
    std::ranges::sort(candidates, order_);
    const std::unique_ptr<Part> piece = cut_out(border, around);
    const Part& part = piece ? *piece : border;
    const auto accepted = accepted_of(part, candidates, around.settled(settled_in_border_, part));
    GEODISK_TRY(accepted);
    ++border_runs_;
    changed.clear();
    std::ranges::set_symmetric_difference(before, *accepted, std::back_inserter(changed), order_);
    if (std::ranges::any_of(
            changed, [&](const DrawnCandidate& dart) { return around.reaches_others(dart); })) {
        return std::optional<Darts>();
    }
    note(merged(*accepted, beyond));
    return std::optional(decided(near));
}

} // namespace geodisk
