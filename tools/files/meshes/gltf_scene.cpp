#include "files/meshes/gltf_scene.hpp"

#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace geodisk::tools {
namespace {

std::string name_of(std::uint64_t node) {
    return "node " + std::to_string(node);
}

/// Three, four and three numbers at these places; those that are missing change nothing.
glm::dmat4 composed(const double* translation, const double* rotation, const double* scale) {
    glm::dmat4 result(1);
    if (translation != nullptr) {
        result[3] = glm::dvec4(translation[0], translation[1], translation[2], 1);
    }
    if (rotation != nullptr) {
        const glm::dquat turn(rotation[3], rotation[0], rotation[1], rotation[2]);
        result = result * glm::mat4_cast(turn);
    }
    for (int axis = 0; axis < 3 && scale != nullptr; ++axis) {
        result[axis] *= scale[axis];
    }
    return result;
}

const double* data_or_null(const std::vector<double>& numbers, std::size_t offset = 0) {
    return numbers.empty() ? nullptr : numbers.data() + offset;
}

} // namespace

std::vector<GltfPlacement> GltfScene::placements() {
    std::vector<GltfPlacement> result;
    is_met_.assign(document_.count("nodes"), false);
    above_.assign(document_.count("nodes"), std::nullopt);
    for (const std::uint64_t root : root_nodes()) {
        add_nodes(root, result);
    }
    if (document_.count("nodes") == 0) {
        for (std::uint32_t mesh = 0; mesh < document_.count("meshes"); ++mesh) {
            result.push_back({{}, mesh, {glm::dmat4(1)}, {}, {}});
        }
    }
    return result;
}

std::vector<std::uint64_t> GltfScene::root_nodes() const {
    if (document_.count("scenes") > 0) {
        const std::uint64_t scene = document_.index_or(document_.root(), "scene", 0, "the file");
        return document_.indices(document_.at("scenes", "scene", scene), "nodes",
                                 "scene " + std::to_string(scene));
    }
    std::vector<bool> is_child(document_.count("nodes"), false);
    for (std::uint64_t i = 0; i < is_child.size(); ++i) {
        for (const std::uint64_t child : document_.indices(node(i), "children", name_of(i))) {
            node(child);
            is_child[child] = true;
        }
    }
    std::vector<std::uint64_t> roots;
    for (std::uint64_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) {
            roots.push_back(i);
        }
    }
    return roots;
}

glm::dmat4 GltfScene::transform_of(const GltfJson& node, const std::string& name) const {
    if (const auto matrix = document_.numbers(node, "matrix", 16, name); !matrix.empty()) {
        return glm::make_mat4(matrix.data());
    }
    const auto translation = document_.numbers(node, "translation", 3, name);
    const auto rotation = document_.numbers(node, "rotation", 4, name);
    const auto scale = document_.numbers(node, "scale", 3, name);
    return composed(data_or_null(translation), data_or_null(rotation), data_or_null(scale));
}

/// Returns the transforms of the node's instances, relative to it; the identity alone if it has
/// none.
std::vector<glm::dmat4> GltfScene::instances_of(const GltfJson& node, const std::string& name) {
    const GltfJson* const extension =
        document_.find_extension(node, "EXT_mesh_gpu_instancing", name);
    if (extension == nullptr) {
        return {glm::dmat4(1)};
    }
    const GltfJson* const attributes = document_.find_object(*extension, "attributes", name);
    std::optional<std::size_t> count;
    const auto read = [&](const char* attribute, const char* type, std::size_t components) {
        const auto accessor = attributes == nullptr
                                  ? std::nullopt
                                  : document_.find_index(*attributes, attribute, name);
        std::vector<double> numbers;
        if (accessor) {
            numbers = data_.numbers(*accessor, type, name);
            if (numbers.empty() ||
                numbers.size() / components != count.value_or(numbers.size() / components)) {
                document_.fail(name + ": its instances have attributes of other counts");
            }
            count = numbers.size() / components;
        }
        return numbers;
    };
    const std::vector<double> translations = read("TRANSLATION", "VEC3", 3);
    const std::vector<double> rotations = read("ROTATION", "VEC4", 4);
    const std::vector<double> scales = read("SCALE", "VEC3", 3);
    std::vector<glm::dmat4> instances;
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
        instances.push_back(composed(data_or_null(translations, 3 * i),
                                     data_or_null(rotations, 4 * i), data_or_null(scales, 3 * i)));
    }
    if (instances.empty()) {
        document_.fail(name + ": its instances have no places");
    }
    return instances;
}

/// A node and those below it, in the order of the file; not by recursion, whose depth would be the
/// file's.
void GltfScene::add_nodes(std::uint64_t root, std::vector<GltfPlacement>& placements) {
    std::vector<std::pair<std::uint64_t, glm::dmat4>> left{{root, glm::dmat4(1)}};
    while (!left.empty()) {
        const auto [index, above] = left.back();
        left.pop_back();
        const GltfJson& object = node(index);
        const std::string name = name_of(index);
        if (is_met_[index]) {
            document_.fail(name + " is met twice; nodes must make a tree");
        }
        is_met_[index] = true;
        const GltfJson* const visibility =
            document_.find_extension(object, "KHR_node_visibility", name);
        if (visibility != nullptr && visibility->contains("visible") &&
            !document_.flag(*visibility, "visible", name)) {
            ++hidden_nodes_;
            continue;
        }
        const glm::dmat4 here = above * transform_of(object, name);
        if (const auto mesh = document_.find_index(object, "mesh", name)) {
            document_.at("meshes", "mesh", *mesh);
            GltfPlacement placement{
                static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(*mesh), {}, {}, {}};
            for (const glm::dmat4& instance : instances_of(object, name)) {
                placement.transforms.push_back(here * instance);
            }
            placement.skin = document_.find_index(object, "skin", name);
            placement.weights = document_.numbers(object, "weights", 0, name);
            placements.push_back(std::move(placement));
        }
        std::vector<std::uint64_t> children = document_.indices(object, "children", name);
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            left.emplace_back(*child, here);
            if (*child < above_.size()) { // Others are told of when their turn comes.
                above_[*child] = static_cast<std::uint32_t>(index);
            }
        }
    }
}

/// Returns the transform of any node, in the scene or not.
glm::dmat4 GltfScene::global_transform(std::uint64_t index) {
    std::vector<std::uint64_t> path; // Up to a node that is known, or to the root.
    std::optional<std::uint64_t> next = index;
    for (; next && !globals_.contains(*next); next = parents_[*next]) {
        if (path.size() > parents_.size()) {
            document_.fail(name_of(index) + " is below itself; nodes must make a tree");
        }
        path.push_back(*next);
    }
    glm::dmat4 result = next ? globals_.at(*next) : glm::dmat4(1);
    for (auto below = path.rbegin(); below != path.rend(); ++below) {
        result = result * transform_of(node(*below), name_of(*below));
        globals_[*below] = result;
    }
    return result;
}

const std::vector<glm::dmat4>& GltfScene::joint_matrices(std::uint64_t skin) {
    const auto [known, is_new] = skins_.try_emplace(skin);
    if (!is_new) {
        return known->second;
    }
    if (parents_.empty()) {
        parents_.resize(document_.count("nodes"));
        for (std::uint64_t i = 0; i < parents_.size(); ++i) {
            for (const std::uint64_t child : document_.indices(node(i), "children", name_of(i))) {
                node(child);
                if (parents_[child]) {
                    document_.fail(name_of(child) + " is met twice; nodes must make a tree");
                }
                parents_[child] = i;
            }
        }
    }
    const GltfJson& object = document_.at("skins", "skin", skin);
    const std::string name = "skin " + std::to_string(skin);
    const std::vector<std::uint64_t> joints = document_.indices(object, "joints", name);
    std::vector<double> inverses;
    if (const auto accessor = document_.find_index(object, "inverseBindMatrices", name)) {
        inverses = data_.numbers(*accessor, "MAT4", name);
        if (inverses.size() < 16 * joints.size()) {
            document_.fail(name + ": has fewer inverseBindMatrices than joints");
        }
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
        node(joints[i]);
        glm::dmat4 matrix = global_transform(joints[i]);
        if (!inverses.empty()) {
            matrix = matrix * glm::make_mat4(&inverses[16 * i]);
        }
        known->second.push_back(matrix);
    }
    return known->second;
}

void GltfScene::add_warnings(std::vector<MeshWarning>& warnings) const {
    add_warning(warnings, "hidden_nodes", hidden_nodes_, "",
                "hidden node left out with what is below it",
                "hidden nodes left out with what is below them");
}

} // namespace geodisk::tools
