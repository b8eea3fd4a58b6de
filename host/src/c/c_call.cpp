#include "c/c_call.hpp"

#include <limits>

namespace geodisk::c {
namespace {

constexpr std::pair<Status, geodisk_status> kStatuses[] = {
    {Status::ok, GEODISK_OK},
    {Status::invalid_argument, GEODISK_INVALID_ARGUMENT},
    {Status::mesh_rejected, GEODISK_MESH_REJECTED},
    {Status::device_lacks, GEODISK_DEVICE_LACKS},
    {Status::no_device, GEODISK_NO_DEVICE},
    {Status::workspace_too_small, GEODISK_WORKSPACE_TOO_SMALL},
    {Status::out_of_host_memory, GEODISK_OUT_OF_HOST_MEMORY},
    {Status::out_of_device_memory, GEODISK_OUT_OF_DEVICE_MEMORY},
    {Status::device_lost, GEODISK_DEVICE_LOST},
    {Status::cancelled, GEODISK_CANCELLED},
    {Status::internal, GEODISK_INTERNAL},
    {Status::job_too_large, GEODISK_JOB_TOO_LARGE},
    {Status::busy, GEODISK_BUSY},
};
constexpr bool statuses_agree() {
    for (const auto& [status, number] : kStatuses) {
        if (static_cast<std::int32_t>(status) != number) {
            return false;
        }
    }
    return true;
}
static_assert(statuses_agree());
static_assert(GEODISK_NO_ELEMENT == kNoElement);

geodisk_status write(geodisk_error* to, Status status, std::int32_t vk_result,
                     std::uint64_t element, std::string_view message) noexcept {
    const auto number = static_cast<geodisk_status>(status);
    if (to == nullptr || to->struct_size < sizeof(std::size_t)) {
        return number;
    }
    geodisk_error value{};
    value.struct_size = to->struct_size;
    value.status = number;
    value.vk_result = vk_result;
    value.element = element;
    copy_text(message, value.message);
    std::memcpy(to, &value, std::min(to->struct_size, sizeof value));
    return number;
}

} // namespace

Error wrong(std::string message) {
    return Error{Status::invalid_argument, std::move(message)};
}

geodisk_status tell(geodisk_error* error, const Error& failure) noexcept {
    return write(error, failure.status, failure.vk_result, failure.element, failure.message);
}

geodisk_status tell_success(geodisk_error* error) noexcept {
    return write(error, Status::ok, 0, kNoElement, {});
}

void copy_text(std::string_view text, char* to, std::size_t capacity) noexcept {
    std::size_t size = std::min(text.size(), capacity - 1);
    if (size < text.size()) { // Cut before a whole UTF-8 character.
        while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0u) == 0x80u) {
            --size;
        }
    }
    std::copy_n(text.begin(), size, to);
    to[size] = 0;
}

} // namespace geodisk::c
