// MeshTurn: parts of one process hold their meshes, and use the device, one after another.
#pragma once

#include <mutex>

#include <geodisk/exchange.hpp>

#include "parts/part.hpp"

namespace geodisk {

/// Part::mesh and Part::radii are there while this lives, which must not wait for other parts. A
/// process with one part keeps them from then on, and so does a part without places. Throws
/// std::bad_alloc.
class MeshTurn {
  public:
    MeshTurn(Exchange& exchange, Part& part);
    ~MeshTurn();
    MeshTurn(const MeshTurn&) = delete;
    MeshTurn& operator=(const MeshTurn&) = delete;

  private:
    std::unique_lock<std::mutex> turn_;
    Part& part_;
};

} // namespace geodisk
