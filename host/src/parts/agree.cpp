#include "parts/agree.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

#include "support/try.hpp"

namespace geodisk {
namespace {

// Counts of processes whose near samples changed, and, above these bits, of those that failed.
constexpr std::uint64_t kFailed = std::uint64_t{1} << 32;

/// Samples that a process and one of its neighbours have sent each other.
class Dialog {
  public:
    Dialog(const Part& part, const Neighbour& neighbour) : order_{part.has_keys} {
        faces_.reserve(neighbour.faces.size());
        for (const std::uint32_t face : neighbour.faces) {
            faces_.push_back(part.faces[face]);
        }
    }

    /// Returns the message that tells the neighbour of all own samples that it must know, by what
    /// changed since the last one.
    Bytes tell(const Darts& own) {
        Darts mine;
        std::ranges::copy_if(own, std::back_inserter(mine), [&](const DrawnCandidate& dart) {
            return std::ranges::binary_search(faces_, dart.point.face);
        });
        Darts removed, added;
        std::ranges::set_difference(told_, mine, std::back_inserter(removed), order_);
        std::ranges::set_difference(mine, told_, std::back_inserter(added), order_);
        told_ = std::move(mine);
        Bytes message;
        if (removed.empty() && added.empty()) {
            return message;
        }
        const std::uint64_t count = removed.size();
        message.resize(sizeof count);
        std::memcpy(message.data(), &count, sizeof count);
        append(message, removed);
        append(message, added);
        return message;
    }

    /// Takes the neighbour's message. Returns true if its samples changed.
    bool hear(std::span<const std::byte> message) {
        if (message.empty()) {
            return false;
        }
        std::uint64_t count = 0;
        std::memcpy(&count, message.data(), sizeof count);
        const Darts darts = darts_of(message.subspan(sizeof count));
        const auto removed = std::span(darts).first(count);
        const auto added = std::span(darts).subspan(count);
        Darts kept, all;
        std::ranges::set_difference(heard_, removed, std::back_inserter(kept), order_);
        std::ranges::merge(kept, added, std::back_inserter(all), order_);
        heard_ = std::move(all);
        return true;
    }

    const Darts& heard() const { return heard_; }

  private:
    DartOrder order_;
    std::vector<std::uint32_t> faces_; ///< Faces that the neighbour must know of, by their numbers.
    Darts told_, heard_;
};

} // namespace

Result<Darts> agree(Exchange& exchange, const Part& part, const Decide& decide,
                    AgreementReport& report) {
    std::vector<std::uint32_t> others;
    std::vector<Dialog> dialogs;
    for (const Neighbour& neighbour : part.neighbours) {
        others.push_back(neighbour.process);
        dialogs.emplace_back(part, neighbour);
    }
    auto own = decide(nullptr);
    for (bool is_first = true;; is_first = false) {
        std::vector<Bytes> messages(others.size());
        for (std::size_t i = 0; i < others.size() && own; ++i) {
            messages[i] = dialogs[i].tell(*own);
            report.bytes += messages[i].size();
        }
        report.messages += others.size();
        ++report.rounds;
        const auto received = exchange.swap(others, messages);
        GEODISK_TRY(received);
        // In the first round near samples become known, if there are any or not.
        bool has_changed = is_first && !others.empty();
        for (std::size_t i = 0; i < others.size(); ++i) {
            has_changed |= dialogs[i].hear((*received)[i]);
        }
        const auto open = exchange.sum(own ? (has_changed ? 1 : 0) : kFailed);
        GEODISK_TRY(open);
        if (*open >= kFailed) {
            return exchange.first_error(own ? nullptr : &own.error());
        }
        if (*open == 0) {
            return own;
        }
        if (has_changed) {
            Darts near;
            for (const Dialog& dialog : dialogs) {
                near.insert(near.end(), dialog.heard().begin(), dialog.heard().end());
            }
            std::ranges::sort(near, DartOrder{part.has_keys});
            own = decide(&near);
        }
    }
}

} // namespace geodisk
