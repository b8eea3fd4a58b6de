// The windows that wait at a half-edge.
#pragma once

#include <span>
#include <vector>

#include "geodesics/window.hpp"

namespace geodisk::geodesics {

/// Windows by where they begin, hardly any of which overlap.
using WindowList = std::vector<Window>;

/// Merges lists of windows of one half-edge, and trims those that overlap. Keeps its working
/// memory.
class ListMerger {
  public:
    /// Adds `fresh` to `list`.
    void merge(WindowList& list, std::span<const Window> fresh);

  private:
    void add(WindowList& list, std::size_t next);

    WindowList all_;
};

} // namespace geodisk::geodesics
