#include "geodisk/outputs/scene_frame.hpp"

#include "files/meshes/mesh_file.hpp"
#include "files/samples/frame_style.hpp"
#include "files/samples/sample_format.hpp"
#include "geodisk/reports/json.hpp"
#include "picture/scene.hpp"
#include "picture/view.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// An axis that points up, and why.
struct KnownUp {
    Up up;
    const char* reason;
};

/// Returns what needs no guess.
std::optional<KnownUp> known_up(const OutputOptions& options, const MeshOptions& of_mesh) {
    if (!options.up.empty()) {
        return KnownUp{picture::parse_up("--up", options.up), "as --up says"};
    }
    if (has_y_up(of_mesh.mesh, of_mesh.format)) {
        return KnownUp{Up::y, "as the mesh is of glTF"};
    }
    const auto style = options.record.frame_style();
    return style && style->has_world()
               ? std::optional(KnownUp{FrameStyle().world, "as --frames has it; --up sets it"})
               : std::nullopt;
}

} // namespace

std::optional<FrameStyle> frame_style(const OutputOptions& options, const MeshOptions& of_mesh) {
    auto style = options.record.frame_style();
    if (style && style->has_world()) {
        style->world = known_up(options, of_mesh)->up;
    }
    return style;
}

HeaderEntries frame_entries(const std::optional<FrameStyle>& style) {
    if (!style) {
        return {};
    }
    HeaderEntries entries{{"frames", text_of(*style)}};
    if (style->has_world()) {
        entries.emplace_back("frames_up", std::string{small_letter(style->world)});
    }
    return entries;
}

std::string frame_line(const std::optional<FrameStyle>& style) {
    if (!style || !style->has_world()) {
        return "";
    }
    return "frames        " + text_of(*style) + ", where " + small_letter(style->world) +
           " points up; --up sets it\n";
}

std::optional<SceneFrame> scene_frame(const OutputOptions& options, const MeshOptions& of_mesh,
                                      const MeshInput& mesh) {
    const auto format = find_format(options.output, options.format);
    if (!format || !facts_of(*format).is_scene()) {
        return std::nullopt;
    }
    SceneFrame frame;
    if (const auto known = known_up(options, of_mesh)) {
        frame.up = known->up;
        frame.reason = known->reason;
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
