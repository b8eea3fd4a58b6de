// Report of `geodisk sample` about a run: to people, to programs, and in the sample file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/job_frame.hpp>
#include <geodisk/levels.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/dry_run.hpp"
#include "geodisk/farthest_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/scene_frame.hpp"
#include "geodisk/picture_run.hpp"
#include "geodisk/reports/json_type.hpp"
#include "geodisk/reports/run_report.hpp"
#include "geometry/mesh_parts.hpp"

namespace geodisk::tools {

/// Summary of rows that are divided among processes.
struct AllRows {
    std::size_t count;
    std::uint64_t digest;
    RadiusRange radii;
};

/// Result of a job.
struct SampleResult {
    SampleParams params; ///< Parameters of the job, on its mesh.
    /// Frame of the run, if the mesh and the distance of the report may not say it.
    std::optional<JobFrame> frame;
    DeviceRun done;
    std::vector<SampleRow> rows;         ///< None where `all` is given.
    std::optional<AllRows> all;          ///< Set if rows are divided among processes.
    std::size_t existing = 0;            ///< Number of rows that existed before: the first.
    SpacingResult among_existing;        ///< Their pairs.
    std::size_t avoided = 0;             ///< Number of points to avoid.
    double avoided_length = 0;           ///< Length of lines to avoid.
    std::vector<std::uint32_t> classes;  ///< Classes of the rows; 0 if there are none.
    std::vector<std::uint32_t> features; ///< FeatureKind of the rows.
    std::size_t feature_corners = 0;     ///< Corners that may have samples.
    double feature_length = 0;           ///< Length of the curves.
    std::optional<FarthestRun> farthest; ///< Run of --order farthest; `rows` are in its order.
    std::optional<Levels> levels; ///< Levels of --order progressive; they end at `done.ends`.
    BareParts bare;
    std::vector<MeshWarning> warnings;
    std::optional<DrawnPicture> picture;
    std::optional<SceneFrame> scene; ///< Frame of the samples, in formats that hold one.

    std::size_t count() const { return all ? all->count : rows.size(); }
    std::string digest() const;
};

/// Returns the report of --dry-run about a job.
std::string dry_sample_json(const SampleJob& job, const MeshInput& mesh, const DryRun& dry);
std::string dry_sample_text(const SampleJob& job, const MeshInput& mesh, const DryRun& dry);

/// Tells of a job, its mesh and its result, which must outlive the report.
class SampleReport {
  public:
    SampleReport(const SampleJob& job, const MeshInput& mesh, const SampleResult& result);

    /// Nothing in it depends on when or how fast the run was, so equal runs give equal files.
    SampleHeader header() const;

    /// One JSON object and a line break. Writing the samples took `write_seconds`.
    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;

    /// The same with stages of another name after the samples were read back.
    Json document(const SecondsByStage& after) const;
    std::string summary(const SecondsByStage& after) const;

    /// Returns the time of every stage, with `after` at the end.
    SecondsByStage seconds(const SecondsByStage& after) const;

  private:
    Drawn drawn() const;
    /// Returns true if a run over the mesh, at the distance in the header, is decided alike.
    bool is_told(const JobFrame& frame, double distance) const;

    const SampleJob& job_;
    const MeshInput& mesh_;
    const SampleResult& result_;
    std::size_t samples_; ///< Number of samples of the run, before --keep.
    double rho_;        ///< Packing density; if radii vary, that of the samples on a surface of the
                        ///< effective area.
    RadiusRange radii_; ///< Radii of the samples.
};

} // namespace geodisk::tools
