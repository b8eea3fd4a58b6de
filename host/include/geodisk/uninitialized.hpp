// Vectors whose new elements are left as memory holds them.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace geodisk {

/// Internal. Lets the threads that fill a large vector be the first to touch its memory, which
/// costs more than most of what is written there.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
    template <class Other>
    struct rebind {
        using other = UninitializedAllocator<Other>;
    };
    UninitializedAllocator() = default;
    template <class Other>
    UninitializedAllocator(const UninitializedAllocator<Other>&) noexcept {}

    template <class Element>
    void construct(Element* element) noexcept {
        ::new (static_cast<void*>(element)) Element;
    }
    template <class Element, class... Arguments>
    void construct(Element* element, Arguments&&... arguments) {
        ::new (static_cast<void*>(element)) Element(std::forward<Arguments>(arguments)...);
    }
};

/// A vector whose resize() leaves new elements of trivial types to be assigned.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace geodisk
