#include "geodisk/options/render_options.hpp"

#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::uint32_t parse_side(const std::string& text, std::string_view side) {
    using picture::PictureParams;
    const auto pixels = parse_integer<std::uint32_t>(side);
    if (!pixels || *pixels < PictureParams::kFewestPixels || *pixels > PictureParams::kMaxPixels) {
        fail_usage("--size takes WIDTHxHEIGHT, each of " +
                   std::to_string(PictureParams::kFewestPixels) + " to " +
                   std::to_string(PictureParams::kMaxPixels) + " pixels, not " + in_quotes(text));
    }
    return *pixels;
}

} // namespace

std::optional<picture::Up> UpOption::parsed() const {
    return axis.empty() ? std::nullopt : std::optional(picture::parse_up("--up", axis));
}

void add_up_option(Command command, UpOption& option) {
    command
        .add_option("--up", option.axis, "AXIS",
                    "Axis that points up: x, y or z (default: guess from the mesh)")
        .offers({"x", "y", "z"});
}

void add_render_options(Command command, RenderOptions& options) {
    add_mesh_argument(command, options.mesh,
                      "Mesh that the samples were made on; or, without SAMPLES,\n"
                      "samples of geodisk box in 2 or 3 dimensions");
    command.add_option("SAMPLES", options.samples, "", help_of_input("Samples to show"));
    add_tolerance_option(command, options.tolerance);
    add_output_argument(command, options.out, "Picture to write: *.png");
    command.add_option("--size", options.size, "WxH", "Size of the picture in pixels")
        .shows_default();
    command
        .add_option("--style", options.style, "STYLE",
                    "auto      disks; points if disks are under 14 pixels wide\n"
                    "disks     geodesic disk of each sample, with its radius;\n"
                    "          overlaps are orange\n"
                    "points    samples only\n"
                    "voronoi   geodesic Voronoi cell of each sample\n"
                    "distance  distance to the nearest sample; orange where\n"
                    "          another sample would fit\n"
                    "density   samples per area, from dark blue (few) to yellow\n"
                    "          (many): cividis, safe for colour-blind people")
        .offers({"auto", "disks", "points", "voronoi", "distance", "density"})
        .shows_default();
    command
        .add_option("--view", options.views, "VIEW",
                    "Direction of view: front, back, left, right, top, bottom,\n"
                    "AZIMUTH,ELEVATION in degrees, or auto for the one that\n"
                    "shows most; give several for several views")
        .offers(picture::named_views())
        .takes_one_value();
    add_up_option(command, options.up);
    command
        .add_option("--background", options.background, "COLOR",
                    "white, black, transparent or RRGGBB")
        .offers({"white", "black", "transparent"})
        .shows_default();
    command.add_flag("--legend", options.legend,
                     "Add a legend below each view: samples, distance, scale bar,\n"
                     "and a colour bar for --style distance and density");
    command.add_flag("--cut", options.cuts,
                     "Cut the nearest eighth out of a box of 3 dimensions, and\n"
                     "show the cut through the balls");
    add_distance_options(command, options.distance);
    add_mesh_options(command, options.mesh);
    add_json_option(command, options.out);
    add_quiet_option(command, options.out);
    add_device_options(command, options.device);
}

picture::PictureParams parse_picture(const RenderOptions& options) {
    picture::PictureParams params;
    const std::size_t by = options.size.find('x');
    const std::string_view size = options.size;
    params.width = parse_side(options.size, size.substr(0, by));
    params.height = parse_side(options.size, by == std::string::npos ? "" : size.substr(by + 1));
    params.style = picture::parse_style("--style", options.style);
    params.background = picture::parse_background("--background", options.background);
    params.cuts = options.cuts;
    params.legend = options.legend;
    params.up = options.up.parsed();
    if (!options.views.empty()) {
        params.views.clear();
        for (const std::string& view : options.views) {
            params.views.push_back(picture::parse_view("--view", view));
        }
    }
    return params;
}

} // namespace geodisk::tools
