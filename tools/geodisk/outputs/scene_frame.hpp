// Orientation and unit of the scenes that samples are written to.
#pragma once

#include <optional>
#include <string>

#include "files/samples/sample_format.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/reports/json_type.hpp"
#include "geometry/frames.hpp"
#include "geometry/up.hpp"

namespace geodisk::tools {

/// The frame of a scene.
struct SceneFrame {
    Up up = Up::y;
    std::string reason; ///< Why that axis points up.
    bool is_turned = false;
    double metres_per_unit = 1;
};

/// Returns how the frames of samples on a mesh turn, nothing without --frames. They keep to the
/// axis of --up, else to y for a mesh of glTF, where y points up, else to z: nothing is guessed.
std::optional<FrameStyle> frame_style(const OutputOptions& options, const MeshOptions& of_mesh);

/// Returns what a header says of them, and a line for people.
HeaderEntries frame_entries(const std::optional<FrameStyle>& style);
std::string frame_line(const std::optional<FrameStyle>& style);

/// Returns the frame of the scene that samples on a mesh are written to: the axis that frames keep
/// to if they keep to one, else that of --up, else y for a mesh of glTF, else as a picture guesses;
/// nothing for formats that hold no scene.
std::optional<SceneFrame> scene_frame(const OutputOptions& options, const MeshOptions& of_mesh,
                                      const MeshInput& mesh);

/// Returns where and how to write samples in that frame.
SampleTarget target_in(const OutputOptions& options, const std::optional<SceneFrame>& frame);

/// Returns a line for people, and the frame for programs; "" and null without one.
std::string scene_line(const std::optional<SceneFrame>& frame);
Json scene_json(const std::optional<SceneFrame>& frame);

} // namespace geodisk::tools
