#include "engine/run/mesh_parts.hpp"

#include <utility>

#include "engine/domain/domain_impl.hpp"
#include "engine/run/first_parts.hpp"
#include "parts/halo.hpp"

namespace geodisk {
namespace {

// Parts may be divided further, up to so many times as many.
constexpr std::uint32_t kMaxGrowth = 4;

} // namespace

Result<NearPart> MeshParts::near(std::uint32_t part, double reach) const {
    return near_part(mesh_, owners_, part, reach * (1 + halo_margin(frame_)));
}

void MeshParts::note_failed(const Runner::Impl& runner, const Domain& domain, double reach) {
    count_that_helps_ =
        count_ == 0 ? first_parts(runner, Domain::Impl::of(domain), mesh_, reach) : 2 * count_;
}

bool MeshParts::divide(const Error& error) {
    const std::uint32_t count = std::exchange(count_that_helps_, 0);
    if (count == 0 || !is_too_large(error) || count > mesh_.face_count()) {
        return false;
    }
    max_count_ = count_ == 0 ? kMaxGrowth * count : max_count_;
    if (count > max_count_) {
        return false;
    }
    count_ = count;
    owners_ = equal_parts(mesh_, count);
    return true;
}

} // namespace geodisk
