// Pictures made on a device, for the commands that draw.
#pragma once

#include <string>
#include <vector>

#include <geodisk/mesh.hpp>

#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json.hpp"
#include "picture/picture.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// What a picture is of, and how a report tells of it.
struct Subject {
    std::string samples_file;
    std::string lines; ///< For people, but for the samples.
    Json json;         ///< For programs.
};

/// Throws UserError(usage) for what is no *.png, UserError(bad_output) for what cannot be written.
void check_picture_path(const Path& path);

/// Draws a surface with a disk for each sample, each as large as its radius in mesh units, and
/// writes the picture. Throws UserError.
void draw_surface(const RenderOptions& options, const picture::PictureParams& params,
                  const Subject& subject, const PreparedMesh& mesh, const picture::Scene& scene,
                  std::vector<SurfaceDisk> disks, ProgressLine& progress);

/// The same of what needs no windows.
void draw_content(const RenderOptions& options, const picture::PictureParams& params,
                  const Subject& subject, const picture::Content& content, ProgressLine& progress,
                  double window_seconds = 0);

} // namespace geodisk::tools
