// Memory of the C++ runtime that runs out when a test says so.
#pragma once

#include <cstdint>

namespace geodisk::test {

/// Lets the allocation after so many others of this thread fail, once, until it is destroyed.
class FailingNew {
  public:
    explicit FailingNew(std::uint32_t after);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    /// Whether it has failed.
    bool has_failed() const;
};

} // namespace geodisk::test
