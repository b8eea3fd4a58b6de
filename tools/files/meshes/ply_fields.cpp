#include "files/meshes/ply_fields.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

namespace geodisk::tools {
namespace {

using ColumnNames = std::initializer_list<const char*>;

bool is_whole(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

constexpr double kMaxByte = std::numeric_limits<std::uint8_t>::max(),
                 kMaxShort = std::numeric_limits<std::uint16_t>::max();

/// Returns the columns of these names, or none if one is not there.
std::vector<std::size_t> find_columns(const PlyElement& element, ColumnNames names) {
    std::vector<std::size_t> columns;
    for (const char* const name : names) {
        const std::optional<std::size_t> column = element.find_scalar(name);
        if (!column) {
            return {};
        }
        columns.push_back(*column);
    }
    return columns;
}

/// Returns the columns of the first of these sets of names that are there.
std::vector<std::size_t> find_first(const PlyElement& element,
                                    std::initializer_list<ColumnNames> sets) {
    for (const ColumnNames& names : sets) {
        if (std::vector<std::size_t> columns = find_columns(element, names); !columns.empty()) {
            return columns;
        }
    }
    return {};
}

} // namespace

std::vector<std::size_t> find_uv_columns(const PlyElement& element) {
    return find_first(element, {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}});
}

PlyColours::PlyColours(const PlyElement& element)
    : columns_(find_first(element, {{"red", "green", "blue", "alpha"},
                                    {"red", "green", "blue"},
                                    {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                    {"r", "g", "b"}})) {
    if (!columns_.empty()) {
        const PlyType type = element.properties[columns_[0]].type;
        scale_ = type == PlyType::uint16 ? kMaxShort : kMaxByte;
        is_scaled_ = is_whole(type);
    }
}

void PlyColours::add(const PlyRecord& record) {
    for (const std::size_t column : columns_) {
        is_scaled_ = is_scaled_ || record.scalars[column] > 1;
    }
}

void PlyColours::scale(std::size_t column, std::vector<double>& values) const {
    if (is_scaled_ && std::ranges::find(columns_, column) != columns_.end()) {
        for (double& value : values) {
            value /= scale_;
        }
    }
}

PlyFieldReader::PlyFieldReader(const PlyFile& file, const PlyElement& element,
                               const WantedFields& wanted, PolygonMesh& mesh)
    : file_(file), element_(element), wanted_(wanted), mesh_(mesh),
      of_faces_(element.name == "face"), colours_(element) {
    if (wanted.are_given() || wanted.normals) {
        find();
    }
}

void PlyFieldReader::find() {
    std::vector<bool> used(element_.properties.size(), false);
    const auto use = [&](const std::vector<std::size_t>& columns) {
        for (const std::size_t column : columns) {
            used[column] = true;
        }
        return columns;
    };
    const MeshField::Of of = of_faces_ ? MeshField::Of::faces : MeshField::Of::vertices;
    if (!of_faces_) {
        for (const char* const name :
             {"x", "y", "z", "x0", "x1", "x2", "x3", "x4", "x5", "x6", "x7"}) {
            use(find_columns(element_, {name}));
        }
        normals_ = use(find_columns(element_, {"nx", "ny", "nz"}));
    }
    if (wanted_.normals && !normals_.empty()) {
        mesh_.normals = make_field("normal", of, 3);
    }
    if (const auto colours = use(colours_.columns()); !colours.empty()) {
        list(make_colours(of, colours.size(), prefix_for(kColourField)), colours);
    }
    find_uvs(used);
    for (std::size_t i = 0; i < used.size(); ++i) {
        const PlyProperty& property = element_.properties[i];
        if (!used[i] && !property.count_type) {
            MeshField field = make_field(prefix_for(property.name) + property.name, of);
            field.is_whole = is_whole(property.type);
            list(std::move(field), {i});
        }
    }
    find_own();
}

/// Finds numbers by the names of columns that attributes have others for.
void PlyFieldReader::find_own() {
    for (const std::string& name : wanted_.numbers) {
        const std::optional<std::size_t> column = element_.find_scalar(name);
        if (column && !lists_name(mesh_, name)) {
            columns_.push_back({&PolygonMesh::own_columns, mesh_.own_columns.size(), {*column}});
            mesh_.own_columns.push_back(
                make_field(name, of_faces_ ? MeshField::Of::faces : MeshField::Of::vertices));
        }
    }
}

void PlyFieldReader::find_uvs(std::vector<bool>& used) {
    const auto list_of_corners = of_faces_ ? element_.find_list("texcoord") : std::nullopt;
    const auto columns = of_faces_ ? std::vector<std::size_t>() : find_uv_columns(element_);
    for (const std::size_t column : columns) {
        used[column] = true;
    }
    const bool is_known =
        std::ranges::find(mesh_.fields, kUvField, &MeshField::name) != mesh_.fields.end();
    if ((!columns.empty() || list_of_corners) && !is_known) {
        mesh_.fields.push_back(make_uvs());
    }
    if (wanted_.has(kUvField)) {
        corner_uvs_ = list_of_corners;
    }
}

std::string PlyFieldReader::prefix_for(std::string_view name) const {
    return lists_name(mesh_, name) ? element_.name + '_' : "";
}

void PlyFieldReader::list(MeshField field, const std::vector<std::size_t>& columns) {
    if (wanted_.has(field.name)) {
        columns_.push_back({&PolygonMesh::fields, mesh_.fields.size(), columns});
    }
    mesh_.fields.push_back(std::move(field));
}

void PlyFieldReader::add(std::uint64_t index, const PlyRecord& record, std::size_t corners) {
    colours_.add(record);
    for (const Columns& columns : columns_) {
        for (const std::size_t column : columns.columns) {
            (mesh_.*columns.list)[columns.field].values.push_back(record.scalars[column]);
        }
    }
    if (mesh_.normals) {
        for (const std::size_t column : normals_) {
            mesh_.normals->values.push_back(record.scalars[column]);
        }
    }
    if (corner_uvs_) {
        add_corner_uvs(index, record, corners);
    }
}

void PlyFieldReader::add_corner_uvs(std::uint64_t index, const PlyRecord& record,
                                    std::size_t corners) {
    const std::vector<double>& uvs = record.lists[*corner_uvs_];
    if (!uvs.empty() && uvs.size() != 2 * corners) {
        lose_uvs([&] {
            file_.fail(element_, index,
                       "texcoord has " + std::to_string(uvs.size()) + " numbers for " +
                           std::to_string(corners) + " corners");
        });
        return;
    }
    const std::size_t first = uvs_.size() / 2;
    uvs_.insert(uvs_.end(), uvs.begin(), uvs.end());
    for (std::size_t i = 0; i < corners; ++i) {
        uv_indices_.push_back(uvs.empty() ? MeshField::kNone
                                          : static_cast<std::uint32_t>(first + i));
    }
}

template <class Fail>
void PlyFieldReader::lose_uvs(const Fail& fail) {
    try {
        fail();
    } catch (const UserError& error) {
        if (wanted_.needs(kUvField)) {
            throw;
        }
        warn_left_out(file_.path(), kUvField, error, mesh_.warnings);
        mesh_.has_lost_uvs = true;
        corner_uvs_.reset();
    }
}

void PlyFieldReader::finish() {
    for (const Columns& columns : columns_) {
        colours_.scale(columns.columns[0], (mesh_.*columns.list)[columns.field].values);
    }
    if (corner_uvs_) {
        mesh_.uvs = std::move(uvs_);
        mesh_.corner_uvs = std::move(uv_indices_);
    }
}

} // namespace geodisk::tools
