#include "geodisk/update_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <geodisk/params.hpp>
#include <geodisk/update.hpp>

#include "files/samples/fingerprint.hpp"
#include "files/samples/job_frame_text.hpp"
#include "files/samples/sample_columns.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/sample_run.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

MeshView view_of(const MeshInput& mesh) {
    return {mesh.file.positions, mesh.file.triangles, mesh.file.dimension, true};
}

MeshOptions options_of(const SampleJob& job) {
    MeshOptions options = job.mesh;
    options.mesh = job.from;
    return options;
}

/// Returns the error of a run, or throws UserError(bad_input) for one of input.
Error checked(const Error& error, const std::string& what) {
    if (error.status == Status::invalid_argument || error.status == Status::mesh_rejected) {
        fail_input(what, error.message);
    }
    return error;
}

/// Tells `progress`, which expects all samples of the surface, of those of a region in proportion.
ProgressCallback in_proportion(const ProgressCallback& progress, const JobFrame& frame) {
    return [&progress, all = frame.samples * frame.pool_ratio](const Progress& state) {
        const double scale = std::max(1.0, all / state.candidates);
        const auto scaled = [scale](std::uint64_t count) {
            return static_cast<std::uint64_t>(scale * static_cast<double>(count));
        };
        Progress shown = state;
        shown.accepted = static_cast<std::uint32_t>(scaled(state.accepted));
        shown.disks = static_cast<std::uint32_t>(scaled(state.disks));
        shown.windows = scaled(state.windows);
        return progress(shown);
    };
}

/// Returns the values of a key, one after the other.
std::string values_of(std::string_view key, const HeaderEntries& entries) {
    std::string text;
    for (const auto& [name, value] : entries) {
        if (name == key) {
            text += (text.empty() ? "" : ", ") + value;
        }
    }
    return text;
}

/// Checks that samples can follow from one mesh to the other.
void check_edit(const SampleJob& job, const MeshInput& before, const MeshInput& mesh) {
    const auto fail = [&](const std::string& what) {
        fail_input(job.mesh.mesh, what + "; sample it without --from");
    };
    if (mesh.dimension() != before.dimension()) {
        fail("has " + std::to_string(mesh.dimension()) + " coordinates per vertex, but " +
             job.from + " has " + std::to_string(before.dimension()));
    }
    if (before.radii && mesh.radii && before.radii->min_density() > 0 &&
        (before.radii->largest_density() != mesh.radii->largest_density() ||
         before.radii->min_density() != mesh.radii->min_density())) {
        fail("has another largest or least density than " + job.from +
             ", by which all radii go, so all of them change");
    }
}

/// Returns the frame in which samples of a mesh were decided: that of their header, or else that of
/// a run over the mesh at their distance.
JobFrame frame_of_samples(const SampleFile& file, const MeshInput& mesh, SampleParams params) {
    if (const std::string* const text = file.header.find(kJobFrame)) {
        return job_frame_of_text(*text, file.path);
    }
    params.min_distance = header_distance(file) / mesh.distance_part;
    return take(frame_of(mesh.prepared, params), file.path);
}

/// Checks that samples are of a kind that can be updated.
void check_kind(const SampleFile& file) {
    const SampleHeader& header = file.header;
    if (header.find("kept_of") != nullptr) {
        fail_input(file.path, "has just the first samples of --order farthest, so the others are "
                              "not known; give a file with all samples");
    }
    const std::pair<std::string_view, const char*> kinds[] = {
        {"darts", "--method darts"},
        {"classes", "--classes"},
        {"features", "--features"},
        {"at_vertices", "--at-vertices"},
        {kLevelDistances, "--order progressive"},
        {"order", "--order farthest"},
        {"maximal", "--maximal"},
        {"exact", "--count --exact"},
        {"avoid", "--avoid"},
        {"metric", "--metric"}};
    for (const auto& [key, option] : kinds) {
        if (header.find(key) != nullptr) {
            fail_input(file.path, std::string("has samples of ") + option +
                                      ", which cannot be updated; sample the mesh again");
        }
    }
    if (const std::string other = other_sampling_text(header); !other.empty()) {
        fail_input(file.path, other + "; sample the mesh again");
    }
    if (const std::string* const options = header.find("options")) {
        std::vector<std::string_view> names;
        split_tokens(*options, names);
        if (std::ranges::find(names, "selection") != names.end()) {
            fail_input(file.path,
                       "has only a selection of the samples of a run, made in Python, so the "
                       "others are not known; give a file with all samples");
        }
        fail_input(file.path, "was made in Python with " + *options +
                                  ", which cannot be updated; sample the mesh again");
    }
    if (!fits_digest(file)) {
        fail_input(file.path, std::string("has other samples than its digest is of: ") +
                                  kOtherRows + "; give the file as geodisk sample wrote it");
    }
}

/// Says whether a header tells this number.
template <class Number>
bool tells(const std::string& text, Number number) {
    if constexpr (std::is_floating_point_v<Number>) {
        return parse_real(text) == number;
    } else {
        return text == exact_text(+number); // No bool.
    }
}

/// Checks that the samples before are of this job, as far as their header tells.
void check_job(const SampleFile& file, const SampleJob& job, const MeshInput& before,
               const MeshInput& mesh, double min_distance) {
    if (file.header.find("min_distance") == nullptr || file.header.find("seed") == nullptr) {
        fail_input(job.update,
                   "does not say its seed and minimum distance, so it may not be whole; "
                   "give a file as geodisk sample writes it");
    }
    const auto fail = [&](std::string_view key, const std::string& is, const std::string& should) {
        const auto told = [](const std::string& text) { return text.empty() ? "none" : text; };
        fail_input(job.update, "has as its " + std::string(key) + " " + told(is) + ", not " +
                                   told(should) + "; give the options it was made with");
    };
    for (const char* const key :
         {"coordinates", "edge_lengths", "lift", "weld", "keep_seams", "walls", "density",
          "radius_factor", "radius_factor_floor", "mask", "only"}) {
        const std::string is = values_of(key, file.header.entries);
        const std::string should = values_of(key, mesh.additions);
        if (is != should) {
            fail(key, is, should);
        }
    }
    const std::string* const surface = file.header.find(kSurfaceDigest);
    if (surface != nullptr && trimmed(*surface) != surface_digest_text(before)) {
        fail_input(job.update, "was made with other walls, another mask or other radii, or "
                               "on another mesh, than the same options give on " +
                                   job.from + " now; give the files that they name as they were");
    }
    const SampleParams plain;
    HeaderEntries defaults;
    for_each_number(plain, [&](const char* name, auto value) {
        defaults.emplace_back(name, exact_text(+value));
    });
    for_each_number(job.params, [&](const char* name, auto value) {
        if (std::string_view(name) == "min_distance") { // It may be relative.
            return;
        }
        const std::string* const told = file.header.find(name);
        const std::string is = told != nullptr ? *told : values_of(name, defaults);
        if (!tells(is, value)) {
            fail(name, is, exact_text(+value));
        }
    });
    // Distances relative to the mesh may round in another way.
    const double of_file = header_distance(file);
    if (!(std::abs(of_file - min_distance) <= 1e-12 * min_distance)) {
        fail("minimum distance", exact_text(of_file), exact_text(min_distance));
    }
}

} // namespace

std::string edit_text(const SampleJob& job) {
    return job.mesh.mesh + " as an edit of " + job.from;
}

UpdateRun::UpdateRun(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress)
    : job_(job), mesh_(mesh),
      before_(load_mesh(options_of(job), progress, job.density, job.mask,
                        "--from takes the mesh before, --update its samples")),
      params_(params_on(before_, job)) {
    check_edit(job, before_, mesh_);
    if (before_.split) {
        fail_usage("--from: on " + job.from +
                   " the image shows more than the corners of faces; split "
                   "the faces where it has detail");
    }
    const JobFrame plain = take(frame_of(before_.prepared, params_));
    SampleParams edited = mesh_.with_fields(job.params);
    edited.min_distance = params_.min_distance;
    frame_ = take(frame_for_edit(plain, mesh_.prepared, edited), edit_text(job));
    if (job.update.empty()) {
        return;
    }
    if (frame_.unit < frame_.min_distance) {
        fail_usage("--update: the minimum distance exceeds " + job.from +
                   ", so an edit may change all samples; leave it out");
    }
    std::vector<MeshWarning> warnings;
    const SampleFile file = read_samples_silently_on(job.update, before_, "", warnings, progress);
    if (!file.has_faces) {
        fail_input(job.update, "has no faces and weights, so its samples cannot be updated; give "
                               "a file of geodisk with them");
    }
    check_kind(file);
    check_job(file, job, before_, mesh_,
              distance_on_mesh(*job.min_distance, before_.prepared.statistics()));
    print_warnings(warnings);
    if (!decide_alike(frame_of_samples(file, before_, params_), plain)) {
        decide_all(job.update + " was decided with other tolerances than a run over " + job.from +
                   " has");
        return;
    }
    if (!decide_alike(frame_, plain)) {
        decide_all("longer edges than " + job.from +
                   " has, or edges of more than two faces, need wider tolerances");
        return;
    }
    // Rows may be in another order.
    const auto marks = file.extra_values(kExistingColumn);
    const auto add = [&](bool is_given) {
        for (std::size_t i = 0; i < file.rows.size(); ++i) {
            if ((!marks.empty() && marks[i] == 1) == is_given) {
                samples_.push_back(sample_of(file.rows[i]));
            }
        }
    };
    add(true);
    const std::size_t existing = samples_.size();
    add(false);
    params_.existing = std::span(samples_).first(existing);
}

void UpdateRun::decide_all(const std::string& reason) {
    warning_ = {"all_decided", 1, "",
                reason + "; so all samples are decided again, as without --update", job_.mesh.mesh};
}

Result<SampleSet> UpdateRun::sample(Runner& runner, const RequestStep& step,
                                    const ProgressCallback& progress) {
    const SurfaceJob after{view_of(mesh_), step.params};
    auto updater = Updater::create({view_of(before_), params_}, after, frame_, samples_);
    if (!updater) {
        return checked(updater.error(), job_.update);
    }
    const auto report =
        updater->update(runner, after.mesh, after.params, {}, in_proportion(progress, frame_));
    if (!report) {
        return checked(report.error(), edit_text(job_));
    }
    SampleSet set;
    set.samples.assign(updater->samples().begin(), updater->samples().end());
    set.existing = updater->existing();
    set.report = report->run;
    return set;
}

} // namespace geodisk::tools
