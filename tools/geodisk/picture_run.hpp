// Pictures made on a device, for the commands that draw.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/context.hpp>
#include <geodisk/mesh.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/render_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json.hpp"
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
    std::string device; ///< Its name.
};

/// Opens a device that can draw.
using OpenContext = std::function<Context()>;

/// Subject of a picture, and the words of a report for it.
struct PictureSubject {
    std::string samples_file;
    std::string lines; ///< For people, but for the samples.
    Json json;         ///< For programs.
};

/// Throws UserError(usage) for what is no *.png, UserError(bad_output) for what cannot be written.
void check_picture_path(const Path& path);

/// Throws UserError(bad_input) for a mesh of edge lengths alone.
void check_visible(const MeshInput& mesh);

/// Returns what is drawn of the surface of `mesh`, read by `options`.
picture::Scene make_scene(const MeshOptions& options, const MeshInput& mesh);

/// Draws a surface with a disk for each sample, at least one, each as large as its radius in mesh
/// units, on a device that can draw. Throws UserError.
DrawnPicture draw_surface(const Context& context, const picture::PictureParams& params,
                          const PreparedMesh& mesh, const picture::Scene& scene,
                          std::vector<SurfaceDisk> disks, ProgressLine& progress);

/// Draws what needs no windows.
DrawnPicture draw_content(const Context& context, const picture::PictureParams& params,
                          const picture::Content& content, ProgressLine& progress);

/// Draws samples on a mesh as `options` ask for, on a device that is opened once all is checked.
/// Adds warnings without printing them. Throws UserError.
DrawnPicture draw_samples(const RenderOptions& options, const MeshInput& mesh,
                          const SampleFile& samples, std::vector<MeshWarning>& warnings,
                          const OpenContext& open, ProgressLine& progress);

/// The same of samples in a box, which their header tells.
DrawnPicture draw_box(const RenderOptions& options, const BoxParams& box, const SampleFile& samples,
                      const OpenContext& open, ProgressLine& progress);

/// Returns the box of samples to draw. Throws UserError for one that has not 2 or 3 dimensions.
BoxParams box_to_draw(const RenderOptions& options, const SampleFile& samples);

/// Writes a picture, and reports it as `options` ask for. Throws UserError.
void write_picture(const RenderOptions& options, const PictureSubject& subject,
                   const DrawnPicture& drawn, ProgressLine& progress);

} // namespace geodisk::tools
