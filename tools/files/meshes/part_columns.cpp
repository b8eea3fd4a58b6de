#include "files/meshes/part_columns.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "geometry/mesh_parts.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

using PartValue = std::optional<std::uint32_t> (*)(const MeshPart& part);

struct PartColumn {
    std::string_view name;
    PartValue value;         ///< Null for the parts that no path joins.
    bool may_lack;           ///< Faces without a value have kNoPart.
    std::string_view source; ///< Option or format that provides it.
};

constexpr std::string_view kGltf = "a glTF file";

constexpr std::array<PartColumn, 6> kPartColumns{{
    {"mesh", [](const MeshPart& part) { return part.mesh; }, false, kGltf},
    {"primitive", [](const MeshPart& part) { return part.primitive; }, false, kGltf},
    {"node", [](const MeshPart& part) { return part.node; }, false, kGltf},
    {"material", [](const MeshPart& part) { return part.material; }, true,
     "a glTF or OBJ file with materials"},
    {"group",
     [](const MeshPart& part) {
         return part.groups.empty() ? std::nullopt : std::optional(part.groups.front());
     },
     true, "an OBJ file with groups"},
    {"part", nullptr, true, ""},
}};

const PartColumn* find_column(std::string_view name) {
    const auto found = std::ranges::find(kPartColumns, name, &PartColumn::name);
    return found == kPartColumns.end() ? nullptr : &*found;
}

bool has_column(const MeshFile& mesh, const PartColumn& column) {
    const auto has_value = [&](const MeshPart& part) { return column.value(part).has_value(); };
    return column.value == nullptr ||
           (column.may_lack ? std::ranges::any_of(mesh.parts, has_value)
                            : !mesh.parts.empty() && std::ranges::all_of(mesh.parts, has_value));
}

} // namespace

std::vector<std::string> part_column_names() {
    std::vector<std::string> names;
    names.reserve(kPartColumns.size());
    for (const PartColumn& column : kPartColumns) {
        names.emplace_back(column.name);
    }
    return names;
}

std::vector<std::string> parse_part_columns(const std::string& text) {
    std::vector<std::string> names;
    for (const std::string& name : parts_of(text)) {
        if (find_column(name) == nullptr) {
            fail_usage("--columns: " + in_quotes(name) + " is none of " +
                       listed(part_column_names()));
        }
        if (std::ranges::find(names, name) != names.end()) {
            fail_usage("--columns: " + name + " is given twice");
        }
        names.push_back(name);
    }
    return names;
}

void check_parts(const std::string& path, const MeshFile& mesh,
                 const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const PartColumn& column = *find_column(name);
        if (!has_column(mesh, column)) {
            fail_input(path, "does not have the " + name +
                                 " of a face, as --columns requests; use " +
                                 std::string(column.source));
        }
    }
}

std::vector<ExtraColumn> part_columns(const MeshFile& mesh, const std::vector<std::string>& names,
                                      std::span<const SampleRow> rows) {
    std::vector<ExtraColumn> columns;
    for (const std::string& name : names) {
        const std::vector<std::uint32_t> of_triangles = part_column_of_triangles(mesh, name);
        ExtraColumn values{name, {}};
        values.values.reserve(rows.size());
        for (const SampleRow& row : rows) {
            values.values.push_back(of_triangles[row.face]);
        }
        columns.push_back(std::move(values));
    }
    return columns;
}

std::vector<std::uint32_t> part_column_of_triangles(const MeshFile& mesh, const std::string& name) {
    const PartValue value = find_column(name)->value;
    if (value == nullptr) {
        return part_of_triangles(mesh.triangles);
    }
    std::vector<std::uint32_t> values(mesh.triangle_count());
    for (std::size_t triangle = 0; triangle < values.size(); ++triangle) {
        values[triangle] = value(mesh.parts[mesh.part_of_triangle[triangle]]).value_or(kNoPart);
    }
    return values;
}

HeaderEntries part_name_entries(const MeshFile& mesh, const std::vector<std::string>& columns) {
    HeaderEntries entries;
    for (const auto& [column, names] : {std::pair{"node", &mesh.part_names.nodes},
                                        {"material", &mesh.part_names.materials},
                                        {"group", &mesh.part_names.groups}}) {
        if (std::ranges::find(columns, column) == columns.end()) {
            continue;
        }
        for (std::size_t i = 0; i < names->size(); ++i) {
            entries.emplace_back(column, std::to_string(i) + ' ' + (*names)[i]);
        }
    }
    return entries;
}

} // namespace geodisk::tools
