// Operations of a session: the first process calls one, and all do it together.
//
// An operation is a row of Operations below: a function of a process and of what the first process
// gives, which is null on the others. It sends them what they need, by messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include <geodisk/checkpoint.hpp>
#include <geodisk/process_report.hpp>
#include <geodisk/request.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/status.hpp>

#include "geodisk/options/sample_options.hpp"
#include "ranged_rows.hpp"
#include "shared_pairs.hpp"

namespace geodisk::tools {

struct Process;

struct ReadCall {
    const SampleJob& job;
    std::uint32_t parts; ///< Number of parts of each process; 0 to let Processes choose.
};

/// Reads the mesh file of a job by all processes, each a range of it; from then on
/// sample_together() samples that surface. Returns the reason if the first process has to read the
/// whole. Throws SharedError(bad_input) if the file changes meanwhile.
std::optional<std::string> read_ranges(Process& process, const ReadCall* call);

/// Frees that surface.
Done forget_ranges(Process& process, const Done*);

struct SampleCall {
    Runner& runner;
    const RequestStep& step;
    const Checkpoints* checkpoints; ///< Null for a job without any.
    const ProgressCallback& progress;
};

/// Samples a surface. Errors: those of Processes::sample().
Result<SharedSamples> sample_together(Process& process, const SampleCall* call);

/// Numbers operations in their order.
template <auto... kWorks>
struct OperationRows {
    static constexpr std::uint8_t kCount = sizeof...(kWorks);

    template <auto kWork>
    static consteval std::uint8_t number() {
        constexpr std::array kIsIt = {std::is_same_v<Row<kWork>, Row<kWorks>>...};
        std::uint8_t number = 0;
        while (!kIsIt[number]) { // Ends at the latest behind the array, which does not compile.
            ++number;
        }
        return number;
    }
    /// Does an operation on all but the first process.
    static void help(std::uint8_t number, Process& process) {
        constexpr void (*kHelp[])(Process&) = {
            [](Process& other) { (void)kWorks(other, nullptr); }...};
        kHelp[number](process);
    }

  private:
    template <auto>
    struct Row {};
};

using Operations = OperationRows<read_ranges, forget_ranges, sample_together, make_ranged_rows,
                                 write_ranged_rows, note_together>;

} // namespace geodisk::tools
