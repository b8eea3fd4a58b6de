#include "support/runtime_memory.hpp"

#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

// Allocations left before the one that fails.
thread_local std::uint32_t left = kNever;
thread_local bool failed = false;
thread_local std::uint64_t allocated = 0;

} // namespace

// Replaces the operator of the whole program; the other forms of the operators call these. That of
// no exceptions does so here, as sanitizers bring one that does not, whose memory would reach this
// operator delete.
void* operator new(std::size_t size) {
    allocated += size;
    if (left != kNever && left-- == 0) {
        left = kNever;
        failed = true;
        throw std::bad_alloc();
    }
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) {
        return memory;
    }
    throw std::bad_alloc();
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace geodisk::test {

std::uint64_t allocated_bytes() {
    return allocated;
}

FailingNew::FailingNew(std::uint32_t after) {
    failed = false;
    left = after;
}

FailingNew::~FailingNew() {
    left = kNever;
}

bool FailingNew::has_failed() const {
    return failed;
}

} // namespace geodisk::test
