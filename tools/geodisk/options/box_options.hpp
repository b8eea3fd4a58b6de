// The options of `geodisk box`, and the job that they ask for.
#pragma once

#include <string>

#include <geodisk/box.hpp>
#include <geodisk/request.hpp>
#include <geodisk/runner.hpp>

#include "geodisk/options/method_options.hpp"
#include "geodisk/options/run_options.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct BoxOptions {
    std::string dimension, min_distance, count, extents;
    bool is_periodic = false;
    MethodOptions method;
    OutputOptions out;
    RunOptions run;
};

/// Adds the options that say which box is sampled and how densely; `options` must outlive the
/// parsing.
void add_box_options(Command command, BoxOptions& options);

/// Job that the options ask for.
struct BoxJob {
    OutputOptions out;
    RunOptions run;
    BoxParams box;
    Method method;
    WantedCount wanted_count;
    RunnerOptions runner;

    /// Returns the runs that the job takes; it must outlive them. Throws UserError.
    RequestRun request() const;
};

/// Throws UserError(usage) for values out of range and options that contradict each other.
BoxJob parse_job(const BoxOptions& options);

/// Length of the diagonal.
double diagonal_of(const BoxParams& box);

} // namespace geodisk::tools
