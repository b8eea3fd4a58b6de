#include "geodisk/outputs/scene_frame.hpp"

#include "files/input_file.hpp"
#include "files/samples/sample_format.hpp"
#include "geodisk/reports/json.hpp"
#include "picture/scene.hpp"
#include "picture/view.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

bool is_of_gltf(const MeshOptions& mesh) {
    const std::string extension =
        mesh.format.empty() ? lower_extension(mesh.mesh) : '.' + mesh.format;
    return extension == ".gltf" || extension == ".glb";
}

} // namespace

std::optional<SceneFrame> scene_frame(const OutputOptions& options, const MeshOptions& of_mesh,
                                      const MeshInput& mesh) {
    const auto format = find_format(options.output, options.format);
    if (!format || !facts_of(*format).is_scene()) {
        return std::nullopt;
    }
    SceneFrame frame;
    if (!options.up.empty()) {
        frame.up = picture::parse_up("--up", options.up);
        frame.reason = "as --up says";
    } else if (is_of_gltf(of_mesh)) {
        frame.reason = "as the mesh is of glTF";
    } else {
        frame.up = picture::likely_up(
            picture::make_scene(mesh.file.positions, mesh.dimension(), mesh.file.triangles));
        frame.reason = "a guess, --up sets it";
    }
    const bool holds_z = facts_of(*format).axes == SceneAxes::y_or_z;
    frame.is_turned = frame.up != Up::y && (frame.up == Up::x || !holds_z);
    frame.metres_per_unit = options.target().metres_per_unit;
    return frame;
}

SampleTarget target_in(const OutputOptions& options, const std::optional<SceneFrame>& frame) {
    SampleTarget target = options.target();
    target.up = frame ? frame->up : Up::y;
    return target;
}

std::string scene_line(const std::optional<SceneFrame>& frame) {
    if (!frame) {
        return "";
    }
    const std::string axis{small_letter(frame->up)};
    return "scene         " + axis + " up, " + frame->reason +
           (frame->is_turned ? "; turned, as the format has another axis" : "") + "; a unit is " +
           rounded(frame->metres_per_unit, 6) + " m\n";
}

Json scene_json(const std::optional<SceneFrame>& frame) {
    if (!frame) {
        return nullptr;
    }
    return {{"up", std::string{small_letter(frame->up)}},
            {"reason", frame->reason},
            {"turned", frame->is_turned},
            {"metres_per_unit", frame->metres_per_unit}};
}

} // namespace geodisk::tools
