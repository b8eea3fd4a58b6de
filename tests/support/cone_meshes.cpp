#include "support/cone_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace geodisk::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// The rim with every point lifted by `tilt` plus and minus `zigzag` in turns, in radians.
std::vector<Vec3> lifted_rim(std::uint32_t sectors, double tilt, double zigzag) {
    std::vector<Vec3> rim;
    for (std::uint32_t i = 0; i < sectors; ++i) {
        const double around = 2 * kPi * i / sectors;
        const double up = tilt + (i % 2 == 0 ? zigzag : -zigzag);
        rim.push_back(
            {std::cos(around) * std::cos(up), std::sin(around) * std::cos(up), std::sin(up)});
    }
    return rim;
}

double angle_between(Vec3 a, Vec3 b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

double angle_sum(const std::vector<Vec3>& rim) {
    double sum = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        sum += angle_between(rim[i], rim[(i + 1) % rim.size()]);
    }
    return sum;
}

} // namespace

Cone::Cone(std::uint32_t sectors, double angle, double zigzag, int subdivisions) : angle_(angle) {
    // Tilting narrows the cone and a zigzag widens it: bisect whichever reaches the angle.
    const bool by_tilt = angle_sum(lifted_rim(sectors, 0, zigzag)) >= angle;
    double low = 0;
    double high = kPi / 2;
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        const double sum = angle_sum(by_tilt ? lifted_rim(sectors, middle, zigzag)
                                             : lifted_rim(sectors, 0, middle));
        ((sum > angle) == by_tilt ? low : high) = middle;
    }
    rim_ = by_tilt ? lifted_rim(sectors, low, zigzag) : lifted_rim(sectors, 0, low);
    if (std::abs(angle_sum(rim_) - angle) > 1e-9) {
        throw std::runtime_error("no such cone: too many folds for the angle, or too few sectors");
    }
    TestMesh coarse;
    coarse.add_vertex({0, 0, 0});
    for (const Vec3& p : rim_) {
        coarse.add_vertex(p);
    }
    for (std::uint32_t i = 0; i < sectors; ++i) {
        coarse.add_triangle(0, 1 + i, 1 + (i + 1) % sectors);
    }
    mesh_ = subdivided(coarse, subdivisions);
    faces_per_sector_ = 1u << (2 * subdivisions);
}

Cone::Polar Cone::polar(const Point& p) const {
    const std::uint32_t sector = p.face / faces_per_sector_;
    const Vec3 at = mesh_.position(p);
    const double start = angle_ * sector / static_cast<double>(rim_.size());
    return {length(at), length(at) > 0 ? start + angle_between(rim_[sector], at) : 0};
}

double Cone::distance(const Point& a, const Point& b) const {
    const Polar p = polar(a);
    const Polar q = polar(b);
    const double turn = std::abs(p.angle - q.angle);
    const double apart = std::min(turn, angle_ - turn);
    if (apart >= kPi) {
        return p.radius + q.radius;
    }
    const double half = std::sin(apart / 2);
    return std::sqrt((p.radius - q.radius) * (p.radius - q.radius) +
                     4 * p.radius * q.radius * half * half);
}

} // namespace geodisk::test
