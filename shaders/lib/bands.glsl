// What waits where the disk trims its windows: windows and events together, in bands by distance. Of the
// nearest band the last one is taken first. That is nearly the order of a heap, in which windows meet
// those that trim them, and takes no loop. Each band is a list of places, linked: a window by the second
// word of its event's row, which is (kWindowWaits, next place), an event by the first one of its window.
#ifndef GEODISK_BANDS_GLSL
#define GEODISK_BANDS_GLSL

layout(constant_id = kSpecTrims) const bool kTrims = false;

bool trims() { return kTrims && lane.trims != 0u; }

// Rows of what lies behind the vertex table.
uint trim_rows() { return kTrims ? kKeptRows * kKeptPerEdge * kKeptEdges + kBandRows : 0u; }

uint first_word(uint place) { return own_row_at(pool, own_row(window_at(place))).x; }

// A free place for a window; the capacity if there is none.
uint place_to_wait() {
    bool again = trims() && lane.free_place != kNothingWaits;
    uint place = again ? lane.free_place : lane.windows;
    if (again) {
        lane.free_place = first_word(place);
    } else if (place < P.window_capacity) {
        ++lane.windows;
    }
    return place;
}

void free_place(uint place) {
    pool[own_row(window_at(place))].x = lane.free_place;
    lane.free_place = place;
}

uint band_row(uint band) { return own_row(first_band + (band >> 2)); }

uint band_bits(uint band) { return band < 32u ? lane.bands_low : lane.bands_high; }

void set_band_bits(uint band, uint bits) {
    lane.bands_low = band < 32u ? bits : lane.bands_low;
    lane.bands_high = band < 32u ? lane.bands_high : bits;
}

// Puts the place first in its band; returns which was.
uint band_place(float distance, uint place) {
    precise float bands = distance * float(kBandsPerDistance);
    uint band = min(uint(bands), kBands - 1u);
    uint bit = 1u << (band & 31u);
    uint row = band_row(band);
    bool has_some = (band_bits(band) & bit) != 0u;
    uint next = has_some ? own_row_at(pool, row)[band & 3u] : kNothingWaits;
    pool[row][band & 3u] = place;
    set_band_bits(band, band_bits(band) | bit);
    ++lane.event_tail;
    lane.most_waiting = max(lane.most_waiting, lane.event_tail);
    return next;
}

void band_window(float distance, uint place) {
    pool[event_row(place)] = uvec4(kWindowWaits, band_place(distance, place), 0u, 0u);
}

void band_event(uvec4 row) {
    uint place = place_to_wait();
    if (place >= P.window_capacity) {
        overflow |= kOverflowWindows;
        return;
    }
    ++lane.pushed;
    pool[own_row(window_at(place))].x = band_place(uintBitsToFloat(row.y), place);
    pool[event_row(place)] = row;
}

// The place that comes next; something waits.
uint take_place() {
    uint band = lane.bands_low != 0u ? uint(findLSB(lane.bands_low))
                                     : 32u + uint(findLSB(lane.bands_high));
    uint row = band_row(band);
    uint place = own_row_at(pool, row)[band & 3u];
    uvec4 waits = own_row_at(pool, event_row(place));
    uint next = waits.x == kWindowWaits ? waits.y : first_word(place);
    pool[row][band & 3u] = next;
    if (next == kNothingWaits) {
        set_band_bits(band, band_bits(band) & ~(1u << (band & 31u)));
    }
    --lane.event_tail;
    return place;
}

#endif
