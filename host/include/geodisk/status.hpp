// Status, Error and Result<T>: how every geodisk call reports failure. No geodisk function throws,
// prints, aborts or reads the environment. The one exception is misuse of a Result, see
// Result::value().
// Stable.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include <geodisk/export.hpp>

namespace geodisk {

/// Outcome of a call. Zero is success, negative is failure.
enum class Status : std::int32_t {
    ok = 0,
    invalid_argument = -1,    ///< A parameter is out of its documented range.
    mesh_rejected = -2,       ///< The mesh cannot be sampled; `Error::element` names the place.
    device_lacks = -3,        ///< The device lacks a required limit or feature.
    no_device = -4,           ///< No Vulkan loader, driver or device was found.
    workspace_too_small = -5, ///< A buffer is too small; the message names the size that fits.
    out_of_host_memory = -6,
    out_of_device_memory = -7,
    device_lost = -8,
    cancelled = -9,      ///< The progress callback asked to stop.
    internal = -10,      ///< A bug in geodisk or in the driver.
    job_too_large = -11, ///< A buffer of the job exceeds what the device can bind.
    busy = -12,          ///< C API only: another call or a run in progress uses the object.
};

/// Returns the name of a status as spelled above.
GEODISK_API const char* to_string(Status status) noexcept;

/// Marks an Error that does not concern one element.
inline constexpr std::uint64_t kNoElement = ~std::uint64_t{0};

/// A failure.
struct Error {
    Status status = Status::internal;
    std::string message;                ///< One line for a person, no trailing newline.
    std::uint64_t element = kNoElement; ///< Index of the offending vertex or face, if any.
    std::int32_t vk_result = 0;         ///< The VkResult behind the failure, if any.
};

/// Prints to standard error that Result::value() was called on `error`, with its message, or, if
/// null, that Result::error() was called on a value. Then aborts.
[[noreturn]] GEODISK_API void end_misuse(const Error* error) noexcept;

/// Either a value or an Error.
///
/// Call `value()` only if the result holds a value, and `error()` only if it does not. Otherwise
/// the program prints a message and aborts, in every build.
template <class T>
class [[nodiscard]] Result {
  public:
    /// Makes a success.
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    /// Makes a failure.
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    /// Returns true if the result holds a value.
    explicit operator bool() const noexcept { return content_.index() == 0; }
    T& value() & noexcept {
        check_value();
        return *std::get_if<0>(&content_);
    }
    const T& value() const& noexcept {
        check_value();
        return *std::get_if<0>(&content_);
    }
    T&& value() && noexcept {
        check_value();
        return std::move(*std::get_if<0>(&content_));
    }
    T* operator->() noexcept { return &value(); }
    const T* operator->() const noexcept { return &value(); }
    T& operator*() & noexcept { return value(); }
    const T& operator*() const& noexcept { return value(); }
    const Error& error() const& noexcept {
        check_error();
        return *std::get_if<1>(&content_);
    }
    Error&& error() && noexcept {
        check_error();
        return std::move(*std::get_if<1>(&content_));
    }

  private:
    void check_value() const noexcept {
        if (const Error* const held = std::get_if<1>(&content_)) [[unlikely]] {
            end_misuse(held);
        }
    }
    void check_error() const noexcept {
        if (content_.index() == 0) [[unlikely]] {
            end_misuse(nullptr);
        }
    }

    std::variant<T, Error> content_;
};

/// Value of a call that returns only success or failure.
struct Done {};

} // namespace geodisk
