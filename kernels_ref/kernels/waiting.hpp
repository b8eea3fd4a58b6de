// Twin of shaders/lib/waiting.glsl: waiting windows and vertex events of a disk.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "constants.h"

namespace geodisk::ref {

/// A window in the frame of the half-edge through which it leaves its face, with the source at (x,
/// y), y >= 0.
template <class Real>
struct Window {
    std::uint32_t edge;
    Real x, y, b0, b1, sigma;
    std::uint32_t chain;
    Real start, end; ///< Known distances of the edge's ends, rounded up.
    /// A half-edge of a face that the window came through, see Detector::turns_back().
    std::uint32_t remembered;
};

/// A vertex reached by a path of length sigma that came in through `corner`, see shadow.hpp.
template <class Real>
struct Event {
    std::uint32_t vertex, corner;
    Real sigma;
    std::uint32_t chain, arrival;
};

/// Waiting work. Windows go first, latest first; events follow when no window is left, nearest or
/// oldest first. Most vertices then have their final distance before their fan is lit. In a disk
/// that trims, both go by distance.
template <class Real>
class Waiting {
  public:
    /// Takes events oldest first, except in disks that trim.
    void take_oldest_first() { oldest_first_ = true; }

    /// Begins a new disk.
    void begin_disk(bool trims) {
        pushed_ = max_ = longest_chain_ = 0;
        begin(trims);
    }

    /// Drops all waiting work.
    void begin(bool trims) {
        trims_ = trims;
        windows_.clear();
        free_places_.clear();
        events_.clear();
        events_taken_ = 0;
    }

    bool trims() const { return trims_; }

    /// Return the windows and events pushed in the disk, the maximum that waited, and their longest
    /// chain.
    std::uint32_t pushed() const { return pushed_; }
    std::uint32_t most() const { return max_; }
    std::uint32_t longest_chain() const { return longest_chain_; }

    void push(const Window<Real>& window, Real distance) {
        if (trims_) {
            // Equally near windows go in the order they came.
            push_row({{gpu::kWindowWaits, pushed_, distance, window.chain, 0}, place_for(window)});
        } else {
            windows_.push_back(window);
            count(windows_.size(), window.chain);
        }
    }

    void push(const Event<Real>& event) { push_row({event, 0}); }

    /// Calls `on_window` or `on_event` with the next one. Returns false if nothing waits.
    template <class OnWindow, class OnEvent>
    bool take(OnWindow&& on_window, OnEvent&& on_event) {
        if (!trims_ && !windows_.empty()) {
            const Window<Real> window = windows_.back();
            windows_.pop_back();
            on_window(window);
            return true;
        }
        if (events_taken_ == events_.size()) {
            return false;
        }
        const Row row = take_row();
        if (row.event.vertex == gpu::kWindowWaits) {
            free_places_.push_back(row.place);
            on_window(Window<Real>{windows_[row.place]});
        } else {
            on_event(row.event);
        }
        return true;
    }

  private:
    /// An event; or with kWindowWaits as vertex, a window with its index in windows_.
    struct Row {
        Event<Real> event;
        std::uint32_t place;
    };
    static bool is_farther(const Row& a, const Row& b) {
        if (a.event.sigma != b.event.sigma) {
            return a.event.sigma > b.event.sigma;
        }
        return std::tie(a.event.vertex, a.event.corner) > std::tie(b.event.vertex, b.event.corner);
    }

    /// Returns true if events are a heap.
    bool by_distance() const { return trims_ || !oldest_first_; }

    void push_row(const Row& row) {
        events_.push_back(row);
        if (by_distance()) {
            std::push_heap(events_.begin(), events_.end(), is_farther);
        }
        count(events_.size() - events_taken_, row.event.chain);
    }

    Row take_row() {
        if (!by_distance()) {
            return events_[events_taken_++];
        }
        std::pop_heap(events_.begin(), events_.end(), is_farther);
        const Row row = events_.back();
        events_.pop_back();
        return row;
    }

    std::uint32_t place_for(const Window<Real>& window) {
        if (free_places_.empty()) {
            windows_.push_back(window);
            return static_cast<std::uint32_t>(windows_.size() - 1);
        }
        const std::uint32_t place = free_places_.back();
        free_places_.pop_back();
        windows_[place] = window;
        return place;
    }

    void count(std::size_t waiting, std::uint32_t chain) {
        ++pushed_;
        max_ = std::max(max_, static_cast<std::uint32_t>(waiting));
        longest_chain_ = std::max(longest_chain_, chain);
    }

    bool trims_ = false;
    bool oldest_first_ = false;
    std::vector<Window<Real>> windows_;      ///< A stack, with gaps in a disk that trims.
    std::vector<std::uint32_t> free_places_; ///< Indices of the gaps.
    std::vector<Row> events_;                ///< A heap, nearest on top; or a queue, oldest first.
    std::size_t events_taken_ = 0;           ///< Number of events taken from the queue.
    std::uint32_t pushed_ = 0, max_ = 0, longest_chain_ = 0;
};

} // namespace geodisk::ref
