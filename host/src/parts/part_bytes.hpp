// Parts of a surface as messages between processes of one program.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "parts/exchange.hpp"
#include "parts/part.hpp"

namespace geodisk {

/// Appends values to a message: each vector behind its size.
class MessageWriter {
  public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* const first = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), first, first + sizeof value);
    }
    template <class T>
    void put_all(const std::vector<T>& values) {
        put(std::uint64_t{values.size()});
        const auto more = std::as_bytes(std::span(values));
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    Bytes take() { return std::move(bytes_); }

  private:
    Bytes bytes_;
};

/// Reads values in the same order. What is not there is zero or empty, and makes it incomplete.
class MessageReader {
  public:
    explicit MessageReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T>
    void get(T& value) {
        if (take(sizeof value)) {
            std::memcpy(&value, taken_.data(), sizeof value);
        }
    }
    template <class T>
    void get_all(std::vector<T>& values) {
        std::uint64_t size = 0;
        get(size);
        if (size <= bytes_.size() / sizeof(T) && take(size * sizeof(T))) {
            values.resize(size);
            if (size > 0) {
                std::memcpy(values.data(), taken_.data(), size * sizeof(T));
            }
        } else {
            is_complete_ = false;
        }
    }
    /// Returns true if all that was read was there, and nothing else.
    bool is_complete() const { return is_complete_ && bytes_.empty(); }

  private:
    bool take(std::size_t size) {
        is_complete_ = is_complete_ && size <= bytes_.size();
        if (is_complete_) {
            taken_ = bytes_.first(size);
            bytes_ = bytes_.subspan(size);
        }
        return is_complete_;
    }

    std::span<const std::byte> bytes_, taken_;
    bool is_complete_ = true;
};

/// Writes a part.
Result<Bytes> message_of(const Part& part);

} // namespace geodisk
