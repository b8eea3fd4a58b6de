#include <geodisk/sampler.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/sampler_impl.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

std::string join(const std::vector<std::string>& reasons) {
    std::string text;
    for (const std::string& reason : reasons) {
        text += (text.empty() ? "" : "; ") + reason;
    }
    return text;
}

} // namespace

Sampler::Sampler(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

const DeviceReport& Sampler::report() const noexcept {
    return impl_->report;
}
const Tuning& Sampler::tuning() const noexcept {
    return impl_->choices.tuning;
}

Result<Sampler> Sampler::create(const DeviceRefs& device, const SamplerOptions& options) noexcept {
    return guarded([&]() -> Result<Sampler> {
        auto report =
            query_device(device.get_instance_proc_addr, device.instance, device.physical_device);
        GEODISK_TRY(report);
        if (!report->usable()) {
            return Error{Status::device_lacks,
                         report->name + " cannot run geodisk: " + join(report->reasons_against)};
        }
        const auto tuning = chosen_tuning(options.tuning, *report);
        GEODISK_TRY(tuning);
        const auto table = load_device_table(device);
        GEODISK_TRY(table);
        KernelChoices choices;
        choices.tuning = *tuning;
        choices.native_rounding =
            options.rounding == Rounding::native ||
            (options.rounding == Rounding::automatic && report->rounds_natively);
        choices.counted_lanes =
            options.count_trips ? std::max(report->limits.subgroup_size, 1u) : 0;
        auto impl = std::make_unique<Impl>(device, std::move(*report), *table, choices, options);
        const auto ahead = impl->variant_ahead(options.ahead);
        GEODISK_TRY(impl->pipelines.create(ahead));
        return Sampler(std::move(impl));
    });
}

std::optional<KernelVariant> Sampler::Impl::variant_ahead(Ahead ahead) const {
    if (ahead == Ahead::nothing) {
        return std::nullopt;
    }
    KernelVariant variant;
    variant.adaptive = ahead == Ahead::varying_radii;
    variant.event_heap = events == Events::nearest;
    return variant;
}

KernelVariant Sampler::Impl::variant_for(const Domain& domain) const {
    KernelVariant variant = Domain::Impl::of(domain).kernels;
    if (variant.domain == DomainKind::surface && events != Events::automatic) {
        variant.event_heap = events == Events::nearest;
    }
    return variant;
}

Result<Done> Sampler::prepare(const Domain& domain) const noexcept {
    return guarded([&]() -> Result<Done> {
        const auto pipelines = impl_->pipelines.of(impl_->variant_for(domain));
        return pipelines ? Result<Done>(Done{}) : pipelines.error();
    });
}

std::size_t Sampler::upload_size(const Domain& domain, BufferRole role) const noexcept {
    return Domain::Impl::of(domain).upload_size(role);
}

std::size_t Sampler::mesh_bytes(const Domain& domain, BufferRole role) const noexcept {
    return Domain::Impl::of(domain).mesh_bytes(role);
}

Result<Done> Sampler::write_upload(const Domain& domain, const RunPlan& plan, BufferRole role,
                                   std::span<std::byte> out, std::size_t from) const noexcept {
    return guarded([&]() -> Result<Done> {
        const bool is_whole = from == 0 || from == mesh_bytes(domain, role);
        if (!is_whole || out.empty() || out.data() == nullptr ||
            out.size() != upload_size(domain, role) - from) {
            return Error{Status::invalid_argument,
                         "not a buffer that is uploaded, or not of its size"};
        }
        const auto parts = Domain::Impl::of(domain).upload_parts(plan, role);
        GEODISK_TRY(parts);
        std::size_t at = 0;
        for (const UploadPart& part : *parts) {
            if (at >= from) {
                part.write(0, part.records, out.data() + (at - from));
            }
            at += part.bytes();
        }
        return Done{};
    });
}

} // namespace geodisk
