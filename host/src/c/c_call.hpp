// Shared by all C functions: structs of other versions, failures, exceptions.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <geodisk/geodisk.h>
#include <geodisk/status.hpp>

#include "support/guard.hpp"

namespace geodisk::c {

/// Makes an `invalid_argument` error.
Error wrong(std::string message);

/// Writes the failure to `error`, if it is not null. Returns the status.
geodisk_status tell(geodisk_error* error, const Error& failure) noexcept;
geodisk_status tell_success(geodisk_error* error) noexcept;

/// Runs the body of a C function, which returns Result<Done>.
template <class Body>
geodisk_status answer(geodisk_error* error, Body&& body) noexcept {
    const Result<Done> result = guarded(std::forward<Body>(body));
    return result ? tell_success(error) : tell(error, result.error());
}

/// Locks an object that one call at a time may use.
class Hold {
  public:
    explicit Hold(std::atomic<bool>& is_held) noexcept
        : held_(is_held.exchange(true) ? nullptr : &is_held) {}
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() {
        if (held_ != nullptr) {
            *held_ = false;
        }
    }
    explicit operator bool() const noexcept { return held_ != nullptr; }

  private:
    std::atomic<bool>* held_;
};

/// Runs `body()` unless another call uses the object. `what` names it in the error, such as "the
/// sampler".
template <class Body>
Result<Done> hold(std::atomic<bool>& is_held, const char* name, const Body& body) {
    const Hold held(is_held);
    return held ? body() : Error{Status::busy, std::string("another call has ") + name};
}

/// Copies as much as fits, ends it with 0, and never cuts within a UTF-8 character.
void copy_text(std::string_view text, char* to, std::size_t capacity) noexcept;

template <std::size_t kCapacity>
void copy_text(std::string_view text, char (&to)[kCapacity]) noexcept {
    copy_text(text, to, kCapacity);
}

/// Returns true if a struct of some version can have this size, so that no field is cut.
template <class Struct>
bool is_size_of(std::size_t size) noexcept {
    return size >= sizeof(std::size_t) && size % alignof(Struct) == 0;
}

/// Returns the caller's struct as this version has it. Fields that an older version lacks are 0.
/// Fails if a later version sets fields that this one lacks.
template <class Struct>
Result<Struct> taken(const Struct* given, const char* name) {
    if (given == nullptr) {
        return wrong(std::string(name) + " is NULL");
    }
    const std::size_t size = given->struct_size;
    if (!is_size_of<Struct>(size)) {
        return wrong(std::string(name) + "->struct_size is not its size");
    }
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(Struct); i < size; ++i) {
        if (bytes[i] != 0) {
            return wrong(std::string(name) +
                         " asks for a feature that this version of geodisk lacks");
        }
    }
    Struct result{};
    std::memcpy(&result, given, std::min(size, sizeof(Struct)));
    return result;
}

/// Returns the caller's struct, or all 0 for NULL.
template <class Struct>
Result<Struct> taken_if_any(const Struct* given, const char* name) {
    return given != nullptr ? taken(given, name) : Struct{};
}

/// Writes the fields that the caller's version of the struct has.
template <class Struct>
Result<Done> give(Struct* to, const char* name, Struct value) {
    if (to == nullptr) {
        return wrong(std::string(name) + " is NULL");
    }
    const std::size_t size = to->struct_size;
    if (!is_size_of<Struct>(size)) {
        return wrong(std::string(name) + "->struct_size is not its size");
    }
    value.struct_size = size;
    std::memcpy(to, &value, std::min(size, sizeof(Struct)));
    return Done{};
}

/// Returns element i of an array of the caller's structs, with the size of its version.
template <class Struct>
Struct* element_of(Struct* array, std::size_t i) noexcept {
    using Byte = std::conditional_t<std::is_const_v<Struct>, const unsigned char, unsigned char>;
    return reinterpret_cast<Struct*>(reinterpret_cast<Byte*>(array) + i * array->struct_size);
}

} // namespace geodisk::c
