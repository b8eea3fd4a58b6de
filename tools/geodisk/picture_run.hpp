// Pictures made on a device, for the commands that draw.
#pragma once

#include <string>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/mesh.hpp>

#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "picture/picture.hpp"
#include "picture/scene.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// A picture, what it shows, and how long that took.
struct DrawnPicture {
    picture::Picture picture;
    std::size_t samples = 0;
    std::size_t windows = 0;
    double window_seconds = 0, draw_seconds = 0;
};

struct PictureSubject;

/// Throws UserError(usage) for what is no *.png, UserError(bad_output) for what cannot be written.
void check_picture_path(const Path& path);

/// Throws UserError(bad_input) for a mesh of edge lengths alone, read from `path`.
void check_visible(const std::string& path, const MeshInput& mesh);

/// Returns what is drawn of the surface of `mesh`, read by `options`.
picture::Scene make_scene(const MeshOptions& options, const MeshInput& mesh);

/// Draws a surface with a disk for each sample, at least one, each as large as its radius in mesh
/// units, on a device that can draw. Throws UserError.
DrawnPicture draw_surface(const Context& context, const picture::PictureParams& params,
                          const PreparedMesh& mesh, const picture::Scene& scene,
                          std::vector<SurfaceDisk> disks, ProgressLine& progress);

/// Draws a surface as `options` ask for, and writes the picture. Throws UserError.
void render_surface(const RenderOptions& options, const picture::PictureParams& params,
                    const PictureSubject& subject, const PreparedMesh& mesh,
                    const picture::Scene& scene, std::vector<SurfaceDisk> disks,
                    ProgressLine& progress);

/// The same of what needs no windows.
void render_content(const RenderOptions& options, const picture::PictureParams& params,
                    const PictureSubject& subject, const picture::Content& content,
                    ProgressLine& progress);

} // namespace geodisk::tools
