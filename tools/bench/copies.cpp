#include "bench/copies.hpp"

#include <cstddef>
#include <utility>

#include <geodisk/domain.hpp>

#include "bench/measure.hpp"
#include "bench/statistics.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::bench {
namespace {

using tools::take;

/// All copies as parts of one mesh that touch nowhere.
tools::MeshFile merged(const tools::MeshFile& mesh, std::uint32_t copies) {
    tools::MeshFile all;
    all.dimension = mesh.dimension;
    const std::size_t vertices = mesh.positions.size() / mesh.dimension;
    for (std::uint32_t i = 0; i < copies; ++i) {
        const auto first = static_cast<std::uint32_t>(i * vertices);
        all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
        all.lengths.insert(all.lengths.end(), mesh.lengths.begin(), mesh.lengths.end());
        for (const std::uint32_t vertex : mesh.triangles) {
            all.triangles.push_back(first + vertex);
        }
    }
    return all;
}

/// The copies of a mesh at a count.
class Copies {
  public:
    Copies(Runner& runner, const NamedMesh& mesh, std::uint32_t copies, double count,
           std::uint64_t seed)
        : runner_(runner), one_(prepare_mesh(mesh.name, mesh.file, 1)),
          all_(prepare_mesh(mesh.name, merged(mesh.file, copies), 1)),
          params_(params_for(one_, count, seed)) {
        for (std::uint32_t i = 0; i < copies; ++i) {
            parts_.push_back({&one_.prepared, params_});
            parts_.back().params.seed += i;
        }
    }

    /// Samples in all.
    std::uint64_t check() {
        const Domain domain = take(Domain::surfaces(parts_));
        const SampleSet set = take(runner_.sample_and_wait(domain));
        std::vector<std::vector<Sample>> found(parts_.size());
        for (Sample sample : set.samples) {
            const std::uint32_t part = sample.face / one_.prepared.face_count();
            sample.face -= domain.first_faces()[part];
            found[part].push_back(sample);
        }
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!is_same(found[i], run(i).samples)) {
                throw tools::UserError(tools::ExitCode::internal,
                                       one_.name + ": copy " + std::to_string(i) +
                                           " gets other samples in a job with others");
            }
        }
        return set.samples.size();
    }

    double one_by_one() {
        const tools::Stopwatch watch;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            run(i);
        }
        return watch.seconds();
    }

    double one_job() {
        const tools::Stopwatch watch;
        take(runner_.sample_and_wait(take(Domain::surfaces(parts_))));
        return watch.seconds();
    }

    double one_mesh() {
        const tools::Stopwatch watch;
        take(runner_.sample_and_wait(all_.prepared, params_));
        return watch.seconds();
    }

    std::uint64_t triangles() const { return all_.prepared.face_count(); }

  private:
    static bool is_same(const std::vector<Sample>& a, const std::vector<Sample>& b) {
        bool same = a.size() == b.size();
        for (std::size_t i = 0; same && i < a.size(); ++i) {
            same = a[i].face == b[i].face && a[i].weights[1] == b[i].weights[1] &&
                   a[i].weights[2] == b[i].weights[2];
        }
        return same;
    }

    SampleSet run(std::size_t i) {
        tools::check_interrupted();
        return take(runner_.sample_and_wait(one_.prepared, parts_[i].params));
    }

    Runner& runner_;
    BenchMesh one_, all_;
    SampleParams params_;
    std::vector<SurfacePart> parts_;
};

} // namespace

void run_copies(Runner& runner, const Options& options, const std::vector<NamedMesh>& meshes,
                const std::function<void(const CopiesRow&)>& on_row) {
    for (const NamedMesh& mesh : meshes) {
        for (const double count : options.counts) {
            Copies copies(runner, mesh, options.copies, count, options.seed);
            CopiesRow row{mesh.name, copies.triangles(), copies.check(), {}};
            std::vector<double> one_by_one, one_job, one_mesh;
            for (int i = -options.warm_ups; i < options.repeats; ++i) {
                tools::check_interrupted();
                const double seconds[] = {copies.one_by_one(), copies.one_job(), copies.one_mesh()};
                if (i >= 0) {
                    one_by_one.push_back(seconds[0]);
                    one_job.push_back(seconds[1]);
                    one_mesh.push_back(seconds[2]);
                }
            }
            row.seconds = {median(std::move(one_by_one)), median(std::move(one_job)),
                           median(std::move(one_mesh))};
            on_row(row);
        }
    }
}

} // namespace geodisk::bench
