#include <utility>

#include <geodisk/domain.hpp>

#include "engine/domain/domain_impl.hpp"

namespace geodisk {

Domain::Domain(std::unique_ptr<const Impl> impl) noexcept : impl_(std::move(impl)) {}
Domain::Domain(Domain&&) noexcept = default;
Domain& Domain::operator=(Domain&&) noexcept = default;
Domain::~Domain() = default;

std::span<const std::uint32_t> Domain::first_faces() const noexcept {
    return impl_->first_faces;
}

const Stages& Domain::stages() const noexcept {
    return impl_->stages;
}

std::uint32_t Domain::dimension() const noexcept {
    return impl_->dimension;
}

void Domain::coordinates(const gpu::SampleRec& sample, std::span<double> point) const noexcept {
    impl_->coordinates(sample, point);
}

} // namespace geodisk
