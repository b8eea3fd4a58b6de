#include "files/part_columns.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

struct PartColumn {
    std::string_view name;
    std::optional<std::uint32_t> (*value)(const MeshPart& part);
};

constexpr std::array<PartColumn, 3> kPartColumns{{
    {"mesh", [](const MeshPart& part) { return part.mesh; }},
    {"primitive", [](const MeshPart& part) { return part.primitive; }},
    {"node", [](const MeshPart& part) { return part.node; }},
}};

const PartColumn* find_column(std::string_view name) {
    const auto found = std::ranges::find(kPartColumns, name, &PartColumn::name);
    return found == kPartColumns.end() ? nullptr : &*found;
}

std::uint32_t value_of(const MeshFile& mesh, const PartColumn& column, std::size_t triangle) {
    return *column.value(mesh.parts[mesh.part_of_triangle[triangle]]);
}

} // namespace

std::vector<std::string> part_column_names() {
    std::vector<std::string> names;
    for (const PartColumn& column : kPartColumns) {
        names.emplace_back(column.name);
    }
    return names;
}

std::vector<std::string> parse_part_columns(const std::string& text) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        if (find_column(name) == nullptr) {
            fail_usage("--columns: " + in_quotes(name) + " is none of mesh, primitive and node");
        }
        if (std::ranges::find(names, name) != names.end()) {
            fail_usage("--columns: " + name + " is given twice");
        }
        names.push_back(name);
        begin = end + 1;
    }
    return names;
}

void check_parts(const std::string& path, const MeshFile& mesh,
                 const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const PartColumn& column = *find_column(name);
        const bool is_known =
            !mesh.parts.empty() && std::ranges::all_of(mesh.parts, [&](const MeshPart& part) {
                return column.value(part).has_value();
            });
        if (!is_known) {
            fail_input(path, "does not have the " + name +
                                 " of a face, as --columns requests; use a glTF file");
        }
    }
}

std::vector<ExtraColumn> part_columns(const MeshFile& mesh, const std::vector<std::string>& names,
                                      std::span<const SampleRow> rows) {
    std::vector<ExtraColumn> columns;
    for (const std::string& name : names) {
        ExtraColumn values{name, {}};
        values.values.reserve(rows.size());
        for (const SampleRow& row : rows) {
            values.values.push_back(value_of(mesh, *find_column(name), row.face));
        }
        columns.push_back(std::move(values));
    }
    return columns;
}

std::vector<std::uint32_t> part_column_of_triangles(const MeshFile& mesh, const std::string& name) {
    std::vector<std::uint32_t> values(mesh.triangle_count());
    for (std::size_t triangle = 0; triangle < values.size(); ++triangle) {
        values[triangle] = value_of(mesh, *find_column(name), triangle);
    }
    return values;
}

} // namespace geodisk::tools
