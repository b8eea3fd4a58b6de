// Report of `geodisk report`: in its page, to people and to programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geodisk/page_content.hpp"
#include "geodisk/reports/analysis_report.hpp"
#include "geodisk/reports/json_type.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/spectrum_run.hpp"
#include "picture/view.hpp"

namespace geodisk::tools {

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
