#include "baselines/check_calls.hpp"

#include <algorithm>

#include "constants.h"

namespace geodisk::ref {
namespace {

/// The recursion of one thread after the other, on a stack of its own: chains may be long.
class Thread {
  public:
    explicit Thread(std::span<const std::vector<std::uint32_t>> above)
        : above_(above), states_(above.size(), gpu::kActive) {}

    std::uint32_t check(std::uint32_t candidate) {
        std::uint32_t calls = 1;
        stack_.push_back({candidate, 0});
        while (!stack_.empty()) {
            Frame& frame = stack_.back();
            const std::vector<std::uint32_t>& list = above_[frame.candidate];
            if (frame.next == list.size()) {
                decide(gpu::kAccepted);
                continue;
            }
            const std::uint32_t other = list[frame.next];
            if (!frame.is_back) {
                ++calls;
                frame.is_back = true;
                if (states_[other] == gpu::kActive) {
                    stack_.push_back({other, 0});
                    continue;
                }
            }
            if (states_[other] == gpu::kAccepted) {
                decide(gpu::kRejected);
                continue;
            }
            ++frame.next;
            frame.is_back = false;
        }
        for (const std::uint32_t decided : decided_) {
            states_[decided] = gpu::kActive;
        }
        decided_.clear();
        return calls;
    }

  private:
    struct Frame {
        std::uint32_t candidate;
        std::size_t next;     ///< In its list.
        bool is_back = false; ///< The call for `next` was made.
    };

    void decide(std::uint32_t state) {
        const std::uint32_t candidate = stack_.back().candidate;
        stack_.pop_back();
        states_[candidate] = static_cast<std::uint8_t>(state);
        decided_.push_back(candidate);
    }

    std::span<const std::vector<std::uint32_t>> above_;
    std::vector<std::uint8_t> states_;
    std::vector<std::uint32_t> decided_;
    std::vector<Frame> stack_;
};

} // namespace

std::vector<std::uint32_t> count_check_calls(std::span<const std::vector<std::uint32_t>> above) {
    Thread thread(above);
    std::vector<std::uint32_t> calls(above.size());
    for (std::uint32_t i = 0; i < above.size(); ++i) {
        calls[i] = thread.check(i);
    }
    return calls;
}

void CallHistogram::add(std::span<const std::uint32_t> calls_each) {
    for (const std::uint32_t n : calls_each) {
        ++candidates[std::min<std::size_t>(n, candidates.size()) - 1];
        calls += n;
    }
    total += calls_each.size();
}

} // namespace geodisk::ref
