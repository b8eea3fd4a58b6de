#include "files/meshes/value_fields.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "files/meshes/sidecar_files.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/path.hpp"

namespace geodisk::tools {
namespace {

MeshField field_in(const std::string& file, const std::string& name, std::size_t vertex_count) {
    VertexValues values = read_values(file, vertex_count);
    if (values.values.size() != vertex_count) {
        fail_input(file, "has " + counted(values.values.size(), "value", "values") + " for the " +
                             counted(vertex_count, "vertex", "vertices") + " of the mesh");
    }
    MeshField field = make_field(name, MeshField::Of::vertices);
    field.values = std::move(values.values);
    field.value_names = std::move(values.names);
    field.is_whole = values.is_whole;
    return field;
}

} // namespace

std::optional<std::string> value_file(std::string_view name) {
    const bool is_file = name.starts_with(kValueFile) && name.size() > kValueFile.size();
    return is_file ? std::optional(std::string(name.substr(kValueFile.size()))) : std::nullopt;
}

std::string with_files_at(const std::string& attributes,
                          const std::function<std::string(const std::string&)>& place) {
    std::string result;
    for (std::size_t begin = 0; begin <= attributes.size();) {
        const std::size_t end = std::min(attributes.find(',', begin), attributes.size());
        const std::string name = attributes.substr(begin, end - begin);
        const std::optional<std::string> file = value_file(name);
        result += (begin > 0 ? "," : "") + (file ? std::string(kValueFile) + place(*file) : name);
        begin = end + 1;
    }
    return result;
}

std::vector<std::string> value_files(const WantedFields& wanted) {
    std::vector<std::string> files;
    for (const auto* const list : {&wanted.names, &wanted.numbers}) {
        for (const std::string& name : *list) {
            if (auto file = value_file(name)) {
                files.push_back(std::move(*file));
            }
        }
    }
    return files;
}

WantedFields add_value_files(const WantedFields& wanted, PolygonMesh& polygons) {
    WantedFields result = wanted;
    const std::size_t vertex_count = polygons.vertex_count();
    for (std::string& name : result.names) {
        if (const auto file = value_file(name)) {
            name = Path(*file).filename().string();
            polygons.fields.push_back(field_in(*file, name, vertex_count));
        }
    }
    for (const std::string& name : wanted.numbers) {
        if (const auto file = value_file(name)) {
            polygons.own_columns.push_back(field_in(*file, name, vertex_count));
        }
    }
    return result;
}

} // namespace geodisk::tools
