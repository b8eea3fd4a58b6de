#include "geodisk/options/verify_options.hpp"

#include <optional>

#include "files/input_file.hpp"
#include "files/samples/sample_format.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/method_options.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// A single file must be one of samples in a box, which has nothing of a surface.
void check_box(const VerifyOptions& options) {
    const auto format = find_format(options.mesh.mesh);
    const bool may_be_samples =
        format && facts_of(*format).read != nullptr && format != SampleFormat::obj;
    if (!may_be_samples && options.mesh.mesh != "-") {
        fail_usage("SAMPLES is required, except for samples in a box, which need no mesh");
    }
    if (!options.mesh.additions().empty() || options.density.is_given() ||
        options.mask.is_given() || options.constraints.is_given() || !options.classes.empty() ||
        options.is_maximal) {
        fail_usage(
            "options for surfaces need MESH and SAMPLES; a single file must hold samples in a box");
    }
}

void check_class_options(const VerifyOptions& options) {
    const ClassTable classes = parse_classes(options.classes);
    const std::optional<DensitySource> radii = options.density.source();
    GivenFields given;
    given.add(RequestField::class_factors, "--classes", !classes.factors().empty());
    given.add(RequestField::radii, radii ? radii->option : "", radii.has_value());
    given.check();
    if (!classes.distances.empty() && !options.min_distance.empty()) {
        fail_usage("the table of --classes has all distances, so it takes no --min-distance");
    }
}

} // namespace

std::vector<NamedFile> VerifyOptions::files_read() const {
    std::vector<NamedFile> read{{"the samples", samples}};
    mesh.add_files(read, "the mesh");
    density.add_files(read, "the density");
    mask.add_files(read);
    constraints.add_files(read);
    add_class_file(classes, read);
    return read;
}

void VerifyOptions::check() const {
    if (!min_distance.empty()) {
        parse_length("--min-distance", min_distance);
    }
    check_tolerance(tolerance);
    mask.check(kMaxClasses); // The file tells how many there are.
    constraints.parsed_avoid();
    check_class_options(*this);
    if (samples.empty()) {
        check_box(*this);
    }
}

void add_verify_options(Command command, VerifyOptions& options) {
    add_mesh_argument(command, options.mesh,
                      "Mesh that the samples were made on; or, without SAMPLES,\n"
                      "samples of geodisk box");
    command.add_option("SAMPLES", options.samples, "", help_of_input("Samples to check"));
    command.add_option("-d,--min-distance", options.min_distance, "D",
                       "Minimum distance along the surface, in mesh units or % of the\n"
                       "bounding-box diagonal (default: radii in the file, else the\n"
                       "distance in its header, else none: report the smallest)");
    command.add_flag("--maximal", options.is_maximal,
                     "Check that no further sample fits, and report the largest gap");
    add_avoid_option(command, options.constraints, OptionUse::checking);
    add_class_option(command, options.classes, OptionUse::checking);
    add_tolerance_option(command, options.tolerance);
    add_mesh_options(command, options.mesh);
    add_density_options(command, options.density, OptionUse::checking);
    add_mask_options(command, options.mask, OptionUse::checking);
    add_json_option(command, options.out);
    add_quiet_option(command, options.out, "No progress, no result; only the exit status");
}

} // namespace geodisk::tools
