#include "files/meshes/line_file.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/file_scope.hpp"
#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Reads OFF whose faces are lines, a record to a line of text.
class OffLines {
  public:
    OffLines(const Path& path, std::string_view text) : path_(path), lines_(text) {}

    SampleFile read() {
        SampleFile file;
        file.has_faces = false;
        next();
        if (!tokens_.empty() && tokens_[0] == "OFF") {
            tokens_.erase(tokens_.begin());
        } else {
            fail("is not the header OFF; of OFF, lines alone are read");
        }
        if (tokens_.empty()) {
            next();
        }
        const std::size_t points = index_at(0), lines = index_at(1);
        for (std::size_t i = 0; i < points; ++i) {
            next();
            SampleRow& row = file.rows.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                row.position[axis] = number_at(axis);
            }
        }
        for (std::size_t i = 0; i < lines; ++i) {
            next();
            if (index_at(0) != 2) {
                fail("has a face of " + std::to_string(index_at(0)) +
                     " corners, so this is a mesh; lines have two");
            }
            file.segments.push_back({vertex_at(1, points), vertex_at(2, points)});
        }
        return file;
    }

  private:
    void next() {
        tokens_.clear();
        for (std::string_view line; tokens_.empty();) {
            if (!lines_.next(line)) {
                fail_input(path_, "the file ends before its last line");
            }
            split_tokens(without_comment(line), tokens_);
        }
    }

    double number_at(std::size_t place) const {
        const auto value = place < tokens_.size() ? parse_real(tokens_[place]) : std::nullopt;
        if (!value || !std::isfinite(*value)) {
            fail("has no number in place " + std::to_string(place + 1));
        }
        return *value;
    }

    std::size_t index_at(std::size_t place) const {
        const auto value =
            place < tokens_.size() ? parse_integer<std::size_t>(tokens_[place]) : std::nullopt;
        if (!value) {
            fail("has no count or index in place " + std::to_string(place + 1));
        }
        return *value;
    }

    std::uint32_t vertex_at(std::size_t place, std::size_t points) const {
        const std::size_t index = index_at(place);
        if (index >= points) {
            fail("names vertex " + std::to_string(index) + ", but there are " +
                 std::to_string(points));
        }
        return static_cast<std::uint32_t>(index);
    }

    [[noreturn]] void fail(const std::string& message) const {
        fail_input(path_, "line " + std::to_string(lines_.number()) + ": " + message);
    }

    const Path& path_;
    TextLines lines_;
    std::vector<std::string_view> tokens_;
};

/// Joins the rows with the same number in the column `line`, in their order.
void join_polylines(SampleFile& file) {
    const auto numbers = file.extra_values(kLineColumn);
    std::map<std::uint32_t, std::uint32_t> last; // Row of each number.
    for (std::uint32_t row = 0; row < numbers.size(); ++row) {
        const auto [known, is_first] = last.try_emplace(numbers[row], row);
        if (!is_first) {
            file.segments.push_back({std::exchange(known->second, row), row});
        }
    }
}

} // namespace

SampleFile read_points_and_lines(const Path& path, const std::string& numbers,
                                 bool allows_outside) {
    const std::string extension = lower_extension(path);
    const bool is_gltf = extension == ".gltf" || extension == ".glb";
    if (extension != ".off" && !is_gltf) {
        SampleFile file = read_samples(path, numbers);
        join_polylines(file);
        return file;
    }
    if (!numbers.empty()) {
        fail_input(path, "has no columns, so none of the name " + numbers);
    }
    return is_gltf ? read_gltf_lines(path, FileScope(path, allows_outside))
                   : OffLines(path, read_text(path)).read();
}

} // namespace geodisk::tools
