// Memory of the C++ runtime, which a test counts or lets run out. Programs with it replace operator
// new.
#pragma once

#include <cstdint>

namespace geodisk::test {

/// Returns the bytes that this thread has allocated so far, freed ones among them.
std::uint64_t allocated_bytes();

/// Lets the allocation after so many others of this thread fail, once, until it is destroyed.
class FailingNew {
  public:
    explicit FailingNew(std::uint32_t after);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    /// Returns true if it has failed.
    bool has_failed() const;
};

} // namespace geodisk::test
