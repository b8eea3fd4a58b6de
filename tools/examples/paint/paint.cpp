// Paints on a mesh, while its samples follow. A stroke of the brush makes samples denser under it,
// or takes them away, and Updater decides only what it reaches. Prints the time of each stroke, and
// checks at the end that the samples are those of a whole run.
//
//   paint radii|mask [MESH.obj [SAMPLES]]
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/update.hpp>

namespace {

constexpr int kStrokes = 10;
constexpr double kPaintedArea = 0.01; // Of the mesh, by a stroke.
constexpr double kDenseFactor = 0.7;  // Of the radius, in the middle of a stroke.

[[noreturn]] void fail(const std::string& message) {
    std::fprintf(stderr, "paint: %s\n", message.c_str());
    std::exit(EXIT_FAILURE);
}

template <class T>
T take(geodisk::Result<T> result) {
    if (!result) {
        fail(result.error().message);
    }
    return std::move(*result);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Mesh {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;

    std::size_t face_count() const { return triangles.size() / 3; }
    std::array<double, 3> vertex(std::uint32_t index) const {
        const std::size_t first = std::size_t{3} * index;
        return {positions[first], positions[first + 1], positions[first + 2]};
    }
    /// Keeps seams: to look for them takes time linear in the mesh, for each edit.
    geodisk::MeshView view() const { return {positions, triangles, 3, true}; }
};

Mesh read_obj(const char* path) {
    std::ifstream file(path);
    Mesh mesh;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            for (int axis = 0; axis < 3; ++axis) {
                mesh.positions.push_back(0);
                words >> mesh.positions.back();
            }
        } else if (word == "f") {
            for (int corner = 0; corner < 3 && words >> word; ++corner) {
                const unsigned long number = std::strtoul(word.c_str(), nullptr, 10);
                mesh.triangles.push_back(static_cast<std::uint32_t>(number - 1));
            }
        }
    }
    if (mesh.triangles.empty()) {
        fail(std::string(path) + " has no triangles");
    }
    return mesh;
}

Mesh make_torus(std::uint32_t around, std::uint32_t across) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            const double u = 6.283185307179586 * i / around, v = 6.283185307179586 * k / across;
            const double out = 1 + 0.4 * std::cos(v);
            mesh.positions.insert(mesh.positions.end(),
                                  {out * std::cos(u), out * std::sin(u), 0.4 * std::sin(v)});
            const std::uint32_t i1 = (i + 1) % around, k1 = (k + 1) % across;
            const std::uint32_t a = i * across + k, b = i1 * across + k, c = i1 * across + k1,
                                d = i * across + k1;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
        }
    }
    return mesh;
}

// Canvas of what is painted: a factor of the radius per vertex, or whether faces take samples.
class Canvas {
  public:
    Canvas(const Mesh& mesh, const geodisk::PreparedMesh& prepared, bool paints_radii)
        : mesh_(mesh), prepared_(prepared), paints_radii_(paints_radii),
          factors_(mesh.positions.size() / 3, 1), mask_(mesh.face_count(), 1),
          radii_(take(geodisk::RadiusField::prepare(prepared, factors_))) {}

    // Paints around a corner of a face, and returns the faces that this changes. An engine finds
    // those under its brush by a tree; this program looks at all.
    std::vector<std::uint32_t> stroke(std::uint32_t face, double radius, bool adds) {
        const std::array<double, 3> middle = mesh_.vertex(mesh_.triangles[3 * face]);
        std::vector<bool> is_painted(factors_.size(), false);
        for (std::uint32_t v = 0; v < factors_.size(); ++v) {
            const std::array<double, 3> at = mesh_.vertex(v);
            const double part =
                std::hypot(at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]) / radius;
            if (part < 1) {
                is_painted[v] = true;
                factors_[v] =
                    adds ? std::min(factors_[v], kDenseFactor + (1 - kDenseFactor) * part) : 1;
            }
        }
        std::vector<std::uint32_t> changed;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            const std::uint32_t* const corners = &mesh_.triangles[std::size_t{3} * f];
            const auto painted =
                std::count_if(corners, corners + 3, [&](std::uint32_t v) { return is_painted[v]; });
            if (painted == 3 || (paints_radii_ && painted > 0)) {
                changed.push_back(f);
                mask_[f] = adds ? 1 : 0;
            }
        }
        return changed;
    }

    // Sets what is painted in the parameters, which refer to this.
    void apply(geodisk::SampleParams& params) {
        if (paints_radii_) {
            radii_ = take(geodisk::RadiusField::prepare(prepared_, factors_));
            params.radii = &radii_;
        } else {
            params.face_mask = mask_;
        }
    }

  private:
    const Mesh& mesh_;
    const geodisk::PreparedMesh& prepared_;
    bool paints_radii_;
    std::vector<double> factors_;
    std::vector<std::uint8_t> mask_;
    geodisk::RadiusField radii_;
};

bool is_equal(std::span<const geodisk::Sample> a, std::span<const geodisk::Sample> b) {
    return std::ranges::equal(a, b, [](const geodisk::Sample& x, const geodisk::Sample& y) {
        return x.face == y.face && std::ranges::equal(x.weights, y.weights);
    });
}

void paint(const Mesh& mesh, double count, bool paints_radii) {
    const auto prepared = take(geodisk::PreparedMesh::prepare(mesh.view()));
    Canvas canvas(mesh, prepared, paints_radii);
    geodisk::SampleParams params;
    const double area = prepared.statistics().area;
    params.min_distance = geodisk::distance_for_count(area, count);
    canvas.apply(params);
    const auto frame = take(geodisk::frame_of(prepared, params));

    const auto context = take(geodisk::Context::create());
    auto runner = take(geodisk::Runner::create(context.device(), context.queue()));
    const auto set = take(runner.sample_and_wait(prepared, params));
    auto updater = take(geodisk::Updater::create(mesh.view(), params, frame, set.samples));
    std::printf("%zu faces, %zu samples\n", mesh.face_count(), set.samples.size());

    std::mt19937 random(1);
    std::vector<double> times;
    for (int i = 0; i <= kStrokes; ++i) {
        const auto face = static_cast<std::uint32_t>(random() % mesh.face_count());
        const double radius = std::sqrt(kPaintedArea * area / 3.141592653589793);
        const auto changed = canvas.stroke(face, radius, paints_radii ? i % 3 != 2 : i % 3 == 2);
        auto start = std::chrono::steady_clock::now();
        canvas.apply(params);
        const double painting_seconds = seconds_since(start);
        start = std::chrono::steady_clock::now();
        const auto report = take(updater.update(runner, mesh.view(), params, changed));
        const double seconds = seconds_since(start);
        std::printf("stroke %d: %zu faces, %u samples gone, %u new, %.1f ms + %.1f ms to paint%s\n",
                    i, changed.size(), report.removed, report.added, 1000 * seconds,
                    1000 * painting_seconds, i == 0 ? " (compiles shaders)" : "");
        if (i > 0) {
            times.push_back(seconds);
        }
    }

    const auto start = std::chrono::steady_clock::now();
    const auto whole = take(
        runner.sample_and_wait(take(geodisk::Domain::surface(prepared, params, updater.frame()))));
    const double seconds = seconds_since(start);
    if (!is_equal(updater.samples(), whole.samples)) {
        fail("the samples are not those of a whole run");
    }
    std::ranges::sort(times);
    std::printf("%zu samples, as of a whole run, which takes %.1f ms; a stroke takes %.1f ms\n",
                whole.samples.size(), 1000 * seconds, 1000 * times[times.size() / 2]);
}

} // namespace

int main(int argc, char** argv) {
    const bool paints_radii = argc > 1 && std::strcmp(argv[1], "radii") == 0;
    if (argc < 2 || argc > 4 || !(paints_radii || std::strcmp(argv[1], "mask") == 0)) {
        std::fprintf(stderr, "usage: paint radii|mask [MESH.obj [SAMPLES]]\n");
        return 2;
    }
    paint(argc > 2 ? read_obj(argv[2]) : make_torus(256, 96),
          argc > 3 ? std::strtod(argv[3], nullptr) : 5000, paints_radii);
}
