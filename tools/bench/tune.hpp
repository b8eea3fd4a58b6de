// Finding out what suits a device.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <geodisk/context.hpp>

#include "bench/options.hpp"
#include "bench/sweep.hpp"

namespace geodisk::bench {

/// A tuning that was measured in turn with the best one so far.
struct Trial {
    std::string setting; ///< Setting that it changes, "pool_block 32".
    double ratio = 0;    ///< Its device time over that of the best, geometric mean over the work.
    bool is_kept = false;
};

/// Changes one setting after the other, from `start` on, as long as the device gets faster by more
/// than measuring errs. Settings that `options` give stay. The work is `options`' counts on
/// `meshes`; all tunings must return the same sets. Throws UserError as measure().
Tuning find_tuning(const Context& context, const Options& options,
                   const std::vector<NamedMesh>& meshes, const Tuning& start,
                   const std::function<void(const Trial&)>& on_trial);

} // namespace geodisk::bench
