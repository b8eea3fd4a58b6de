#include "files/meshes/ply_materials.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/named_images.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

std::vector<std::string> image_names(const PlyFile& file) {
    constexpr std::string_view kKey = "TextureFile ";
    std::vector<std::string> names;
    for (const std::string& comment : file.comments()) {
        if (comment.starts_with(kKey)) {
            names.emplace_back(trimmed(std::string_view(comment).substr(kKey.size())));
        }
    }
    return names;
}

/// Returns the number of the image of each face.
std::vector<std::uint32_t> numbers_of_faces(const PlyFile& file, const PolygonMesh& mesh,
                                            std::size_t images) {
    const auto found = std::ranges::find(mesh.fields, kImageNumber, &MeshField::name);
    if (images == 1 || found == mesh.fields.end() ||
        found->values.size() != mesh.face_ends.size()) {
        if (images > 1) {
            fail_input(file.path(), "names several images, but its faces have no " +
                                        std::string(kImageNumber) + " that says which they have");
        }
        return std::vector<std::uint32_t>(mesh.face_ends.size(), 0);
    }
    std::vector<std::uint32_t> numbers;
    for (std::size_t face = 0; face < found->values.size(); ++face) {
        const double number = found->values[face];
        if (!(number >= 0 && number < static_cast<double>(images))) {
            fail_input(file.path(), mesh.names.of_face(face) + ": " + kImageNumber + " is " +
                                        exact_text(number) + ", but the file names " +
                                        std::to_string(images) + " images");
        }
        numbers.push_back(static_cast<std::uint32_t>(number));
    }
    return numbers;
}

} // namespace

void take_ply_materials(const PlyFile& file, const FileScope& scope, PolygonMesh& mesh) {
    const std::vector<std::string> names = image_names(file);
    if (names.empty()) {
        return;
    }
    mesh.part_of_face = numbers_of_faces(file, mesh, names.size());
    mesh.part_names.materials = names;
    MaterialColours materials;
    NamedImages images(scope, materials.images, mesh.warnings);
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        MeshPart part;
        part.material = i;
        mesh.parts.push_back(part);
        images.take(names[i],
                    {file.path(), "", "", "correct the comment TextureFile, or add the file"},
                    materials.colours.emplace_back().emplace());
    }
    mesh.materials = std::move(materials);
}

} // namespace geodisk::tools
