// The options of `geodisk render`, and the picture that they ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "picture/picture.hpp"
#include "picture/view.hpp"

namespace geodisk::tools {

/// Axis that points up in pictures, as given on the command line.
struct UpOption {
    std::string axis; ///< "" where a picture chooses.

    /// Throws UserError(usage) naming the option.
    std::optional<picture::Up> parsed() const;
};

/// Adds --up.
void add_up_option(Command command, UpOption& option);

/// As given on the command line.
struct RenderOptions {
    MeshOptions mesh; ///< Or the samples in a box, where there are no others.
    std::string samples, tolerance;
    OutputOptions out;
    DeviceOptions device;
    std::string size = "1920x1080", style = "auto", background = "white";
    UpOption up;
    DistanceOptions distance;
    std::vector<std::string> views;
    bool cuts = false, legend = false;
};

/// Adds all options of the command; `options` must outlive the parsing.
void add_render_options(Command command, RenderOptions& options);

/// The picture that is asked for. Throws UserError(usage).
picture::PictureParams parse_picture(const RenderOptions& options);

} // namespace geodisk::tools
