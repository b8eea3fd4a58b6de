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
    if (!pixels || *pixels < PictureParams::kFewestPixels || *pixels > PictureParams::kMostPixels) {
        fail_usage("--size takes WIDTHxHEIGHT, each of " +
                   std::to_string(PictureParams::kFewestPixels) + " to " +
                   std::to_string(PictureParams::kMostPixels) + " pixels, not " + in_quotes(text));
    }
    return *pixels;
}

} // namespace

void add_render_options(Command command, RenderOptions& options) {
    add_mesh_argument(command, options.mesh,
                      "Mesh that the samples were made on; or, alone, the samples\n"
                      "of geodisk box, of 2 or 3 dimensions");
    command.add_option("SAMPLES", options.samples, "",
                       "Samples to show: *.ply, *.csv or *.pcd, or points of another\nprogram, "
                       "also *.obj and *.xyz");
    add_tolerance_option(command, options.tolerance);
    add_output_argument(command, options.out, "Picture to write: *.png");
    command.add_option("--size", options.size, "WxH", "Pixels of the picture").shows_default();
    command
        .add_option("--style", options.style, "STYLE",
                    "auto      disks, or points where disks would be less than\n"
                    "          14 pixels wide\n"
                    "disks     the geodesic disk of each sample, of its radius;\n"
                    "          where two overlap, orange\n"
                    "points    the samples\n"
                    "voronoi   the places that are nearest to each sample\n"
                    "distance  how far the nearest sample is; where another one\n"
                    "          would have room, orange\n"
                    "density   how dense they are, dark blue for few, yellow for\n"
                    "          many: cividis, whose lightness grows evenly and\n"
                    "          which colour-blind people see alike")
        .offers({"auto", "disks", "points", "voronoi", "distance", "density"})
        .shows_default();
    command
        .add_option("--view", options.views, "VIEW",
                    "Where to look from: front, back, left, right, top, bottom,\n"
                    "AZIMUTH,ELEVATION in degrees, or auto for where most is\n"
                    "seen from; several make a sheet")
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
                     "Of a box of 3 dimensions, cut away the eighth nearest to\n"
                     "the eye, and show sections of balls");
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
