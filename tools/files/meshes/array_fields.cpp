#include "files/meshes/array_fields.hpp"

#include <algorithm>
#include <string_view>

#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kMaxComponents = 64; // More are no attribute that anybody interpolates.
constexpr std::size_t kMaxListed = 10'000; // Of all arrays; files have some ten.
constexpr double kMaxColourByte = 255;

void append_values(std::vector<double>& values, std::vector<double>&& more) {
    if (values.empty()) {
        values = std::move(more);
    } else {
        values.insert(values.end(), more.begin(), more.end());
    }
}

} // namespace

void ArrayFields::add(MeshArray array, const Read& read) {
    using Role = MeshArray::Role;
    const bool is_of_faces = array.of == MeshField::Of::faces;
    if (array.role == Role::normals && is_of_faces) {
        return; // Each face has just one normal.
    }
    if ((array.role == Role::normals && array.components != 3) ||
        (array.role == Role::uvs && (is_of_faces || array.components != 2)) ||
        (array.role == Role::colours && array.components != 3 && array.components != 4)) {
        array.role = Role::numbers;
    }
    if (array.name.empty()) {
        return; // Nothing can ask for it.
    }
    if (array.role == Role::normals) {
        add_normals(array, read);
        return;
    }
    if (!wanted_.are_given() || array.components == 0) {
        return;
    }
    if (array.components > kMaxComponents) {
        mesh_.warnings.push_back({"attribute_left_out",
                                  1,
                                  "",
                                  "attribute " + in_quotes(array.name) + " of " +
                                      std::to_string(array.components) +
                                      " numbers per element left out: at most " +
                                      std::to_string(kMaxComponents) + " are read",
                                  {}});
        return;
    }
    const Key key{array.of, array.name};
    const auto known = places_.find(key);
    const bool is_new = known == places_.end();
    const std::size_t place = is_new ? mesh_.fields.size() : known->second;
    if (is_new) {
        components_ += array.components;
        if (components_ > kMaxListed) {
            fail_input(path_, "has more than " + grouped(kMaxListed) + " numbers per element");
        }
        mesh_.fields.push_back(field_of(array));
    }
    try {
        read_into(mesh_.fields[place], array, read);
    } catch (const UserError& error) {
        const MeshField& field = mesh_.fields[place];
        if (is_needed(field)) {
            throw;
        }
        warn_left_out(path_, field.name, error, mesh_.warnings);
        if (is_new) {
            mesh_.fields.pop_back();
        }
        return;
    }
    if (is_new) {
        places_.emplace(key, place);
    }
}

void ArrayFields::read_into(MeshField& field, const MeshArray& array, const Read& read) {
    if (!wanted_.all && !is_needed(field)) {
        return;
    }
    std::vector<double> values = read();
    if (field.is_colour && array.is_whole) {
        std::ranges::for_each(values, [](double& value) { value /= kMaxColourByte; });
    }
    append_values(field.name == kUvField ? mesh_.uvs : field.values, std::move(values));
}

void ArrayFields::add_normals(const MeshArray& array, const Read& read) {
    if (!wanted_.normals) {
        return;
    }
    if (!mesh_.normals) {
        mesh_.normals = make_field("normal", array.of, array.components);
    }
    append_values(mesh_.normals->values, read());
}

MeshField ArrayFields::field_of(const MeshArray& array) const {
    const bool is_of_faces = array.of == MeshField::Of::faces;
    const std::string prefix = is_of_faces ? "face_" : "vertex_";
    const auto prefix_for = [&](std::string_view name) {
        return lists_name(mesh_, name) ? prefix : std::string();
    };
    if (array.role == MeshArray::Role::uvs && !lists_name(mesh_, kUvField)) {
        return make_uvs();
    }
    if (array.role == MeshArray::Role::colours) {
        MeshField colours = make_colours(array.of, array.components, prefix_for(kColourField));
        if (!lists_name(mesh_, colours.name)) {
            return colours;
        }
    }
    MeshField field = make_field(prefix_for(array.name) + array.name, array.of, array.components);
    field.is_whole = array.is_whole;
    return field;
}

bool ArrayFields::is_needed(const MeshField& field) const {
    return wanted_.needs(field.name) ||
           std::ranges::any_of(field.components, [&](const std::string& component) {
               return wanted_.needs(component);
           });
}

void ArrayFields::finish() {
    for (MeshField& field : mesh_.fields) {
        if (field.is_colour) {
            scale_colours(field);
        }
    }
    if (!mesh_.uvs.empty()) {
        mesh_.corner_uvs = mesh_.corners;
    }
}

} // namespace geodisk::tools
