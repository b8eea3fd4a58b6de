#include "analysis/manifold_harmonics.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <thread>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymGEigsShiftSolver.h>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools::analysis {
namespace {

using Eigen::Index;

/// Eigenvalues below this, times the area, are of waves some 200 times as long as the surface is
/// wide.
constexpr double kLowest = 1e-3;
/// Harmonics of a band, about. Each takes a product with all others of its band, and each band two
/// factorizations.
constexpr std::size_t kBandSize = 100;
/// A band with more of them than so many is cut, down to this relative width.
constexpr std::size_t kLargestBand = 180;
constexpr double kNarrowest = 1e-7;
/// By which a shift moves that hits an eigenvalue.
constexpr double kNudge = 1e-9;
constexpr int kMaxNudges = 100;
constexpr double kTolerance = 1e-10; ///< Tolerance of an eigenvalue of the inverse.
constexpr Index kMaxRestarts = 300;
/// Dimensions of the Krylov space beyond twice the eigenvalues looked for.
constexpr std::size_t kSpareDimensions = 20;

std::size_t krylov_size(std::size_t wanted) {
    return 2 * wanted + kSpareDimensions;
}

/// stiffness - shift mass = L D L'.
class Factors {
  public:
    explicit Factors(const Laplacian& laplacian) : laplacian_(laplacian) {
        solver_.analyzePattern(laplacian.stiffness - laplacian.mass);
    }

    /// Moves the shift a little where it is an eigenvalue. Returns it.
    double factorize(double shift) {
        for (int nudge = 0; nudge < kMaxNudges; ++nudge, shift *= 1 + kNudge) {
            solver_.factorize(laplacian_.stiffness - shift * laplacian_.mass);
            if (solver_.info() == Eigen::Success && solver_.vectorD().allFinite()) {
                return shift;
            }
        }
        throw UserError(ExitCode::bad_input, "the waves of the mesh are beyond double precision");
    }
    /// Returns how many eigenvalues are below the shift.
    std::size_t below() const {
        return static_cast<std::size_t>((solver_.vectorD().array() < 0).count());
    }
    Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& right) const {
        return solver_.solve(right);
    }
    double entries() const {
        return static_cast<double>(solver_.matrixL().nestedExpression().nonZeros());
    }

  private:
    const Laplacian& laplacian_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

/// Eigenvalues from `low` up to, without, `high`.
struct Slice {
    double low, high;
    std::size_t first, count; ///< `first` are lower.
};

/// The inverse of `factors`, as Spectra wants it, without the functions that are known.
class Inverse {
  public:
    using Scalar = double;

    Inverse(const Factors& factors, const Laplacian& laplacian, const std::function<void()>& watch)
        : factors_(factors), laplacian_(laplacian), watch_(watch) {}

    Index rows() const { return laplacian_.mass.rows(); }
    Index cols() const { return rows(); }
    void set_shift(double) const {} // The factors are of that shift already.
    void perform_op(const double* in, double* out) const {
        watch_();
        Eigen::Map<Eigen::VectorXd> result(out, rows());
        result = factors_.solve(Eigen::Map<const Eigen::VectorXd>(in, rows()));
        if (known_.cols() > 0) {
            result -= known_ * (weighted_.transpose() * result);
        }
    }
    void leave_out(const Eigen::Ref<const Eigen::MatrixXd>& functions) {
        known_ = functions;
        weighted_ = laplacian_.mass * functions;
    }

  private:
    const Factors& factors_;
    const Laplacian& laplacian_;
    const std::function<void()>& watch_;
    Eigen::MatrixXd known_, weighted_;
};

/// Results of a slice's Lanczos runs.
class FoundModes {
  public:
    FoundModes(const Laplacian& laplacian, const Slice& slice)
        : laplacian_(laplacian), slice_(slice),
          functions_(laplacian.mass.rows(), static_cast<Index>(slice.count)) {}

    std::size_t count() const { return eigenvalues_.size(); }
    Eigen::Ref<const Eigen::MatrixXd> functions() const {
        return functions_.leftCols(static_cast<Index>(count()));
    }
    /// Takes those of the slice that there is room for; tells whether there was for all.
    bool add(const Eigen::VectorXd& eigenvalues, const Eigen::MatrixXd& functions) {
        for (Index i = 0; i < eigenvalues.size(); ++i) {
            if (eigenvalues[i] < slice_.low || eigenvalues[i] >= slice_.high) {
                continue;
            }
            if (count() == slice_.count) {
                return false;
            }
            const double square = functions.col(i).dot(laplacian_.mass * functions.col(i));
            functions_.col(static_cast<Index>(count())) = functions.col(i) / std::sqrt(square);
            eigenvalues_.push_back(eigenvalues[i]);
        }
        return true;
    }

    HarmonicBand sorted() const {
        std::vector<Index> order(count());
        std::iota(order.begin(), order.end(), Index{0});
        const auto value = [&](Index i) { return eigenvalues_[static_cast<std::size_t>(i)]; };
        std::sort(order.begin(), order.end(),
                  [&](Index a, Index b) { return value(a) < value(b); });
        HarmonicBand band;
        band.first = slice_.first;
        band.eigenvalues.resize(static_cast<Index>(order.size()));
        band.functions.resize(functions_.rows(), static_cast<Index>(order.size()));
        for (std::size_t i = 0; i < order.size(); ++i) {
            band.eigenvalues[static_cast<Index>(i)] = value(order[i]);
            band.functions.col(static_cast<Index>(i)) = functions_.col(order[i]);
        }
        return band;
    }

  private:
    const Laplacian& laplacian_;
    Slice slice_;
    std::vector<double> eigenvalues_;
    Eigen::MatrixXd functions_; ///< With room for those of the whole slice.
};

[[noreturn]] void fail_slice(const Slice& slice, std::size_t found, double unit) {
    const auto frequency = [&](double eigenvalue) {
        return rounded(std::sqrt(eigenvalue) / (2 * std::numbers::pi * unit), 6);
    };
    throw UserError(ExitCode::bad_input,
                    "of " + counted(slice.count, "harmonic", "harmonics") + " between " +
                        frequency(slice.low) + " and " + frequency(slice.high) +
                        " waves per unit of length only " + grouped(found) +
                        " could be found; the mesh has triangles too flat for double precision");
}

/// All of the slice. Lanczos finds one function of several that share an eigenvalue, as on
/// symmetric surfaces, so it runs again without those known until all are there.
HarmonicBand solve_slice(const Laplacian& laplacian, Factors& factors, const Slice& slice,
                         double unit, const std::function<void()>& watch) {
    const double shift = factors.factorize((slice.low + slice.high) / 2);
    Spectra::SparseSymMatProd<double> mass(laplacian.mass);
    Inverse inverse(factors, laplacian, watch);
    FoundModes found(laplacian, slice);
    while (found.count() < slice.count) {
        const std::size_t known = found.count(), wanted = slice.count - known;
        const std::size_t krylov = std::min<std::size_t>(krylov_size(wanted), laplacian.size());
        inverse.leave_out(found.functions());
        Spectra::SymGEigsShiftSolver<Inverse, Spectra::SparseSymMatProd<double>,
                                     Spectra::GEigsMode::ShiftInvert>
            solver(inverse, mass, static_cast<Index>(std::min(wanted, krylov - 1)),
                   static_cast<Index>(krylov), shift);
        solver.init();
        solver.compute(Spectra::SortRule::LargestMagn, kMaxRestarts, kTolerance);
        if (!found.add(solver.eigenvalues(), solver.eigenvectors()) || found.count() == known) {
            fail_slice(slice, known, unit);
        }
    }
    return found.sorted();
}

/// Returns the width of a square of the area, as a power of two.
double unit_of(double area) {
    return std::exp2(std::round(std::log2(area) / 2));
}

/// Returns the Laplacian in that unit. Solvers compare with absolute bounds. The stiffness is the
/// same in all units.
Laplacian in_unit(const Laplacian& laplacian, double unit) {
    const double factor = 1 / unit / unit;
    return {laplacian.stiffness, laplacian.mass * factor, {}, laplacian.area * factor};
}

} // namespace

/// The first factors, at the lowest eigenvalue, and what they took.
struct ManifoldHarmonics::Probe {
    explicit Probe(const Laplacian& given)
        : unit(unit_of(given.area)), laplacian(in_unit(given, unit)), factors(laplacian) {
        const Stopwatch factorizing;
        lowest = factors.factorize(kLowest / laplacian.area);
        factor_seconds = factorizing.seconds();
        below = factors.below();
        Eigen::VectorXd vector = Eigen::VectorXd::Ones(laplacian.mass.rows());
        const Stopwatch solving;
        vector = factors.solve(vector);
        solve_seconds = solving.seconds();
    }

    /// From the lowest eigenvalue on, about kBandSize in each.
    std::vector<Slice> slices(std::size_t harmonics, const PartDone& tell) {
        std::vector<Slice> result;
        // Weyl's law.
        double low = lowest,
               width = 4 * std::numbers::pi * static_cast<double>(kBandSize) / laplacian.area;
        for (std::size_t first = 0; first < harmonics;) {
            const double high = factors.factorize(low + width);
            const std::size_t before = below + first, until = factors.below();
            const std::size_t count = until - std::min(before, until);
            if (count > kLargestBand && width > kNarrowest * low) {
                width /= 2;
                continue;
            }
            if (count > 0) {
                result.push_back({low, high, first, count});
                first += count;
            }
            width = count > kBandSize / 2 ? width : 2 * width;
            low = high;
            if (tell) {
                tell(0);
            }
        }
        return result;
    }

    double unit; ///< Length that 1 stands for.
    Laplacian laplacian;
    Factors factors;
    double lowest, factor_seconds, solve_seconds;
    std::size_t below;
};

ManifoldHarmonics::ManifoldHarmonics(const Laplacian& laplacian)
    : probe_(std::make_unique<Probe>(laplacian)), count_(laplacian.size() - probe_->below) {}

ManifoldHarmonics::~ManifoldHarmonics() = default;
ManifoldHarmonics::ManifoldHarmonics(ManifoldHarmonics&&) noexcept = default;

HarmonicCost ManifoldHarmonics::cost(std::size_t harmonics) const {
    // As measured: Lanczos solves 2.5 times for each harmonic of a full band, and each vector is
    // multiplied with those of the Krylov space some four times.
    constexpr double kSolves = 2.5, kProducts = 4, kPerSecond = 3e9;
    const double size = probe_->laplacian.size(),
                 krylov = static_cast<double>(krylov_size(kBandSize));
    const auto bands = static_cast<double>(batch_count(harmonics, kBandSize));
    const double band_seconds =
        probe_->factor_seconds +
        kSolves * kBandSize * (probe_->solve_seconds + kProducts * 2 * size * krylov / kPerSecond);
    const double threads =
        std::min(bands, std::max(1.0, 1.0 * std::thread::hardware_concurrency()));
    return {bands * (probe_->factor_seconds + band_seconds / threads),
            threads * (probe_->factors.entries() * (sizeof(double) + sizeof(int)) +
                       size * sizeof(double) * (krylov + 2 * kBandSize))};
}

void ManifoldHarmonics::compute(std::size_t harmonics,
                                const std::function<void(const HarmonicBand&)>& visit,
                                const PartDone& tell) const {
    const std::vector<Slice> slices = probe_->slices(harmonics, tell);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> ends{false};
    std::atomic<std::size_t> done{0};
    struct Ended {};
    // Within a band as well, which takes seconds.
    const std::function<void()> watch = [&] {
        if (ends) {
            throw Ended();
        }
        if (tell && std::this_thread::get_id() == caller) {
            tell(static_cast<double>(done) / static_cast<double>(slices.size()));
        }
    };
    const auto make_worker = [&] {
        return [&, factors = Factors(probe_->laplacian)](std::size_t batch, std::size_t,
                                                         std::size_t) mutable {
            const Slice& slice = slices[batch];
            try {
                HarmonicBand band =
                    solve_slice(probe_->laplacian, factors, slice, probe_->unit, watch);
                band.eigenvalues /= probe_->unit * probe_->unit;
                band.functions /= probe_->unit;
                const std::size_t rest = harmonics - slice.first;
                if (rest < slice.count) {
                    const auto kept = static_cast<Index>(rest);
                    band.eigenvalues.conservativeResize(kept);
                    band.functions.conservativeResize(Eigen::NoChange, kept);
                }
                visit(band);
                ++done;
            } catch (const Ended&) { // By an error that another thread throws.
            } catch (...) {
                ends = true;
                throw;
            }
        };
    };
    in_batches(slices.size(), 1, make_worker, {});
}

} // namespace geodisk::tools::analysis
