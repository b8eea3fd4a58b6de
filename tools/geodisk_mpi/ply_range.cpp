#include "ply_range.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/meshes/ply_fields.hpp"
#include "files/ply_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kMaxHeader = 1u << 16;
constexpr std::size_t kReadAtOnce = 1u << 22;
// As PreparedMesh::prepare() can number them.
constexpr std::uint64_t kMaxFaces = (std::uint64_t{1} << 30) / 3;
constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 30;

/// Thrown where the file has to be read as a whole.
struct NeedsWhole {
    std::string why;
};

/// Place of a value in a record.
struct ValuePlace {
    std::size_t offset;
    PlyType type;
};

/// Records of one size, one after another.
struct Records {
    std::uint64_t count = 0, offset = 0;
    std::size_t size = 0;
    std::vector<std::pair<std::string, ValuePlace>> scalars; ///< By name, but for those of lists.

    std::uint64_t end() const { return offset + count * size; }
    /// Returns where a property stands, if there is one.
    std::optional<ValuePlace> find(const std::string& name) const {
        std::optional<ValuePlace> place;
        for (const auto& [other, at] : scalars) {
            if (other == name && std::exchange(place, at)) {
                throw NeedsWhole{"a property is declared twice"};
            }
        }
        return place;
    }
};

/// A rule of the mask, and where its value stands.
struct PlacedRule {
    MaskRule rule;
    ValuePlace place;
};

/// Places of vertices and faces in the file.
struct PlyLayout {
    bool is_little_endian = true;
    Records vertices, faces;
    std::array<ValuePlace, 3> coordinates;
    ValuePlace corner_count; ///< Corners follow it.
    PlyType corner_type;
    std::optional<ValuePlace> density; ///< Density of vertices.
    std::vector<PlacedRule> vertex_rules, face_rules;

    double value(const char* record, const ValuePlace& place) const {
        return value_of(place.type, record + place.offset, is_little_endian);
    }
    /// Returns 1 if all rules hold for a record.
    std::uint8_t holds(const char* record, const std::vector<PlacedRule>& rules) const {
        return std::ranges::all_of(
            rules, [&](const PlacedRule& one) { return one.rule.holds(value(record, one.place)); });
    }
};

/// Tells a file from what it becomes when it is written to.
struct FileState {
    std::uint64_t size;
    std::int64_t time;
    std::int64_t is_missing; ///< Not 0 for no file that can be opened.

    bool operator==(const FileState&) const = default;
};

FileState state_of(const Path& path) {
    std::error_code error;
    FileState state{};
    state.is_missing = std::ifstream(path) ? 0 : 1;
    if (state.is_missing != 0) {
        return state;
    }
    state.size = std::filesystem::file_size(path, error);
    state.time = static_cast<std::int64_t>(
        std::filesystem::last_write_time(path, error).time_since_epoch().count());
    return state;
}

PlyFile read_header(const Path& path) {
    std::error_code error;
    std::ifstream file(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path, error) || !file) {
        throw NeedsWhole{"it is no file that can be read in parts"};
    }
    std::string head(kMaxHeader, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    try {
        return PlyFile(path, std::move(head));
    } catch (const UserError&) { // Who reads the whole tells of it.
        throw NeedsWhole{"its header is not that of a PLY file of triangles"};
    }
}

/// Refuses colours: whether numbers of files are from 0 to 255 all of them tell together.
void check_no_colour(const PlyElement& element, const std::string& name) {
    const PlyColours colours(element);
    if (std::ranges::any_of(colours.columns(), [&](std::size_t column) {
            return element.properties[column].name == name;
        })) {
        throw NeedsWhole{"its colours have a unit that the whole file tells"};
    }
}

/// Refuses a density or a mask of colours.
void check_no_colours(const PlyElement& element, const RangeWants& wants) {
    if (wants.density) {
        check_no_colour(element, wants.density->name);
    }
    for (const MaskRule& rule : wants.mask) {
        check_no_colour(element, rule.name);
    }
}

/// Returns the vertices behind `offset`, and notes where coordinates stand.
Records vertex_records(const PlyElement& element, std::uint64_t offset, PlyLayout& layout) {
    Records records{element.count, offset, 0, {}};
    for (const PlyProperty& property : element.properties) {
        if (property.count_type || property.name == "x0") {
            throw NeedsWhole{
                "its vertices have more than numbers, or other coordinates than x y z"};
        }
        records.scalars.emplace_back(property.name, ValuePlace{records.size, property.type});
        records.size += size_of(property.type);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto place = records.find(std::string(1, "xyz"[axis]));
        if (!place) {
            throw NeedsWhole{"its vertices have no coordinates x y z"};
        }
        layout.coordinates[axis] = *place;
    }
    return records;
}

/// Returns the faces behind `offset` if all are triangles, and notes where corners stand.
Records face_records(const PlyElement& element, std::uint64_t offset, PlyLayout& layout) {
    Records records{element.count, offset, 0, {}};
    bool is_found = false;
    for (const PlyProperty& property : element.properties) {
        if (!property.count_type) {
            records.scalars.emplace_back(property.name, ValuePlace{records.size, property.type});
            records.size += size_of(property.type);
            continue;
        }
        if (is_found || (property.name != "vertex_indices" && property.name != "vertex_index")) {
            throw NeedsWhole{"its faces have other lists than that of vertices"};
        }
        is_found = true;
        layout.corner_count = {records.size, *property.count_type};
        layout.corner_type = property.type;
        records.size += size_of(*property.count_type) + 3 * size_of(property.type);
    }
    if (!is_found) {
        throw NeedsWhole{"its faces have no list of vertices"};
    }
    return records;
}

/// Finds the values that a job takes.
void find_wanted(const RangeWants& wants, PlyLayout& layout) {
    if (wants.density) {
        layout.density = layout.vertices.find(wants.density->name);
        if (!layout.density) {
            throw NeedsWhole{"its vertices have no such density"};
        }
    }
    for (const MaskRule& rule : wants.mask) {
        if (const auto axis = rule.axis()) {
            if (*axis >= layout.coordinates.size()) {
                throw NeedsWhole{"its vertices have three coordinates"};
            }
            layout.vertex_rules.push_back({rule, layout.coordinates[*axis]});
            continue;
        }
        const auto of_vertices = layout.vertices.find(rule.name);
        const auto of_faces = layout.faces.find(rule.name);
        if (of_vertices.has_value() == of_faces.has_value()) {
            throw NeedsWhole{"a rule of the mask is of no property, or of two"};
        }
        (of_vertices ? layout.vertex_rules : layout.face_rules)
            .push_back({rule, of_vertices ? *of_vertices : *of_faces});
    }
}

PlyLayout layout_of(const Path& path, std::uint64_t file_size, const RangeWants& wants) {
    const PlyFile file = read_header(path);
    if (!file.is_binary()) {
        throw NeedsWhole{"it is text"};
    }
    if (file.unknown_lines().count > 0) {
        throw NeedsWhole{"its header has unknown lines"};
    }
    PlyLayout layout;
    layout.is_little_endian = file.is_little_endian();
    std::uint64_t offset = file.position();
    bool has_vertices = false, has_faces = false;
    for (const PlyElement& element : file.elements()) {
        check_no_colours(element, wants);
        if (element.name == "vertex" && !std::exchange(has_vertices, true)) {
            layout.vertices = vertex_records(element, offset, layout);
            offset = layout.vertices.end();
        } else if (element.name == "face" && !std::exchange(has_faces, true)) {
            layout.faces = face_records(element, offset, layout);
            offset = layout.faces.end();
        } else {
            throw NeedsWhole{"it has more than vertices and faces"};
        }
        if (element.count > file_size) {
            throw NeedsWhole{"it is not as long as its header says"};
        }
    }
    if (!has_vertices || !has_faces || layout.faces.count == 0) {
        throw NeedsWhole{"it has no vertices or no faces"};
    }
    if (offset != file_size) {
        throw NeedsWhole{"it is not as long as if all its faces were triangles"};
    }
    if (layout.faces.count > kMaxFaces || layout.vertices.count > kMaxVertices) {
        throw NeedsWhole{"it has more faces or vertices than can be numbered"};
    }
    find_wanted(wants, layout);
    return layout;
}

/// Calls `take(record)` for each of some records.
template <class Take>
void for_records(std::ifstream& file, const Records& records, std::uint64_t first,
                 std::uint64_t count, const Take& take) {
    std::vector<char> bytes;
    const std::uint64_t at_once = std::max<std::uint64_t>(1, kReadAtOnce / records.size);
    file.seekg(static_cast<std::streamoff>(records.offset + first * records.size));
    for (std::uint64_t done = 0; done < count; done += at_once) {
        const std::uint64_t some = std::min(at_once, count - done);
        bytes.resize(some * records.size);
        if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
            throw NeedsWhole{"it ends before its last face"};
        }
        for (std::uint64_t i = 0; i < some; ++i) {
            take(bytes.data() + i * records.size);
        }
    }
}

MeshRange read_range(const Path& path, const PlyLayout& layout, const RangeWants& wants,
                     std::uint32_t process, std::uint32_t processes) {
    const bool is_little = layout.is_little_endian;
    std::ifstream file(path, std::ios::binary);
    MeshRange range;
    range.faces = {layout.faces.count, processes};
    range.vertices = {layout.vertices.count, processes};
    range.has_mask = !wants.mask.empty();
    range.needs_borders = wants.has_count;
    if (wants.density) {
        range.radii = wants.density->is_density ? RadiusKind::density : RadiusKind::factor;
    }
    range.positions.reserve(3 * range.vertices.size(process));
    range.values.reserve(layout.density ? range.vertices.size(process) : 0);
    range.vertex_mask.reserve(range.has_mask ? range.vertices.size(process) : 0);
    for_records(file, layout.vertices, range.vertices.first(process), range.vertices.size(process),
                [&](const char* record) {
                    for (const ValuePlace& place : layout.coordinates) {
                        range.positions.push_back(layout.value(record, place));
                    }
                    if (layout.density) {
                        range.values.push_back(layout.value(record, *layout.density));
                    }
                    if (range.has_mask) {
                        range.vertex_mask.push_back(layout.holds(record, layout.vertex_rules));
                    }
                });
    range.triangles.reserve(3 * range.faces.size(process));
    range.face_mask.reserve(range.has_mask ? range.faces.size(process) : 0);
    const ValuePlace& count = layout.corner_count;
    const std::size_t corner_size = size_of(layout.corner_type);
    for_records(file, layout.faces, range.faces.first(process), range.faces.size(process),
                [&](const char* record) {
                    if (layout.value(record, count) != 3) {
                        throw NeedsWhole{"a face is no triangle"};
                    }
                    if (range.has_mask) {
                        range.face_mask.push_back(layout.holds(record, layout.face_rules));
                    }
                    const char* corner = record + count.offset + size_of(count.type);
                    for (int k = 0; k < 3; ++k, corner += corner_size) {
                        const double value = value_of(layout.corner_type, corner, is_little);
                        if (!(value >= 0 && value < static_cast<double>(kMaxVertices)) ||
                            static_cast<std::uint32_t>(value) != value) {
                            throw NeedsWhole{"a face names a vertex that there is not"};
                        }
                        range.triangles.push_back(static_cast<std::uint32_t>(value));
                    }
                });
    return range;
}

/// Returns why the processes cannot read one file together, by its state before and after they
/// read;
/// "" if they can.
std::string fault_of(std::span<const std::array<FileState, 2>> states) {
    const FileState& first = states.front()[0];
    for (std::size_t process = 0; process < states.size(); ++process) {
        const auto& [before, after] = states[process];
        const std::string on_it = " on process " + std::to_string(process);
        if (before.is_missing != 0) {
            return "cannot be opened" + on_it + ": every process reads the file at this path";
        }
        if (before.size != first.size && before == after) {
            return "differs" + on_it + ": " + std::to_string(before.size) + " bytes, but " +
                   std::to_string(first.size) +
                   " on process 0; every process must read the same file";
        }
        if (before != after) {
            return "changed while it was read; sample it when nothing writes to it";
        }
        if (before != first) {
            return "changed while it was read, or is another file" + on_it +
                   " than on process 0; sample one file of all when nothing writes to it";
        }
    }
    return "";
}

/// Returns true if some value of a process is a factor that can be raised to the floor.
bool has_factors(const RangeWants& wants, const MeshRange& range) {
    return wants.density && wants.density->floor &&
           std::ranges::any_of(range.values, [](double g) { return g != 0; });
}

} // namespace

std::uint64_t ply_faces(const Path& path) {
    try {
        return layout_of(path, state_of(path).size, {}).faces.count;
    } catch (const NeedsWhole&) {
        return 0;
    }
}

Result<MeshRange> read_ply_range(Exchange& exchange, const Path& path, const RangeWants& wants) {
    std::optional<Error> needs_whole;
    const FileState before = state_of(path);
    MeshRange range;
    try {
        range = read_range(path, layout_of(path, before.size, wants), wants, exchange.rank(),
                           exchange.size());
    } catch (const NeedsWhole& needs) {
        needs_whole = Error{Status::mesh_rejected, needs.why};
    }
    const std::array states{before, state_of(path)};
    const auto all_states = exchange.all_gather(states);
    if (!all_states) {
        return all_states.error();
    }
    if (const std::string fault = fault_of(*all_states); !fault.empty()) {
        return Error{Status::invalid_argument, fault};
    }
    if (auto well = exchange.check_all(needs_whole ? &*needs_whole : nullptr); !well) {
        return well.error();
    }
    // Unless no factor is above 0, of which reading the whole tells.
    const auto with_factors = exchange.sum(has_factors(wants, range) ? 1 : 0);
    if (!with_factors) {
        return with_factors.error();
    }
    if (*with_factors > 0) {
        for (double& g : range.values) {
            g = g >= 0 ? std::max(g, *wants.density->floor) : g;
        }
    }
    return range;
}

} // namespace geodisk::tools
