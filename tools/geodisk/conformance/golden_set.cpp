#include "geodisk/conformance/golden_set.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include <geodisk/domain.hpp>

#include "files/samples/fingerprint.hpp"
#include "files/text_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/box_options.hpp"
#include "geodisk/sample_run.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/program.hpp"

namespace geodisk::tools {
namespace {

using namespace std::literals;
#include "golden_sets.hpp"

/// The options of a job: those of `sample`, with one mesh or several, or those of `box`.
struct JobOptions {
    std::vector<std::string> meshes;
    SampleOptions sample;
    BoxOptions box;
};

std::vector<std::string> words_in(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
        words.push_back(word);
    }
    return words;
}

JobOptions parsed(const std::string& job) {
    JobOptions options;
    const auto set_up = [&](Command app) {
        const Command sample = app.add_command("sample", "");
        add_mesh_arguments(sample, options.meshes, "");
        add_subject_options(sample, options.sample);
        add_limit_options(sample, options.sample.run);
        sample.calls([&] { options.sample.mesh.mesh = options.meshes.front(); });
        const Command box = app.add_command("box", "");
        add_box_options(box, options.box);
        add_seed_option(box, options.box.run);
        box.calls([&] {});
    };
    run_arguments(set_up, words_in(job));
    return options;
}

std::vector<GoldenSet> sets_in(const std::string& text, const Path& path) {
    std::vector<GoldenSet> sets;
    std::istringstream lines(text);
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (trimmed(line).empty() || line.front() == '#') {
            continue;
        }
        std::istringstream fields(line);
        GoldenSet& set = sets.emplace_back();
        if (!(fields >> set.fingerprint >> set.samples >> std::ws) ||
            !std::getline(fields, set.job)) {
            fail_input(path, "line " + std::to_string(number) +
                                 ": is not a fingerprint, a number of samples and a job");
        }
    }
    if (sets.empty()) {
        fail_input(path, "has no sets");
    }
    return sets;
}

FoundSet found(const std::string& fingerprint, std::uint64_t samples, const DeviceRun& done) {
    return {fingerprint, samples, done.run.chunks, done.run.seconds.sample, {}};
}

FoundSet find_on_surface(const SampleJob& job, RunDevice& device, ProgressLine& progress) {
    const MeshInput mesh = load_silently(job.mesh, progress, job.density, job.mask);
    const SampleResult result = sample_mesh(job, mesh, device, progress);
    return found(fingerprint_of(result.rows), result.rows.size(), result.done);
}

/// Several meshes in one job, each by the same options.
FoundSet find_on_surfaces(const SampleJob& job, std::span<const std::string> names,
                          RunDevice& device, ProgressLine& progress) {
    std::vector<MeshInput> meshes;
    for (const std::string& name : names) {
        MeshOptions options = job.mesh;
        options.mesh = name;
        meshes.push_back(load_silently(options, progress, job.density, job.mask));
    }
    std::vector<SurfacePart> parts;
    double expected = 0;
    for (const MeshInput& mesh : meshes) {
        SurfacePart part{&mesh.prepared, mesh.with_fields(job.params)};
        part.params.min_distance = distance_on_mesh(*job.min_distance, mesh.prepared.statistics());
        expected +=
            expected_count(effective_area(mesh.prepared, part.params), part.params.min_distance);
        parts.push_back(part);
    }
    const double distance = parts.front().params.min_distance;
    const auto step_at = [&](double) -> Result<RequestStep> {
        auto domain = Domain::surfaces(parts);
        if (!domain) {
            return domain.error();
        }
        RequestStep step{std::move(*domain)};
        step.params.min_distance = distance;
        step.expected = expected;
        return step;
    };
    const auto [result, done] = device.run(take(RequestRun::create(step_at, distance)), progress);
    const std::vector<Sample>& samples = result.set.samples;
    std::vector<SampleRow> rows;
    for (const Sample& sample : samples) {
        SampleRow row;
        row.face = sample.face;
        std::copy_n(sample.weights, 3, row.bary);
        rows.push_back(row);
    }
    return found(fingerprint_of(rows), rows.size(), done);
}

FoundSet find_in_box(const BoxJob& job, RunDevice& device, ProgressLine& progress) {
    const auto [result, done] = device.run(job.request(), progress);
    const std::vector<double>& points = result.set.points;
    return found(fingerprint_of(points), points.size() / job.box.extents.size(), done);
}

FoundSet find(const std::string& text, const DeviceOptions& options, RunDevice& device,
              ProgressLine& progress) {
    const JobOptions given = parsed(text);
    if (given.meshes.empty()) {
        return find_in_box(parse_job(given.box), device, progress);
    }
    const SampleJob job = parse_job(given.sample);
    std::optional<RunDevice> bounded; // Memory is given to a runner once and for all.
    if (job.runner.device_bytes != 0) {
        bounded.emplace(options, job.runner);
    }
    RunDevice& used = bounded ? *bounded : device;
    return given.meshes.size() == 1 ? find_on_surface(job, used, progress)
                                    : find_on_surfaces(job, given.meshes, used, progress);
}

} // namespace

std::vector<GoldenSet> golden_sets() {
    std::string text;
    for (const std::string_view piece : kTexts[0].text) {
        text += piece;
    }
    return sets_in(text, "golden_sets.txt");
}

std::vector<GoldenSet> read_sets(const Path& path) {
    return sets_in(read_text(path), path);
}

FoundSet find_set(const GoldenSet& set, const DeviceOptions& options, RunDevice& device,
                  ProgressLine& progress) {
    device.open(progress);
    try {
        return find(set.job, options, device, progress);
    } catch (const UserError& error) {
        check_interrupted();
        FoundSet failed;
        failed.error = error.what();
        return failed;
    }
}

} // namespace geodisk::tools
