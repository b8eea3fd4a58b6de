#include "paper/painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "picture/box_frame.hpp"
#include "picture/flat_box.hpp"
#include "picture/scene.hpp"
#include "picture/surface_content.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {
namespace {

using tools::SurfaceDisk;

void tell(double) {
    tools::check_interrupted();
}

} // namespace

Pixels Painter::surface(const PaperMesh& mesh, std::vector<SurfaceDisk> disks,
                        const PictureParams& params) const {
    const tools::picture::Scene scene =
        tools::picture::make_scene(mesh.file.positions, mesh.file.dimension, mesh.file.triangles);
    const auto [table, samples] =
        tools::picture::make_surface_content(mesh.prepared, std::move(disks), params.style, tell);
    return tools::picture::draw_picture(gpu_, {scene, table, samples}, params, tell).pixels;
}

Pixels Painter::samples(const BoxParams& box, const SampleSet& set, PictureParams params) const {
    const double radius = box.min_distance / 2;
    const std::size_t dimension = box.extents.size();
    params.up = tools::picture::Up::y;
    if (dimension == 2) {
        const tools::picture::FlatBox flat(box);
        std::vector<SurfaceDisk> disks;
        for (std::size_t i = 0; i < set.points.size(); i += dimension) {
            disks.push_back(flat.disk(set.points[i], set.points[i + 1], radius));
        }
        const tools::picture::Scene scene =
            tools::picture::make_scene(flat.positions(), 2, flat.triangles());
        const auto [table, samples] =
            tools::picture::make_surface_content(flat.mesh(), std::move(disks), params.style, tell);
        params.views = {tools::picture::View{0, 0}};
        return tools::picture::draw_picture(gpu_, {scene, table, samples}, params, tell).pixels;
    }
    const tools::picture::BoxFrame frame(box, radius);
    std::vector<tools::picture::BallRec> balls;
    for (std::size_t i = 0; i < set.points.size(); i += dimension) {
        const std::array<double, 3> at{set.points[i], set.points[i + 1], set.points[i + 2]};
        balls.push_back(frame.ball(at, radius, tools::picture::color_of(balls.size())));
    }
    params.views = {tools::picture::View{30, 20}};
    return tools::picture::draw_picture(gpu_, {frame.scene(), frame.table(), {}, balls}, params,
                                        tell)
        .pixels;
}

std::vector<SurfaceDisk> disks_of(const std::vector<ref::FacePoint<double>>& samples,
                                  double min_distance) {
    std::vector<SurfaceDisk> disks;
    disks.reserve(samples.size());
    for (const auto& [face, weight1, weight2] : samples) {
        disks.push_back({face, weight1, weight2, min_distance / 2});
    }
    return disks;
}

PictureParams square_panel(const PanelSize& size) {
    PictureParams panel;
    panel.width = panel.height = size.pixels();
    panel.style = tools::picture::Style::disks;
    return panel;
}

Pixels side_by_side(const std::vector<Pixels>& pictures) {
    constexpr std::size_t kChannels = 4;
    Pixels sheet;
    for (const Pixels& picture : pictures) {
        sheet.width += picture.width;
        sheet.height = std::max(sheet.height, picture.height);
    }
    sheet.rgba.assign(kChannels * sheet.width * sheet.height, 255);
    std::size_t left = 0;
    for (const Pixels& picture : pictures) {
        const std::size_t row_bytes = kChannels * picture.width;
        for (std::size_t row = 0; row < picture.height; ++row) {
            std::copy_n(&picture.rgba[row * row_bytes], row_bytes,
                        &sheet.rgba[kChannels * (row * sheet.width + left)]);
        }
        left += picture.width;
    }
    return sheet;
}

} // namespace geodisk::paper
