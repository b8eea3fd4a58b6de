// The options of `geodisk sample` and of what else samples a mesh, and the job that they ask for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/options/class_options.hpp"
#include "geodisk/options/constraint_options.hpp"
#include "geodisk/options/density_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/method_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

/// Options that a job has as they are given.
struct SampleInputs {
    MeshOptions mesh;
    DensityOptions density;
    MaskOptions mask;
    ConstraintOptions constraints;
    OutputOptions out;
    RunOptions run;
    std::string picture; ///< File for one, or empty.
    bool legend = false; ///< On the picture.
    std::string from;    ///< Mesh before an edit, in whose frame this one is sampled; or "".
    std::string update;  ///< Its samples, or "".
};

/// As given on the command line.
struct SampleOptions : SampleInputs {
    MethodOptions method;
    std::string min_distance, radius, count;
    std::string classes, features;
    bool at_vertices = false;
    std::string metric = "geodesic";
};

/// Puts `place(name)` for each file that is read but those before an edit.
void place_files(SampleOptions& options,
                 const std::function<std::string(const std::string&)>& place);

/// Adds all options of the command but the mesh; `options` must outlive the parsing. `unnamed` says
/// which file is written without -o, if any may be.
void add_sample_options(Command command, SampleOptions& options, const std::string& unnamed = "");

/// `unnamed` for a file that is named by the mesh.
inline constexpr const char* kNamedByMesh = "\n(default NAME-samples.ply, which replaces no file)";

/// Adds those that say what is sampled besides the mesh file, and so hold all that the samples
/// depend on.
void add_subject_options(Command command, SampleOptions& options);

/// Adds those that say what is sampled and how, all but what is written of it.
void add_job_options(Command command, SampleOptions& options);

/// Job that is asked for, checked as far as that is possible without the mesh.
struct SampleJob : SampleInputs {
    ClassTable classes;
    std::string classes_option;     ///< As given.
    std::optional<double> features; ///< Degrees from which on edges are features.
    bool at_vertices = false;
    std::vector<float> class_factors; ///< SampleParams::class_factors.
    std::vector<std::string> columns; ///< Columns of the samples, besides those that all have.
    std::optional<Metric> metric;     ///< Through space; without it, distances are geodesic.
    Method method;
    std::optional<Length> min_distance; ///< Without it, wanted_count tells the distance.
    WantedCount wanted_count;
    SampleParams params; ///< All but the distance, radii, classes, darts and existing samples.
    RunnerOptions runner;

    bool is_geodesic() const { return !metric; }
};

/// Returns the fields of a request that the options set.
GivenFields given_fields(const SampleOptions& options, const ClassTable& classes);

/// Throws UserError(usage) for values out of range and options that contradict each other.
SampleJob parse_job(const SampleOptions& options);

/// The name of SampleJob::metric, as --metric takes it.
std::string metric_name(const std::optional<Metric>& metric);

} // namespace geodisk::tools
