#include "engine/update/region.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/domain/check_frame.hpp"
#include "engine/domain/listed.hpp"
#include "parts/halo.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Candidates conflict up to the distance and its largest guard, see host/docs/precision.md.
constexpr double kReach = 1.05;
// A reach that is not enough grows by at least this.
constexpr double kGrowth = 1.25;
// Part of the distance within which faces of a region are one when faces around it are looked at.
constexpr double kCell = 0.125;
// Width of the first region around the edit, and by how much it grows where changes leave it, in
// reaches. By measurement: changes seldom go farther.
constexpr double kFirstWidth = 3;
constexpr double kFurtherWidth = 2;
// A disk of a sample near the region is whole within this, and where radii vary also the bounds of
// disks (RadiusField::reach_bounds).
constexpr double kDisksWidth = 2;
constexpr double kBoundsWidth = 2.5;

double largest_radius(std::span<const KeepOut> avoided) {
    double largest = 0;
    for (const KeepOut& one : avoided) {
        largest = std::max(largest, one.radius);
    }
    return largest;
}

} // namespace

float largest_factor(const RadiusField& radii, std::uint32_t face) {
    return std::ranges::max(radii.factors().subspan(std::size_t{3} * face, 3));
}

Changes changes_between(const Darts& old, const Darts& now, bool has_keys) {
    const DartOrder before{has_keys};
    Changes changes;
    std::ranges::set_difference(old, now, std::back_inserter(changes.removed), before);
    std::ranges::set_difference(now, old, std::back_inserter(changes.added), before);
    return changes;
}

Region::Region(Runner& runner, const EditedSurface& surface)
    : runner_(runner), surface_(surface),
      margin_(surface.params.radii != nullptr ? halo_margin(surface.frame) : 0),
      reach_(surface.params.radii != nullptr ? reach_of(0, 0) : reach_of(1, 1)),
      faces_(surface.faces, surface.mesh) {
    for (const Sample& sample : surface.params.existing) {
        given_[sample.face].push_back(sample);
    }
}

double Region::reach_of(double factor, double other) const {
    const double distance = surface_.params.min_distance;
    return distance * (kReach / 2 * (factor + other) + margin_);
}

bool Region::raise_reach() {
    const RadiusField* const radii = surface_.params.radii;
    if (radii == nullptr) {
        return false;
    }
    double largest = surface_.old_factor;
    for (const std::uint32_t face : region_.members()) {
        largest = std::max(largest, double{largest_factor(*radii, face)});
    }
    double needed = reach_of(largest, largest);
    const double distance = surface_.params.min_distance;
    faces_.visit_near(region_.members(), reach_of(largest, 1), kCell * distance,
                      [&](std::uint32_t face, double square) {
                          const double reach =
                              reach_of(largest, double{largest_factor(*radii, face)});
                          needed = square < reach * reach ? std::max(needed, reach) : needed;
                      });
    if (needed <= reach_) {
        return false;
    }
    reach_ = std::max(needed, std::min(kGrowth * reach_, reach_of(1, 1)));
    return true;
}

void Region::widen(double reaches, double least) {
    do {
        faces_.reach(goes_on_, {{std::max(reaches * reach_, least), region_}});
    } while (raise_reach());
}

std::vector<KeepOut> Region::avoided_near(std::span<const std::uint32_t> faces) {
    const double largest = largest_radius(surface_.params.avoid);
    std::vector<KeepOut> found;
    if (largest > 0) {
        near_.clear(surface_.faces.face_count());
        faces_.reach(faces, {{kReach * largest, near_}});
        std::ranges::copy_if(surface_.params.avoid, std::back_inserter(found),
                             [this](const KeepOut& one) { return near_.has(one.center.face); });
    }
    return found;
}

Result<MeshPart> Region::prepare_part() {
    const std::uint32_t count = surface_.faces.face_count();
    const bool vary = surface_.params.radii != nullptr;
    ring_.clear(count);
    all_.clear(count);
    faces_.reach(region_.members(),
                 {{reach_, ring_}, {(vary ? kBoundsWidth : kDisksWidth) * reach_, all_}});
    // Disks of points to avoid may be larger.
    avoided_ = avoided_near(region_.members());
    std::vector<std::uint32_t> centers;
    for (const KeepOut& one : avoided_) {
        centers.push_back(one.center.face);
    }
    faces_.reach(centers, {{kReach * largest_radius(avoided_), all_}});
    std::vector<std::uint32_t> members = all_.members();
    std::ranges::sort(members);
    auto part =
        MeshPart::prepare(surface_.mesh, surface_.params, std::move(members), surface_.threads);
    GEODISK_TRY(part);
    GEODISK_TRY(check_frame(surface_.frame, part->mesh(), part->params()));
    return part;
}

std::vector<Region::Entry> Region::list(const MeshPart& part) const {
    const CandidateDraw draw(part.mesh(), part.params(), surface_.frame);
    std::vector<Entry> entries;
    Darts drawn;
    for (std::uint32_t f = 0; f < part.faces().size(); ++f) {
        const std::uint32_t face = part.faces()[f];
        const bool is_inside = region_.has(face);
        drawn.clear();
        if (is_inside) {
            for (std::uint32_t stage = 0; stage < draw.stages().pool_stages(); ++stage) {
                draw.draw(f, stage, drawn);
            }
        } else if (ring_.has(face)) {
            const auto samples = surface_.darts.on_face(face);
            drawn.assign(samples.begin(), samples.end());
        }
        for (DrawnCandidate& dart : drawn) {
            dart.point.face = f;
            entries.push_back({dart, is_inside});
        }
    }
    // The part has its faces in the order of the whole.
    std::ranges::sort(entries, DartOrder{!surface_.params.face_keys.empty()}, &Entry::dart);
    return entries;
}

Result<std::vector<bool>> Region::accept(const MeshPart& part, const std::vector<Entry>& entries,
                                         UpdateReport& report) {
    std::vector<bool> accepted(entries.size(), false);
    if (std::ranges::none_of(entries, &Entry::is_inside)) {
        accepted.assign(entries.size(), true);
        return accepted;
    }
    std::vector<ListedCandidate> points;
    points.reserve(entries.size());
    for (const Entry& entry : entries) {
        points.push_back(entry.dart.point);
    }
    std::vector<Sample> existing;
    for (std::uint32_t f = 0; f < part.faces().size(); ++f) {
        if (const auto own = given_.find(part.faces()[f]); own != given_.end()) {
            for (Sample sample : own->second) {
                sample.face = f;
                existing.push_back(sample);
            }
        }
    }
    // All points are listed, whatever the keys and the mask.
    SampleParams params = part.params();
    params.face_keys = {};
    params.face_mask = {};
    params.existing = existing;
    std::vector<KeepOut> avoided = avoided_;
    for (KeepOut& one : avoided) {
        one.center.face = *part.find(one.center.face);
    }
    params.avoid = avoided;
    const auto domain = listed_domain(part.mesh(), params, surface_.frame, points);
    GEODISK_TRY(domain);
    const auto set = runner_.sample_and_wait(*domain, surface_.progress);
    GEODISK_TRY(set);
    report.run.add(set->report);
    report.run.guard = std::max(report.run.guard, set->report.guard);
    const auto places = places_of(std::span(set->samples).subspan(set->existing), points);
    GEODISK_TRY(places);
    for (const std::size_t place : *places) {
        accepted[place] = true;
    }
    return accepted;
}

Changes Region::compare(const MeshPart& part, const std::vector<Entry>& entries,
                        const std::vector<bool>& accepted) {
    const DartOrder before{!surface_.params.face_keys.empty()};
    Darts old, now;
    for (const std::uint32_t face : region_.members()) {
        const auto samples = surface_.darts.on_face(face);
        old.insert(old.end(), samples.begin(), samples.end());
    }
    std::ranges::sort(old, before);
    goes_on_.clear();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        DrawnCandidate dart = entries[i].dart;
        dart.point.face = part.faces()[dart.point.face];
        if (entries[i].is_inside && accepted[i]) {
            now.push_back(dart);
        } else if (!entries[i].is_inside && !accepted[i]) {
            goes_on_.push_back(dart.point.face);
        }
    }
    Changes changes = changes_between(old, now, !surface_.params.face_keys.empty());
    // A new sample rejects samples outside, which shows above. What one that is gone rejected may
    // be accepted now.
    for (const DrawnCandidate& dart : changes.removed) {
        if (!faces_.stays_in(dart.point.face, reach_, region_)) {
            goes_on_.push_back(dart.point.face);
        }
    }
    return changes;
}

Result<Changes> Region::decide(std::span<const std::uint32_t> sources, double avoided,
                               UpdateReport& report) {
    region_.clear(surface_.faces.face_count());
    goes_on_.assign(sources.begin(), sources.end());
    avoided = std::max(avoided, largest_radius(avoided_near(sources)));
    Changes changes;
    for (bool is_first = true; !goes_on_.empty(); is_first = false) {
        widen(is_first ? kFirstWidth : kFurtherWidth, is_first ? kReach * avoided : 0);
        const auto part = prepare_part();
        GEODISK_TRY(part);
        const std::vector<Entry> entries = list(*part);
        const auto accepted = accept(*part, entries, report);
        GEODISK_TRY(accepted);
        changes = compare(*part, entries, *accepted);
        ++report.rounds;
        report.faces = static_cast<std::uint32_t>(region_.size());
        report.uploaded = part->mesh().face_count();
    }
    return changes;
}

} // namespace geodisk
