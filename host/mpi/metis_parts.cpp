// Parts of a surface by METIS: cells of the graph of faces, which edges join.
#include <metis.h>

#include <algorithm>
#include <cmath>
#include <limits>

#ifndef _WIN32
#include <csignal>
#endif

#include "cut_surface.hpp"

namespace geodisk {
namespace {

// Weights are integers: so many in all.
constexpr double kWeight = 1u << 30;
// With fewer faces in each part, METIS has no good answer, or none.
constexpr std::uint32_t kMinFaces = 16;

/// Keeps SIGTERM for later. METIS replaces the handlers of SIGTERM and SIGABRT while it works,
/// takes any of these for an error of its own, and restores handlers without their flags.
class SignalsKept {
  public:
#ifdef _WIN32
    SignalsKept() {}
#else
    SignalsKept() {
        sigset_t termination;
        sigemptyset(&termination);
        sigaddset(&termination, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &termination, &mask_);
        sigaction(SIGTERM, nullptr, &on_termination_);
        sigaction(SIGABRT, nullptr, &on_abort_);
    }
    ~SignalsKept() {
        sigaction(SIGTERM, &on_termination_, nullptr);
        sigaction(SIGABRT, &on_abort_, nullptr);
        pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
    }
#endif
    SignalsKept(const SignalsKept&) = delete;
    SignalsKept& operator=(const SignalsKept&) = delete;

  private:
#ifndef _WIN32
    sigset_t mask_;
    struct sigaction on_termination_ {
    }, on_abort_{};
#endif
};

} // namespace

std::vector<std::uint32_t> metis_parts(const PreparedMesh& mesh, std::span<const double> work,
                                       std::uint32_t parts) {
    const std::uint32_t faces = mesh.face_count();
    if (parts < 2 || faces / parts < kMinFaces) {
        return {};
    }
    std::vector<idx_t> starts{0}, beside, weights;
    starts.reserve(faces + 1);
    for (std::uint32_t face = 0; face < faces; ++face) {
        const std::size_t first = beside.size();
        for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
            const auto next = [&](std::uint32_t edge) {
                return around_half_edge(mesh.half_edges()[edge].around);
            };
            for (std::uint32_t other = next(h); other != h; other = next(other)) {
                beside.push_back(static_cast<idx_t>(other / 3));
            }
        }
        const auto begin = beside.begin() + static_cast<std::ptrdiff_t>(first);
        std::sort(begin, beside.end());
        beside.erase(std::unique(begin, beside.end()), beside.end());
        starts.push_back(static_cast<idx_t>(beside.size()));
        weights.push_back(std::max<idx_t>(1, static_cast<idx_t>(std::round(work[face] * kWeight))));
    }
    if (beside.size() > static_cast<std::size_t>(std::numeric_limits<idx_t>::max())) {
        return {};
    }
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    auto count = static_cast<idx_t>(faces);
    auto part_count = static_cast<idx_t>(parts);
    idx_t constraints = 1, cut = 0;
    std::vector<idx_t> found(faces);
    const SignalsKept signals;
    // METIS_PartGraphKway() raises SIGTERM itself where memory is exhausted.
    const int status = METIS_PartGraphRecursive(&count, &constraints, starts.data(), beside.data(),
                                                weights.data(), nullptr, nullptr, &part_count,
                                                nullptr, nullptr, options, &cut, found.data());
    return status == METIS_OK ? std::vector<std::uint32_t>(found.begin(), found.end())
                              : std::vector<std::uint32_t>();
}

} // namespace geodisk
