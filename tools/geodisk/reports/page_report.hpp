// Report of `geodisk report`: in its page, to people and to programs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/surface_statistics.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/analysis_report.hpp"
#include "geodisk/reports/json_type.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/spectrum_run.hpp"
#include "geometry/surface_disk.hpp"
#include "picture/view.hpp"
#include "report/disk_data.hpp"
#include "report/page_array.hpp"

namespace geodisk::tools {

/// Content of the page: a mesh and its samples.
struct PageContent {
    std::vector<report::PageArray> arrays;
    std::vector<std::string> left_out; ///< Content that is not shown, and why, in sentences.
    bool has_surface = false;
    std::optional<report::DiskScale> disks; ///< Scale of the disks, if they are shown.
    std::size_t windows = 0;                ///< Number of windows of all disks.
    picture::Up up = picture::Up::y;
};

/// The surface with these disks, one for each sample. `up` is what points up, if it was given. What
/// a browser could not draw is left out. Throws UserError.
PageContent make_page_content(const MeshInput& mesh, const SampleDisks& samples,
                              std::span<const analysis::Neighbor> neighbors,
                              std::optional<picture::Up> up, ProgressLine& progress);

/// Parts that a page was made of.
struct PageResult {
    SetAnalysis set;
    PageContent content;
    std::vector<picture::View> views; ///< To choose the first one from.
    std::string command;              ///< As a line for a shell.
    std::optional<SpectrumRun> spectrum;
    double measure_seconds = 0, disk_seconds = 0;
    double all_seconds = 0; ///< From the start to the writing of the page.
};

/// Tells of samples and their page, which must outlive the report.
class PageReport {
  public:
    PageReport(const SampleReport& samples, const PageResult& result)
        : samples_(samples), result_(result) {}

    /// Returns the facts on the page: a JSON object.
    std::string facts() const;

    /// Once the page is written; that took `write_seconds`.
    std::string json(double write_seconds) const;
    std::string summary(double write_seconds) const;

  private:
    SecondsByStage stages() const;
    SecondsByStage stages(double write_seconds) const;
    Json document(const SecondsByStage& after) const;

    const SampleReport& samples_;
    const PageResult& result_;
};

} // namespace geodisk::tools
