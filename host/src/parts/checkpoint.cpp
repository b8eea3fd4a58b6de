#include "parts/checkpoint.hpp"

#include <algorithm>

#include "engine/domain/drawn.hpp"
#include "parts/darts.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {

CheckpointTerms::CheckpointTerms(const Checkpoints* checkpoints) {
    if (checkpoints == nullptr) {
        return;
    }
    is_saved = static_cast<bool>(checkpoints->save);
    stages = checkpoints->stages;
    if (const Checkpoint* const from = checkpoints->from; from != nullptr) {
        first_stage = from->first_stage;
        candidates = from->candidates;
        samples = from->samples.size();
    }
}

Result<Done> save_on_first(Exchange& exchange, const Checkpoint& checkpoint,
                           const SaveCheckpoint& save) {
    const auto saved = guarded([&] { return save ? save(checkpoint) : Result<Done>(Done{}); });
    return exchange.check_all(saved ? nullptr : &saved.error());
}

Result<Done> save_stages(Exchange& exchange, const Darts& own, Checkpoint& all, bool has_keys,
                         const SaveCheckpoint& save) {
    Bytes told;
    append(told, own);
    const auto messages = exchange.gather(std::move(told));
    GEODISK_TRY(messages);
    const auto before = static_cast<std::ptrdiff_t>(all.samples.size());
    for (const Bytes& message : *messages) {
        const Darts darts = darts_of(message);
        all.samples.insert(all.samples.end(), darts.begin(), darts.end());
    }
    // Later stages come later in dart order.
    std::sort(all.samples.begin() + before, all.samples.end(), DartOrder{has_keys});
    return save_on_first(exchange, all, save);
}

} // namespace geodisk
