#include "picture/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools::picture {
namespace {

/// Half the angle that the longer side of a picture takes.
constexpr double kHalfAngle = 12;
/// Margin on each side, as a part of the frame.
constexpr double kMargin = 0.03;
/// Flatter along z than this part of the other extents, a surface is taken for terrain.
constexpr double kFlat = 0.5;
/// So near to an end of the surface, as a part of its extent, faces are of the end.
constexpr double kEnd = 0.01;
/// Faces of an end are within this cosine of its direction.
constexpr double kLevel = 0.9;
/// Minimum area that a surface stands on, as a part of its area, and as a multiple of what it would
/// stand on if another axis were up.
constexpr double kMinBase = 0.01;
constexpr double kClearBase = 3;

constexpr std::pair<const char*, View> kNamed[] = {{"front", {0, 0}},  {"back", {180, 0}},
                                                   {"left", {-90, 0}}, {"right", {90, 0}},
                                                   {"top", {0, 90}},   {"bottom", {0, -90}}};

/// Axes of the picture's world: right, up, and towards the front.
struct Axes {
    glm::dvec3 right, up, front;
};

Axes axes_of(Up up) {
    switch (up) {
    case Up::x:
        return {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
    case Up::z:
        return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    default:
        return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    }
}

/// The axes of the camera; front is towards the eye.
Axes look_from(View view, Up up) {
    const Axes world = axes_of(up);
    const double azimuth = glm::radians(view.azimuth);
    const double elevation = glm::radians(view.elevation);
    const glm::dvec3 level = std::sin(azimuth) * world.right + std::cos(azimuth) * world.front;
    const glm::dvec3 front = std::cos(elevation) * level + std::sin(elevation) * world.up;
    const glm::dvec3 right = std::cos(azimuth) * world.right - std::sin(azimuth) * world.front;
    return {right, glm::cross(front, right), front};
}

/// Least and largest of a quantity over all corners.
template <class Of>
std::pair<double, double> range_of(const Scene& scene, const Of& of) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < scene.corners.size(); ++i) {
        const double x = of(scene.corner(i));
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return {low, high};
}

double extent_along(const Scene& scene, int axis) {
    const auto [low, high] = range_of(scene, [axis](glm::dvec3 p) { return p[axis]; });
    return high - low;
}

/// Returns the base of the surface if the axis is up: how much more of its area is level at the
/// lower end than at the upper one, as a part of all.
double base_along(const Scene& scene, int axis) {
    const auto [low, high] = range_of(scene, [axis](glm::dvec3 p) { return p[axis]; });
    const double near = kEnd * (high - low);
    double all = 0, base = 0;
    for (std::size_t i = 0; i + 3 <= scene.corners.size(); i += 3) {
        const glm::dvec3 corners[] = {scene.corner(i), scene.corner(i + 1), scene.corner(i + 2)};
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double area = glm::length(normal);
        all += area;
        if (std::abs(normal[axis]) < kLevel * area) {
            continue;
        }
        const auto is_within = [&](double from, double to) {
            return std::all_of(std::begin(corners), std::end(corners),
                               [&](glm::dvec3 p) { return p[axis] >= from && p[axis] <= to; });
        };
        base += is_within(low, low + near) ? area : is_within(high - near, high) ? -area : 0;
    }
    return all > 0 ? base / all : 0;
}

/// Position of the eye along `axis`, for a half angle of tangent `t`, and its distance from the
/// origin, so that everything lies between two planes through it.
struct Fit {
    double shift, distance;
};

Fit fit(const Scene& scene, glm::dvec3 axis, glm::dvec3 front, double t) {
    const auto above =
        range_of(scene, [&](glm::dvec3 p) { return glm::dot(p, axis) + t * glm::dot(p, front); });
    const auto below =
        range_of(scene, [&](glm::dvec3 p) { return glm::dot(p, axis) - t * glm::dot(p, front); });
    return {(above.second + below.first) / 2,
            (above.second - below.first) / (2 * t) + scene.around * std::sqrt(1 + 1 / (t * t))};
}

} // namespace

std::vector<std::string> named_views() {
    std::vector<std::string> names{"auto"};
    for (const auto& [name, view] : kNamed) {
        names.emplace_back(name);
    }
    return names;
}

std::optional<View> parse_view(const std::string& option, const std::string& text) {
    if (text == "auto") {
        return std::nullopt;
    }
    for (const auto& [name, view] : kNamed) {
        if (text == name) {
            return view;
        }
    }
    const std::size_t comma = text.find(',');
    if (comma != std::string::npos) {
        const auto azimuth = parse_real(trimmed(text.substr(0, comma)));
        const auto elevation = parse_real(trimmed(text.substr(comma + 1)));
        if (azimuth && elevation && std::abs(*azimuth) <= 360 && std::abs(*elevation) <= 90) {
            return View{*azimuth, *elevation};
        }
    }
    fail_usage(option +
               " takes auto, front, back, left, right, top, bottom or "
               "AZIMUTH,ELEVATION in degrees, such as 30,20; not " +
               in_quotes(text) + did_you_mean(text, named_views()));
}

Up parse_up(const std::string& option, const std::string& text) {
    if (const auto up = find_up(text)) {
        return *up;
    }
    fail_usage(option + " takes x, y or z, not " + in_quotes(text));
}

Up likely_up(const Scene& scene) {
    const double along_y = base_along(scene, 1);
    const double along_z = base_along(scene, 2);
    if (along_y > kMinBase && along_y > kClearBase * along_z) {
        return Up::y;
    }
    if (along_z > kMinBase && along_z > kClearBase * along_y) {
        return Up::z;
    }
    const double flat = kFlat * std::min(extent_along(scene, 0), extent_along(scene, 1));
    return extent_along(scene, 2) < flat ? Up::z : Up::y;
}

std::vector<View> views_to_try() {
    std::vector<View> views;
    for (const double elevation : {12.0, 28.0}) {
        for (double azimuth = -75; azimuth <= 75; azimuth += 25) {
            views.push_back({azimuth, elevation});
        }
    }
    return views;
}

glm::dvec3 direction_of(Up up) {
    return axes_of(up).up;
}

glm::dvec3 direction_of(View view, Up up) {
    return look_from(view, up).front;
}

Camera make_camera(const Scene& scene, View view, Up up, double aspect) {
    const Axes axes = look_from(view, up);
    const double t = std::tan(glm::radians(kHalfAngle));
    const double t_right = aspect >= 1 ? t : t * aspect;
    const double t_up = t_right / aspect;
    const double inner = 1 - 2 * kMargin;
    const Fit across = fit(scene, axes.right, axes.front, t_right * inner);
    const Fit along = fit(scene, axes.up, axes.front, t_up * inner);
    const double distance = std::max(across.distance, along.distance);
    const glm::dvec3 middle = across.shift * axes.right + along.shift * axes.up;
    const auto [back, front] =
        range_of(scene, [&](glm::dvec3 p) { return glm::dot(p, axes.front); });
    const double pad = 1e-3 * (1 + front - back) + scene.around;
    const double near = std::max(distance - front - pad, 1e-3 * distance);
    const double far = distance - back + pad;

    glm::dmat4 clip =
        glm::frustumRH_ZO(-t_right * near, t_right * near, -t_up * near, t_up * near, near, far);
    clip[1] = -clip[1]; // Vulkan's y goes down.
    const glm::dvec3 eye = middle + distance * axes.front;
    const glm::dmat4 to_eye = glm::lookAtRH(eye, middle, axes.up);
    return {glm::mat4(clip * to_eye), glm::vec3(eye),
            glm::vec3(glm::normalize(kLight.x * axes.right + kLight.y * axes.up +
                                     kLight.z * axes.front))};
}

glm::mat4 crop(const glm::mat4& to_clip, double x, double y, double width, double height) {
    glm::dmat4 part(1);
    part[0][0] = 1 / width;
    part[1][1] = 1 / height;
    part[3][0] = (1 - 2 * x - width) / width;
    part[3][1] = (1 - 2 * y - height) / height;
    return glm::mat4(part * glm::dmat4(to_clip));
}

} // namespace geodisk::tools::picture
