#include "files/samples/map_padding.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <vector>

#include "files/output/block_writer.hpp"

namespace geodisk::tools {
namespace {

constexpr std::int32_t kNoColumn = -1;

/// Returns for each texel the column of the nearest one in its row that has a face, or kNoColumn.
std::vector<std::int32_t> nearest_columns(const SampleMap& map) {
    std::vector<std::int32_t> columns(map.faces.size());
    for_rows(map.height, [&](std::size_t row) {
        const std::uint32_t* const faces = &map.faces[row * map.width];
        std::int32_t* const nearest = &columns[row * map.width];
        const auto width = static_cast<std::int32_t>(map.width);
        std::int32_t last = kNoColumn;
        for (std::int32_t x = 0; x < width; ++x) {
            last = faces[x] == SampleMap::kNoFace ? last : x;
            nearest[x] = last;
        }
        last = kNoColumn;
        for (std::int32_t x = width - 1; x >= 0; --x) {
            last = faces[x] == SampleMap::kNoFace ? last : x;
            if (last != kNoColumn && (nearest[x] == kNoColumn || last - x < x - nearest[x])) {
                nearest[x] = last;
            }
        }
    });
    return columns;
}

/// Rows of one column in which the nearest texels lie: the lower envelope of parabolas, as in A.
/// Meijster, J. Roerdink and W. Hesselink, "A general algorithm for computing distance transforms
/// in linear time" (2000).
class ColumnEnvelope {
  public:
    ColumnEnvelope(const std::vector<std::int32_t>& columns, std::uint32_t width,
                   std::uint32_t height, std::uint32_t column)
        : columns_(columns), width_(width), column_(column) {
        for (std::int64_t row = 0; row < height; ++row) {
            if (nearest_in(row) != kNoColumn) {
                add(row);
            }
        }
    }

    /// Calls `use(row, texel)` for each row from the top with the nearest texel that has a face,
    /// and the square of how far it is.
    template <class Use>
    void for_each(std::uint32_t height, const Use& use) const {
        std::size_t part = 0;
        for (std::int64_t row = 0; row < height && !parts_.empty(); ++row) {
            while (part + 1 < parts_.size() && parts_[part + 1].first <= row) {
                ++part;
            }
            const std::int64_t from = parts_[part].row;
            use(static_cast<std::size_t>(row),
                static_cast<std::size_t>(from * width_ + nearest_in(from)),
                (row - from) * (row - from) + square_in(from));
        }
    }

  private:
    /// A row whose texel is the nearest one from row `first` on.
    struct Part {
        std::int64_t row, first;
    };

    std::int32_t nearest_in(std::int64_t row) const {
        return columns_[static_cast<std::size_t>(row * width_ + column_)];
    }
    std::int64_t square_in(std::int64_t row) const {
        const std::int64_t apart = std::abs(nearest_in(row) - column_);
        return apart * apart;
    }

    /// Adds a row below all others.
    void add(std::int64_t row) {
        while (!parts_.empty()) {
            const std::int64_t above = parts_.back().row;
            // From the first row that is nearer to `row` on.
            const std::int64_t sum = row * row + square_in(row) - above * above - square_in(above);
            const std::int64_t first = sum < 0 ? 0 : sum / (2 * (row - above)) + 1;
            if (first > parts_.back().first) {
                parts_.push_back({row, first});
                return;
            }
            parts_.pop_back();
        }
        parts_.push_back({row, 0});
    }

    const std::vector<std::int32_t>& columns_;
    std::int64_t width_, column_;
    std::vector<Part> parts_;
};

} // namespace

std::uint64_t pad(SampleMap& map, std::uint32_t padding) {
    if (padding == 0) {
        return 0;
    }
    const std::vector<std::int32_t> columns = nearest_columns(map);
    const std::int64_t limit = std::int64_t{padding} * padding;
    std::atomic<std::uint64_t> filled = 0;
    for_rows(map.width, [&](std::size_t column) {
        const ColumnEnvelope nearest(columns, map.width, map.height,
                                     static_cast<std::uint32_t>(column));
        std::uint64_t own = 0;
        nearest.for_each(map.height, [&](std::size_t row, std::size_t from, std::int64_t square) {
            if (square > 0 && square <= limit) {
                const std::size_t texel = row * map.width + column;
                map.samples[texel] = map.samples[from];
                map.distances[texel] = map.distances[from];
                ++own;
            }
        });
        filled += own;
    });
    return filled;
}

} // namespace geodisk::tools
