#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include "files/input_file.hpp"
#include "files/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// What tinygltf is told the folder of the file to be; it looks in others as well.
constexpr std::string_view kFolder = "folder/";

/// Opens buffers beside the file for tinygltf, and nothing else.
class BufferFolder {
  public:
    explicit BufferFolder(const Path& path) : path_(path) {}

    tinygltf::FsCallbacks callbacks() { return all_callbacks<tinygltf::FsCallbacks>(); }

  private:
    /// Newer versions of tinygltf ask for sizes as well.
    template <class Callbacks>
    Callbacks all_callbacks() {
        Callbacks all{};
        all.FileExists = exists;
        all.ExpandFilePath = expand;
        all.ReadWholeFile = read;
        all.WriteWholeFile = write;
        if constexpr (requires { all.GetFileSizeInBytes; }) {
            all.GetFileSizeInBytes = find_size;
        }
        all.user_data = this;
        return all;
    }

    static bool find_size(std::size_t* size, std::string*, const std::string& name, void* self) {
        const Path& path = static_cast<BufferFolder*>(self)->path_;
        const Path file = path.parent_path() / name.substr(kFolder.size());
        std::error_code error;
        *size = static_cast<std::size_t>(std::filesystem::file_size(file, error));
        if (error) {
            read_file(file); // Which says why it cannot be.
        }
        return !error;
    }
    static bool exists(const std::string& name, void* self) {
        return name.starts_with(kFolder) &&
               static_cast<BufferFolder*>(self)->may_open(name.substr(kFolder.size()));
    }
    static std::string expand(const std::string& name, void*) { return name; }
    static bool read(std::vector<unsigned char>* bytes, std::string*, const std::string& name,
                     void* self) {
        const Path& path = static_cast<BufferFolder*>(self)->path_;
        const std::string text = read_file(path.parent_path() / name.substr(kFolder.size()));
        bytes->assign(text.begin(), text.end());
        return true;
    }
    static bool write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    }

    /// Images are not read, wherever they are.
    bool may_open(const std::string& name) const {
        const std::string extension = lower_extension(name);
        for (const char* const image : {".png", ".jpg", ".jpeg", ".webp", ".ktx", ".ktx2", ".basis",
                                        ".dds", ".gif", ".bmp"}) {
            if (extension == image) {
                return false;
            }
        }
        const Path inside(name);
        const bool goes_up = std::find(inside.begin(), inside.end(), Path("..")) != inside.end();
        if (name.empty() || name.find_first_of(std::string_view(":\\\0", 3)) != std::string::npos ||
            name.front() == '/' || goes_up) {
            fail_input(path_, "its buffer " + in_quotes(name) +
                                  " is not a file of its folder, so it is not read");
        }
        return true;
    }

    const Path& path_;
};

bool skip_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                const unsigned char*, int, void*) {
    return true;
}

/// Elements of a buffer, in bounds.
struct Elements {
    const unsigned char* first = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
    int type = 0; ///< Of a component.

    template <class Value>
    Value value(std::size_t element, std::size_t component) const {
        Value result;
        std::memcpy(&result, first + element * stride + component * sizeof result, sizeof result);
        return result; // Hosts of geodisk are little-endian, as glTF is.
    }
};

class GltfReader {
  public:
    explicit GltfReader(const Path& path) : path_(path) { load(); }

    PolygonMesh read() && {
        check_extensions();
        mesh_.names = {"triangle ", "vertex ", {}, {}, 0};
        const std::vector<int> roots = root_nodes();
        for (const int node : roots) {
            add_node(node, glm::dmat4(1));
        }
        if (model_.nodes.empty()) {
            for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
                add_mesh(static_cast<int>(m), glm::dmat4(1));
            }
        }
        add_warning(mesh_.warnings, "other_primitives", others_.count, "",
                    "primitive of points or lines ignored",
                    "primitives of points or lines ignored");
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { fail_input(path_, message); }

    void load() {
        const std::string bytes = read_text(path_);
        if (!bytes.starts_with("glTF")) {
            refuse_other_mesh(path_, bytes, ".gltf");
        }
        if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
            fail("is larger than 4 GiB, which no glTF file may be");
        }
        const auto size = static_cast<unsigned int>(bytes.size());
        BufferFolder folder(path_);
        tinygltf::TinyGLTF loader;
        loader.SetImageLoader(skip_image, nullptr);
        loader.SetFsCallbacks(folder.callbacks());
        std::string error, warning;
        bool is_loaded = false;
        try {
            const std::string base(kFolder);
            is_loaded = bytes.starts_with("glTF")
                            ? loader.LoadBinaryFromMemory(
                                  &model_, &error, &warning,
                                  reinterpret_cast<const unsigned char*>(bytes.data()), size, base)
                            : loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(),
                                                         size, base);
        } catch (const UserError&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& thrown) { // Of values that are not what they should be.
            error = thrown.what();
        }
        if (!is_loaded) {
            const std::size_t end = error.find_last_not_of(" \r\n");
            fail("is not a glTF file that can be read: " + one_line(error.substr(0, end + 1)));
        }
    }

    /// An extension that does not tell where triangles are may be left out.
    void check_extensions() const {
        for (const std::string& name : model_.extensionsRequired) {
            if (name == "KHR_draco_mesh_compression") {
                fail("is compressed by Draco, which is not read; write it without");
            }
            const bool is_harmless =
                name == "KHR_mesh_quantization" || name.starts_with("KHR_materials") ||
                name.starts_with("KHR_texture") || name.starts_with("KHR_lights") ||
                name.starts_with("EXT_texture") || name.starts_with("MSFT_texture");
            if (!is_harmless) {
                fail("requires the extension " + in_quotes(name) + ", which is not read");
            }
        }
    }

    template <class List>
    const auto& at(const List& list, int index, const std::string& what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
            fail(what + ' ' + std::to_string(index) + " is out of range");
        }
        return list[static_cast<std::size_t>(index)];
    }

    /// Of the scene to show, else of the first, else all that are no children.
    std::vector<int> root_nodes() const {
        if (!model_.scenes.empty()) {
            return at(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
        }
        std::vector<bool> is_child(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) {
                at(model_.nodes, child, "node");
                is_child[static_cast<std::size_t>(child)] = true;
            }
        }
        std::vector<int> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) {
                roots.push_back(static_cast<int>(i));
            }
        }
        return roots;
    }

    glm::dmat4 transform_of(const tinygltf::Node& node) const {
        glm::dmat4 result(1);
        if (node.matrix.size() == 16) {
            result = glm::make_mat4(node.matrix.data());
        }
        if (node.translation.size() == 3) {
            const auto& t = node.translation;
            result[3] = glm::dvec4(t[0], t[1], t[2], 1);
        }
        if (node.rotation.size() == 4) {
            const auto& r = node.rotation;
            result = result * glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
        }
        for (int axis = 0; axis < 3 && node.scale.size() == 3; ++axis) {
            result[axis] *= node.scale[static_cast<std::size_t>(axis)];
        }
        return result;
    }

    /// A node and those below it, in the order of the file; not by recursion, whose depth would be
    /// the file's.
    void add_node(int root, const glm::dmat4& transform) {
        std::vector<std::pair<int, glm::dmat4>> left{{root, transform}};
        is_met_.resize(model_.nodes.size(), false);
        while (!left.empty()) {
            const auto [index, above] = left.back();
            left.pop_back();
            const tinygltf::Node& node = at(model_.nodes, index, "node");
            if (is_met_[static_cast<std::size_t>(index)]) {
                fail("node " + std::to_string(index) + " is met twice; nodes must make a tree");
            }
            is_met_[static_cast<std::size_t>(index)] = true;
            const glm::dmat4 here = above * transform_of(node);
            if (node.mesh >= 0) {
                add_mesh(node.mesh, here);
            }
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
                left.emplace_back(*child, here);
            }
        }
    }

    void add_mesh(int index, const glm::dmat4& transform) {
        const tinygltf::Mesh& mesh = at(model_.meshes, index, "mesh");
        std::map<int, std::uint32_t> first_vertices; // Primitives may share their positions.
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
            place_ = "mesh " + std::to_string(index) + ", primitive " + std::to_string(p);
            add_primitive(mesh.primitives[p], transform, first_vertices);
        }
    }

    void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform,
                       std::map<int, std::uint32_t>& first_vertices) {
        const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
        if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
            mode != TINYGLTF_MODE_TRIANGLE_FAN) {
            others_.add(0);
            return;
        }
        const auto found = primitive.attributes.find("POSITION");
        if (found == primitive.attributes.end()) {
            fail(place_ + ": has no POSITION");
        }
        const tinygltf::Accessor& positions = at(model_.accessors, found->second, "accessor");
        if (positions.bufferView < 0 &&
            primitive.extensions.contains("KHR_draco_mesh_compression")) {
            fail(place_ + ": is compressed by Draco, which is not read; write it without");
        }
        auto [first, is_new] = first_vertices.try_emplace(found->second, 0);
        if (is_new) {
            first->second = static_cast<std::uint32_t>(mesh_.positions.size() / 3);
            add_positions(positions, transform);
        }
        const bool is_mirrored = glm::determinant(transform) < 0;
        add_triangles(indices_of(primitive, positions.count), mode, first->second, is_mirrored);
    }

    /// All within their buffer, or an error.
    Elements elements(int view_index, std::uint64_t offset, std::uint64_t count, int type,
                      int components) const {
        const tinygltf::BufferView& view = at(model_.bufferViews, view_index, "bufferView");
        const tinygltf::Buffer& buffer = at(model_.buffers, view.buffer, "buffer");
        const std::int32_t size =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
        if (size <= 0) {
            fail(place_ + ": component type " + std::to_string(type) + " is unknown");
        }
        const auto element =
            static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(components);
        const std::uint64_t stride = view.byteStride == 0 ? element : view.byteStride;
        const std::uint64_t held = buffer.data.size();
        // In an order in which no sum or product can overflow.
        const bool view_fits = view.byteOffset <= held && view.byteLength <= held - view.byteOffset;
        const bool fits =
            view_fits && offset <= view.byteLength && stride >= element &&
            (count == 0 || (element <= view.byteLength - offset &&
                            count - 1 <= (view.byteLength - offset - element) / stride));
        if (!fits) {
            fail(place_ + ": its data reach beyond their buffer");
        }
        return {buffer.data.data() + view.byteOffset + offset, stride, count, type};
    }

    static double normalized(double value, double largest) {
        return std::max(value / largest, -1.0);
    }

    double component(const Elements& all, bool is_normalized, std::size_t i, std::size_t k) const {
        const auto scaled = [is_normalized](auto value) {
            const auto largest = static_cast<double>(std::numeric_limits<decltype(value)>::max());
            return is_normalized ? normalized(value, largest) : static_cast<double>(value);
        };
        switch (all.type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return all.value<float>(i, k);
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(all.value<std::int8_t>(i, k));
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(all.value<std::uint8_t>(i, k));
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(all.value<std::int16_t>(i, k));
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(all.value<std::uint16_t>(i, k));
        default:
            fail(place_ + ": positions of component type " + std::to_string(all.type));
        }
    }

    std::uint32_t index_at(const Elements& all, std::size_t i) const {
        switch (all.type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return all.value<std::uint8_t>(i, 0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return all.value<std::uint16_t>(i, 0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return all.value<std::uint32_t>(i, 0);
        default:
            fail(place_ + ": indices of component type " + std::to_string(all.type));
        }
    }

    void add_positions(const tinygltf::Accessor& accessor, const glm::dmat4& transform) {
        if (accessor.type != TINYGLTF_TYPE_VEC3) {
            fail(place_ + ": its positions are not of 3 coordinates");
        }
        // Without a view all are zero but those replaced; a short file could ask for any number.
        constexpr std::uint64_t kMost = std::uint64_t{1} << 20;
        const std::uint64_t vertices = mesh_.positions.size() / 3;
        if (accessor.bufferView < 0 && (!accessor.sparse.isSparse || accessor.count > kMost)) {
            fail(place_ + ": its positions have no data");
        }
        if (accessor.count > std::numeric_limits<std::uint32_t>::max() - vertices) {
            fail("has more vertices than a face can refer to");
        }
        std::vector<glm::dvec3> points;
        const auto point = [&](const Elements& all, std::size_t i) {
            glm::dvec3 result;
            for (int axis = 0; axis < 3; ++axis) {
                result[axis] =
                    component(all, accessor.normalized, i, static_cast<std::size_t>(axis));
            }
            return result;
        };
        if (accessor.bufferView < 0) {
            points.resize(accessor.count, glm::dvec3(0));
        } else {
            const Elements all = elements(accessor.bufferView, accessor.byteOffset, accessor.count,
                                          accessor.componentType, 3);
            points.reserve(all.count);
            for (std::size_t i = 0; i < all.count; ++i) {
                points.push_back(point(all, i));
            }
        }
        if (accessor.sparse.isSparse) {
            replace_points(accessor, points, point);
        }
        mesh_.positions.reserve(mesh_.positions.size() + 3 * points.size());
        for (const glm::dvec3& p : points) {
            const glm::dvec4 placed = transform * glm::dvec4(p, 1);
            mesh_.positions.insert(mesh_.positions.end(), {placed.x, placed.y, placed.z});
        }
    }

    template <class Point>
    void replace_points(const tinygltf::Accessor& accessor, std::vector<glm::dvec3>& points,
                        const Point& point) const {
        const auto& sparse = accessor.sparse;
        if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
            fail(place_ + ": its sparse positions have a negative count or place");
        }
        const auto count = static_cast<std::uint64_t>(sparse.count);
        const Elements indices = elements(sparse.indices.bufferView,
                                          static_cast<std::uint64_t>(sparse.indices.byteOffset),
                                          count, sparse.indices.componentType, 1);
        const Elements values =
            elements(sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset),
                     count, accessor.componentType, 3);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t index = index_at(indices, i);
            if (index >= points.size()) {
                fail(place_ + ": sparse index " + std::to_string(index) + " is out of range");
            }
            points[index] = point(values, i);
        }
    }

    /// Without indices, all vertices in order.
    std::vector<std::uint32_t> indices_of(const tinygltf::Primitive& primitive,
                                          std::size_t vertices) const {
        std::vector<std::uint32_t> indices;
        if (primitive.indices < 0) {
            for (std::size_t i = 0; i < vertices; ++i) {
                indices.push_back(static_cast<std::uint32_t>(i));
            }
            return indices;
        }
        const tinygltf::Accessor& accessor = at(model_.accessors, primitive.indices, "accessor");
        if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.sparse.isSparse) {
            fail(place_ + ": its indices are " +
                 (accessor.sparse.isSparse ? "sparse, which is not read" : "no single numbers"));
        }
        const Elements all = elements(accessor.bufferView, accessor.byteOffset, accessor.count,
                                      accessor.componentType, 1);
        indices.reserve(all.count);
        for (std::size_t i = 0; i < all.count; ++i) {
            indices.push_back(index_at(all, i));
            if (indices.back() >= vertices) {
                fail(place_ + ": vertex index " + std::to_string(indices.back()) +
                     " is out of range, it has " + std::to_string(vertices) + " vertices");
            }
        }
        return indices;
    }

    void add_triangles(const std::vector<std::uint32_t>& indices, int mode, std::uint32_t first,
                       bool is_mirrored) {
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            if (is_mirrored) {
                std::swap(b, c);
            }
            for (const std::size_t i : {a, b, c}) {
                mesh_.corners.push_back(first + indices[i]);
            }
            mesh_.face_ends.push_back(mesh_.corners.size());
        };
        if (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0) {
            fail(place_ + ": " + std::to_string(indices.size()) +
                 " indices are not those of triangles");
        }
        const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
        for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
            if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
                add(i + 1, i + 2, 0);
            } else {
                const bool is_odd = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
                add(i, i + (is_odd ? 2 : 1), i + (is_odd ? 1 : 2));
            }
        }
    }

    const Path& path_;
    tinygltf::Model model_;
    PolygonMesh mesh_;
    std::string place_; ///< Of the primitive that is being read, for messages.
    std::vector<bool> is_met_;
    Found others_; ///< Primitives without triangles.
};

} // namespace

PolygonMesh read_gltf(const Path& path) {
    return GltfReader(path).read();
}

} // namespace geodisk::tools
