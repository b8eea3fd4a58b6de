#include "files/meshes/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "files/input_file.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

enum class Extension { read, ignored, unknown };

/// Returns whether an extension that a file requires is read, also for colours of materials if
/// wanted.
Extension kind_of(std::string_view name, bool has_materials) {
    constexpr std::array<std::string_view, 6> kRead{
        "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
        "KHR_meshopt_compression", "KHR_mesh_quantization",   "KHR_node_visibility"};
    constexpr std::array<std::string_view, 3> kReadOfMaterials{
        "EXT_texture_webp", "KHR_materials_pbrSpecularGlossiness", "KHR_texture_transform"};
    // Parts of names of extensions that leave the surface as it is.
    constexpr std::array<std::string_view, 17> kHarmless{
        "material",  "texture", "light",    "technique", "image",     "camera",
        "animation", "audio",   "metadata", "xmp",       "packing",   "outline",
        "features",  "_lod",    "hoverab",  "selectab",  "interactiv"};
    if (std::ranges::find(kRead, name) != kRead.end() ||
        (has_materials && std::ranges::find(kReadOfMaterials, name) != kReadOfMaterials.end())) {
        return Extension::read;
    }
    const std::string lower = lower_case(std::string(name));
    const bool is_harmless = std::ranges::any_of(
        kHarmless, [&](std::string_view part) { return lower.find(part) != std::string::npos; });
    return is_harmless ? Extension::ignored : Extension::unknown;
}

} // namespace

void check_required_extensions(const GltfDocument& document, bool has_materials,
                               std::vector<MeshWarning>& warnings) {
    for (const GltfJson& value :
         document.array(document.root(), "extensionsRequired", "the file")) {
        const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
        switch (kind_of(name, has_materials)) {
        case Extension::read:
            break;
        case Extension::ignored:
            warnings.push_back({"ignored_extension",
                                1,
                                "",
                                "extension " + in_quotes(name) +
                                    " is required and ignored: it does not change the surface",
                                {}});
            break;
        case Extension::unknown:
            document.fail("requires the extension " + in_quotes(name) +
                          ", which is not read and may change the surface");
        }
    }
}

} // namespace geodisk::tools
