// The options of `geodisk report`.
#pragma once

#include <string>
#include <vector>

#include "geodisk/options/sample_options.hpp"
#include "geodisk/options/up_option.hpp"
#include "picture/view.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct ReportOptions {
    SampleOptions sample; ///< Its output is the page.
    std::string probes, view = "auto";
    UpOption up;
    std::string harmonics; ///< Harmonics of the spectrum; "" for none.

    /// The views to choose the first one from. Throws UserError(usage).
    std::vector<picture::View> first_views() const;
};

/// Adds all options of the command; `options` must outlive the parsing.
void add_report_options(Command command, ReportOptions& options);

} // namespace geodisk::tools
