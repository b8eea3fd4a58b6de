#include "bench/sweep.hpp"

#include <cmath>
#include <utility>

#include "bench/subdivision.hpp"
#include "files/meshes/mesh_file.hpp"

namespace geodisk::bench {
namespace {

/// The exponents that make sense for `sweep`, which is one; those of samples from the count of
/// least time on.
std::vector<Growth> fit_growth(Sweep sweep, const std::vector<Measurement>& rows) {
    std::vector<Point> device;
    std::vector<Point> reference;
    std::vector<Point> prepare;
    for (const Measurement& row : rows) {
        const double x =
            static_cast<double>(sweep == Sweep::triangles ? row.triangles : row.samples);
        device.push_back({x, row.seconds.device});
        reference.push_back({x, row.seconds.reference});
        prepare.push_back({x, row.seconds.prepare});
    }
    if (sweep == Sweep::samples) {
        return {{"device", fit_rise(device)}, {"reference", fit_rise(reference)}};
    }
    return {{"device", fit_power_law(device)},
            {"reference", fit_power_law(reference)},
            {"prepare", fit_power_law(prepare)}};
}

class Sweeper {
  public:
    Sweeper(Runner& runner, const Options& options, const Observer& observer)
        : runner_(runner), options_(options), observer_(observer) {}

    void run(const NamedMesh& mesh) {
        vary_samples(mesh);
        if (options_.scaling) {
            vary_triangles(mesh);
        }
    }

    std::vector<Series> take_series() && { return std::move(series_); }

  private:
    void add_row(const BenchMesh& mesh, double count) {
        Series& series = series_.back();
        series.rows.push_back(
            measure(runner_, mesh, count, options_.seed, {options_.warm_ups, options_.repeats}));
        observer_.on_row(series.rows.back());
    }

    void begin(Sweep sweep, const std::string& name) {
        series_.emplace_back();
        series_.back().sweep = sweep;
        series_.back().mesh = name;
    }

    void end() {
        Series& series = series_.back();
        if (series.sweep != Sweep::listed) {
            series.growth = fit_growth(series.sweep, series.rows);
        }
        observer_.on_series(series);
    }

    void vary_samples(const NamedMesh& source) {
        begin(options_.scaling ? Sweep::samples : Sweep::listed, source.name);
        const BenchMesh mesh = prepare_mesh(source.name, source.file, options_.repeats);
        for (const double count : options_.counts) {
            add_row(mesh, count);
        }
        end();
    }

    void vary_triangles(const NamedMesh& source) {
        begin(Sweep::triangles, source.name);
        for (const std::uint32_t parts :
             edge_parts(source.file.triangles.size() / 3, options_.max_faces)) {
            add_row(prepare_mesh(source.name, subdivide(source.file, parts), options_.repeats),
                    options_.face_sweep_count);
        }
        end();
    }

    Runner& runner_;
    const Options& options_;
    const Observer& observer_;
    std::vector<Series> series_;
};

} // namespace

const char* to_string(Sweep sweep) {
    switch (sweep) {
    case Sweep::samples:
        return "samples";
    case Sweep::triangles:
        return "triangles";
    default:
        return "listed";
    }
}

std::vector<NamedMesh> read_meshes(const std::vector<std::string>& paths) {
    std::vector<NamedMesh> meshes;
    meshes.reserve(paths.size());
    for (const std::string& path : paths) {
        meshes.push_back({path.substr(path.find_last_of('/') + 1), tools::read_mesh(path)});
    }
    return meshes;
}

std::vector<Series> run_all(Runner& runner, const Options& options,
                            const std::vector<NamedMesh>& meshes, const Observer& observer) {
    Sweeper sweeper(runner, options, observer);
    for (const NamedMesh& mesh : meshes) {
        sweeper.run(mesh);
    }
    return std::move(sweeper).take_series();
}

std::vector<std::uint32_t> edge_parts(std::uint64_t faces, std::uint64_t max_faces) {
    constexpr int kSteps = 6;
    const double most = std::sqrt(static_cast<double>(max_faces) / static_cast<double>(faces));
    std::vector<std::uint32_t> parts{1};
    for (int step = 1; step <= kSteps; ++step) {
        // The summand keeps whole ratios whole.
        const double exact = std::pow(most, static_cast<double>(step) / kSteps) + 1e-9;
        if (exact >= parts.back() + 1.0) {
            parts.push_back(static_cast<std::uint32_t>(exact));
        }
    }
    return parts;
}

} // namespace geodisk::bench
