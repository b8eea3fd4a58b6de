#include "allocated_bytes.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local std::uint64_t allocated = 0;

} // namespace

// Of the whole program; the other forms of the operators call these. That of no exceptions does so
// here, as sanitizers bring one that does not, whose memory would reach this operator delete.
void* operator new(std::size_t size) {
    allocated += size;
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

} // namespace geodisk::test
