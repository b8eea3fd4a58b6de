#include "geodisk/search_progress.hpp"

#include "geodisk/outputs/outputs.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"
#include "program/time_estimate.hpp"

namespace geodisk::tools {
namespace {

// Less of a search says little of how long the rest takes.
constexpr double kEarly = 0.02;

} // namespace

ProgressCallback search_progress(ProgressLine& progress, const std::string& found) {
    return [&progress, found, watch = Stopwatch(),
            time = TimeEstimate(kEarly)](const Progress& state) mutable {
        const double part = static_cast<double>(state.decided) / state.candidates;
        time.note(watch.seconds(), part);
        if (const auto seconds = time.long_run()) {
            progress.clear();
            print_warning("searching takes about " + seconds_text(*seconds) + " on this device");
        }
        progress.update(part, grouped(state.accepted) + ' ' + found + time.left_text());
        return !is_interrupted();
    };
}

} // namespace geodisk::tools
