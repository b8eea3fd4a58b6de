// UninitializedVector: a vector whose new elements are uninitialized.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace geodisk {

/// Internal. Lets the threads that fill a large vector be the first to touch its memory. The first
/// touch of a page often costs more than the writes to it.
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

/// A vector whose resize() leaves new elements of trivial types uninitialized.
template <class T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

} // namespace geodisk
