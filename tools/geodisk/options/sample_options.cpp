#include "geodisk/options/sample_options.hpp"

#include <utility>
#include <vector>

#include "files/meshes/part_columns.hpp"
#include "files/meshes/value_fields.hpp"
#include "geodisk/options/wall_options.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

constexpr std::optional<Metric> kMetrics[] = {std::nullopt, Metric::euclidean, Metric::approximate};

std::vector<std::string> metric_names() {
    std::vector<std::string> names;
    for (const std::optional<Metric>& metric : kMetrics) {
        names.push_back(metric_name(metric));
    }
    return names;
}

std::optional<Metric> parse_metric(const std::string& name) {
    for (const std::optional<Metric>& metric : kMetrics) {
        if (metric_name(metric) == name) {
            return metric;
        }
    }
    fail_choice("--metric", name, metric_names());
}

/// Straight lines need the space that lengths and lifts do without.
void check_metric(const SampleOptions& options, const SampleJob& job) {
    if (job.is_geodesic()) {
        return;
    }
    for (const auto& [name, value] : options.mesh.additions()) {
        const bool is_kept = name == "weld" || name == "keep_seams" || name == "mesh_format";
        if (!is_kept) {
            fail_usage("--metric " + options.metric +
                       " goes by the coordinates of the mesh file, so it takes no --" + name);
        }
    }
}

/// Takes the classes, and their largest distance if a table has it that no count scales.
void take_classes(const SampleOptions& options, SampleJob& job) {
    if (!job.classes.is_given()) {
        return;
    }
    job.classes_option = options.classes;
    job.class_factors = job.classes.factors();
    if (!job.classes.distances.empty() && (options.count.empty() || job.method.throws_darts)) {
        job.min_distance = Length{job.classes.largest(), false};
    }
}

/// Checks the mesh and the samples before an edit. Samples of other kinds are not updated.
void check_edit_options(const SampleOptions& options) {
    if (options.from.empty()) {
        if (!options.update.empty()) {
            fail_usage("--update needs the mesh of the samples; add --from OLD_MESH");
        }
        return;
    }
    const std::pair<const char*, bool> refused[] = {
        {"--avoid", !options.constraints.avoid.empty()},
        {"--lift", !options.mesh.lifts.empty()},
        {"--edge-lengths", !options.mesh.edge_lengths.empty()},
        {"--coordinates", !options.mesh.coordinates.empty()},
        {"--dry-run", options.out.is_dry_run},
    };
    for (const auto& [name, is_given] : refused) {
        if (is_given) {
            fail_usage(std::string("--from takes no ") + name);
        }
    }
}

/// Checks that the distance is given once.
void check_distance(const SampleOptions& options, const ClassTable& classes) {
    if (classes.distances.empty()) {
        check_one_distance(options.method, {{"--min-distance", options.min_distance},
                                            {"--radius", options.radius},
                                            {"--count", options.count}});
        return;
    }
    for (const auto& [name, value] :
         {std::pair{"--min-distance", &options.min_distance}, {"--radius", &options.radius}}) {
        if (!value->empty()) {
            fail_usage(std::string("the table of --classes has all distances, so it takes no ") +
                       name);
        }
    }
}

} // namespace

GivenFields given_fields(const SampleOptions& options, const ClassTable& classes) {
    using Field = RequestField;
    const std::string metric = "--metric " + options.metric;
    const std::optional<DensitySource> radii = options.density.source();
    GivenFields given = given_fields(options.method, options.count);
    given.add(Field::class_factors, "--classes", !classes.factors().empty());
    given.add(Field::radii, radii ? radii->option : "", radii.has_value());
    given.add(Field::density, "--density", options.density.is_density());
    given.add(Field::existing, "--existing", !options.constraints.existing.empty());
    given.add(Field::avoid, "--avoid", !options.constraints.avoid.empty());
    given.add(Field::features, "--features", !options.features.empty());
    given.add(Field::at_vertices, "--at-vertices", options.at_vertices);
    given.add(Field::metric, metric, parse_metric(options.metric).has_value());
    given.add(Field::update, "--from", !options.from.empty());
    return given;
}

void place_files(SampleOptions& options,
                 const std::function<std::string(const std::string&)>& place) {
    for (std::string* const path :
         {&options.mesh.mesh, &options.mesh.coordinates, &options.mesh.edge_lengths}) {
        *path = path->empty() ? "" : place(*path);
    }
    if (!options.out.record.image().empty()) {
        options.out.record.texture = place(options.out.record.texture);
    }
    options.out.record.attributes = with_files_at(options.out.record.attributes, place);
    if (!options.density.given().empty()) {
        options.density.place_files(place);
    }
    place_wall_files(options.mesh.walls, place);
    options.mask.place_files(place);
    options.constraints.place_files(place);
    place_class_file(options.classes, place);
}

std::string metric_name(const std::optional<Metric>& metric) {
    return !metric ? "geodesic" : *metric == Metric::euclidean ? "euclidean" : "approximate";
}

SampleJob parse_job(const SampleOptions& options) {
    SampleJob job;
    static_cast<SampleInputs&>(job) = options;
    job.columns = parse_part_columns(options.out.columns);
    if (!job.columns.empty() && !job.out.output.empty()) {
        check_columns(job.out.target(), job.columns);
    }
    job.mesh.fields = options.out.record.fields();
    job.mesh.texture = options.out.record.image();
    const bool has_record =
        job.out.record.frame_style().has_value() || !job.out.record.entries().empty();
    if (!job.out.output.empty() && has_record) {
        job.out.record.check(job.out.target());
    }
    job.out.check_scene(!options.picture.empty());
    job.metric = parse_metric(options.metric);
    if (job.legend && job.picture.empty()) {
        fail_usage("--legend is for pictures; add --picture FILE");
    }
    job.classes = parse_classes(options.classes);
    given_fields(options, job.classes).check();
    job.method = parse_method(options.method, options.count);
    job.params = job.method.params;
    job.params.darts = 0; // Those that are to be thrown follow from the surface.
    check_class_counts(job.method, job.classes.count);
    take_classes(options, job);
    if (!options.features.empty()) {
        job.features = parse_ratio("--features", options.features, 1, 180);
    }
    job.at_vertices = options.at_vertices;
    if (options.at_vertices && (options.method.is_dense || !options.method.pool_ratio.empty())) {
        fail_usage(std::string(options.method.is_dense ? "--dense" : "--pool-ratio") +
                   " is for candidates that are drawn; --at-vertices has the vertices");
    }
    check_distance(options, job.classes);
    if (!options.min_distance.empty()) {
        job.min_distance = parse_length("--min-distance", options.min_distance);
    } else if (!options.radius.empty()) {
        job.min_distance = parse_length("--radius", options.radius);
        job.min_distance->value *= 2;
    }
    job.wanted_count =
        parse_wanted_count(options.method, options.count, job.method.params.pool_ratio);
    job.params.seed = options.run.parsed_seed();
    job.runner = options.run.runner();
    if (job.method.has_levels && job.out.is_dry_run) {
        fail_usage("--dry-run tries one run, but --order progressive takes one for each level");
    }
    if (job.method.is_farthest && job.out.is_dry_run) {
        fail_usage("--dry-run estimates the sampling alone, so it takes no --order farthest");
    }
    check_metric(options, job);
    check_edit_options(options);
    job.constraints.check();
    job.constraints.check_classes(job.classes.count);
    job.mesh.parsed_lifts(); // Wrong ones are known before a mesh is read.
    job.mesh.weld_distance();
    wall_rules(job.mesh.walls);
    job.density.is_given();
    job.mask.check(job.classes.count);
    job.mask.class_count = job.classes.count;
    return job;
}

void add_sample_options(Command command, SampleOptions& options, const std::string& unnamed) {
    add_output_or_dry_run(command, options.out, help_of_output() + unnamed);
    add_job_options(command, options);
    command.add_option("--from", options.from, "OLD_MESH",
                       "Sample the mesh as an edit of OLD_MESH: with the distance and\n"
                       "the tolerances that follow from it",
                       "Edits");
    command.add_option("--update", options.update, "OLD_SAMPLES",
                       "Start from the samples of OLD_MESH, and decide only what the\n"
                       "edit can reach. The samples are those without --update",
                       "Edits");
    command.add_option("--picture", options.picture, "FILE",
                       "Also draw the samples and their disks, to *.png; geodisk render\n"
                       "has more styles and views");
    command.add_flag("--legend", options.legend,
                     "Add a legend to the picture: samples, distance, scale bar");
    add_output_options(command, options.out);
    add_columns_options(command, options.out);
    add_verbose_option(command, options.run.device);
}

void add_subject_options(Command command, SampleOptions& options) {
    const char* const distance = "Distance, give one";
    command.add_option("-d,--min-distance", options.min_distance, "D",
                       "Minimum distance along the surface, in mesh units,\n"
                       "or with % of the bounding-box diagonal",
                       distance);
    command.add_option("-r,--radius", options.radius, "R",
                       "Half the minimum distance; the largest one if radii vary", distance);
    command.add_option("-n,--count", options.count, "N",
                       "Choose the distance that should give about N samples;\n"
                       "with --method darts, stop at exactly N. A,B,...: with darts\n"
                       "and --classes, a number for each class",
                       distance);
    add_exact_option(command, options.method, distance);

    add_mesh_options(command, options.mesh);
    add_density_options(command, options.density, OptionUse::sampling);
    add_mask_options(command, options.mask, OptionUse::sampling);
    add_constraint_options(command, options.constraints);
    add_class_option(command, options.classes, OptionUse::sampling, "Constraints");
    command.add_option("--features", options.features, "ANGLE",
                       "Sample corners first, then edges where faces meet at more than\n"
                       "ANGLE degrees (1 to 180; 30 suits most CAD models), borders and\n"
                       "edges of more than two faces, then faces. The column feature is\n"
                       "2, 1 and 0",
                       "Constraints");
    command.add_flag("--at-vertices", options.at_vertices,
                     "Sample at vertices alone: each is a candidate, drawn by its share\n"
                     "of the area. The column vertex has its number, from 0",
                     "Constraints");

    command
        .add_option("--metric", options.metric, "NAME",
                    "geodesic: exact, along the surface. For comparison only:\n"
                    "euclidean: straight line through space; approximate:\n"
                    "closed form from normals (Bowers et al. 2010)")
        .offers(metric_names())
        .shows_default();
    add_method_options(command, options.method, "the surface");
    add_order_options(command, options.method);
    add_seed_option(command, options.run);
}

void add_job_options(Command command, SampleOptions& options) {
    add_subject_options(command, options);
    add_device_options(command, options.run.device);
    add_limit_options(command, options.run);
}

} // namespace geodisk::tools
