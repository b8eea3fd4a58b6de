// Views of a scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "geometry/up.hpp"
#include "picture/scene.hpp"

namespace geodisk::tools::picture {

using tools::Up;

/// A direction to look from, in degrees.
struct View {
    double azimuth = 0;   ///< Around the axis that points up; 0 is the front, 90 the right side.
    double elevation = 0; ///< Above the horizon, -90 to 90.
};

/// The views that have names: "auto", "front" and so on.
std::vector<std::string> named_views();

/// A view as the command line names it: "front", "back", "left", "right", "top", "bottom" or
/// "AZIMUTH,ELEVATION" in degrees; none for "auto". Throws UserError(usage) naming `option`.
std::optional<View> parse_view(const std::string& option, const std::string& text);

/// "x", "y" or "z". Throws UserError(usage) naming `option`.
Up parse_up(const std::string& option, const std::string& text);

/// Returns the axis that is up if nobody says: y or z, whichever a surface clearly stands on; else
/// z for one flat along it, as terrain is, and y for all others.
Up likely_up(const Scene& scene);

/// Views to choose from: from the front and a little above, as most things are shown.
std::vector<View> views_to_try();

/// The direction that the axis points in.
glm::dvec3 direction_of(Up up);

/// Returns the direction of the eye, seen from the middle of the scene; of length 1.
glm::dvec3 direction_of(View view, Up up);

/// Direction that light comes from: so far to the right, up, and towards the eye.
inline constexpr glm::dvec3 kLight{-0.45, 0.65, 0.75};

struct Camera {
    glm::mat4 to_clip; ///< y goes down, depth from 0 to 1.
    glm::vec3 eye;
    glm::vec3 light; ///< Direction that light comes from; of length 1.
};

/// Shows all of the scene in a frame that is `aspect` times as wide as it is high.
Camera make_camera(const Scene& scene, View view, Up up, double aspect);

/// The part (x, y) to (x + width, y + height) of what `to_clip` shows, each from 0 to 1, y down.
glm::mat4 crop(const glm::mat4& to_clip, double x, double y, double width, double height);

} // namespace geodisk::tools::picture
