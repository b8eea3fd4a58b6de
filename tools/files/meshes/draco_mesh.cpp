#include "files/meshes/draco_mesh.hpp"

#include <array>
#include <exception>
#include <utility>

#include <draco/compression/decode.h>

namespace geodisk::tools {
namespace {

constexpr std::size_t kMaxComponents = 16;

DracoMesh failed(std::string why) {
    DracoMesh result;
    result.failure = std::move(why);
    return result;
}

DracoMesh decode(std::string_view bytes, const std::vector<std::uint32_t>& ids) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        return failed("its data cannot be decoded: " + decoded.status().error_msg_string());
    }
    const draco::Mesh& mesh = *decoded.value();
    DracoMesh result;
    result.vertex_count = mesh.num_points();
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
        for (const draco::PointIndex& corner : mesh.face(f)) {
            if (corner.value() >= result.vertex_count) {
                return failed("its data hold a vertex index out of range");
            }
            result.corners.push_back(corner.value());
        }
    }
    for (const std::uint32_t id : ids) {
        const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
        if (attribute == nullptr) {
            return failed("its data have no attribute " + std::to_string(id));
        }
        const auto components = static_cast<std::size_t>(attribute->num_components());
        if (components > kMaxComponents) {
            return failed("its data have an attribute of too many numbers");
        }
        DracoMesh::Attribute values{id, components, attribute->normalized(), {}};
        values.values.reserve(components * result.vertex_count);
        for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
            std::array<double, kMaxComponents> numbers{};
            const draco::AttributeValueIndex place = attribute->mapped_index(p);
            if (place.value() >= attribute->size() ||
                !attribute->ConvertValue(place, static_cast<std::int8_t>(components),
                                         numbers.data())) {
                return failed("its data cannot be decoded");
            }
            values.values.insert(values.values.end(), numbers.begin(),
                                 numbers.begin() + static_cast<std::ptrdiff_t>(components));
        }
        result.attributes.push_back(std::move(values));
    }
    return result;
}

} // namespace

DracoMesh draco_decoded(std::string_view bytes, const std::vector<std::uint32_t>& ids) {
    try {
        return decode(bytes, ids);
    } catch (const std::exception&) { // Damaged data may promise more than memory holds.
        return failed("its data cannot be decoded");
    }
}

} // namespace geodisk::tools
