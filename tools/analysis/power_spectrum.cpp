#include "analysis/power_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <span>

namespace geodisk::tools::analysis {
namespace {

/// Rows that a thread takes at a time, so that their sums stay near it.
constexpr std::size_t kRows = 8;

using Wave = std::complex<double>;

/// exp(-2 pi i x).
Wave wave(double x) {
    return std::polar(1.0, -2 * std::numbers::pi * (x - std::floor(x)));
}

/// Sums of waves over the samples, for some rows.
class RowSums {
  public:
    RowSums(std::size_t rows, std::int64_t most)
        : columns_(static_cast<std::size_t>(most)), stride_(2 * columns_ + 1),
          real_(rows * stride_, 0), imaginary_(rows * stride_, 0), wave_real_(stride_),
          wave_imaginary_(stride_) {}

    /// A sample at x, in parts of the first side; `along` are its waves of the rows.
    void add(double x, std::span<const Wave> along) {
        const Wave step = wave(x);
        Wave at = 1;
        for (std::size_t column = 0; column <= columns_; ++column, at *= step) {
            wave_real_[columns_ + column] = wave_real_[columns_ - column] = at.real();
            wave_imaginary_[columns_ + column] = at.imag();
            wave_imaginary_[columns_ - column] = -at.imag();
        }
        for (std::size_t row = 0; row < along.size(); ++row) {
            const double a = along[row].real(), b = along[row].imag();
            double* const real = &real_[row * stride_];
            double* const imaginary = &imaginary_[row * stride_];
            for (std::size_t i = 0; i < stride_; ++i) {
                real[i] += a * wave_real_[i] - b * wave_imaginary_[i];
                imaginary[i] += a * wave_imaginary_[i] + b * wave_real_[i];
            }
        }
    }
    double square(std::size_t row, std::size_t i) const {
        const double a = real_[row * stride_ + i], b = imaginary_[row * stride_ + i];
        return a * a + b * b;
    }

  private:
    std::size_t columns_, stride_;
    std::vector<double> real_, imaginary_, wave_real_, wave_imaginary_;
};

} // namespace

PowerSpectrum::PowerSpectrum(const BoxParams& box, double highest)
    : sides_(box.extents), highest_(highest) {
    std::size_t size = 1;
    for (const double side : sides_) {
        max_.push_back(static_cast<std::int64_t>(highest * side));
        size *= 2 * static_cast<std::size_t>(max_.back()) + 1;
    }
    const auto last = static_cast<std::size_t>(max_.back());
    sums_.assign(size / (2 * last + 1) * (last + 1), 0);
}

double PowerSpectrum::count(const BoxParams& box, double highest) {
    double count = 0.5;
    for (const double side : box.extents) {
        count *= 2 * highest * side + 1;
    }
    return count;
}

/// Fills in all waves but those along the first side.
void PowerSpectrum::set_row(std::size_t row, std::span<std::int64_t> waves) const {
    for (std::size_t axis = 1; axis < sides_.size(); ++axis) {
        const bool is_last = axis + 1 == sides_.size();
        const auto most = static_cast<std::size_t>(max_[axis]);
        const std::size_t count = is_last ? most + 1 : 2 * most + 1;
        waves[axis] = static_cast<std::int64_t>(row % count) - (is_last ? 0 : max_[axis]);
        row /= count;
    }
}

double PowerSpectrum::length(std::span<const std::int64_t> waves) const {
    double square = 0;
    for (std::size_t axis = 0; axis < sides_.size(); ++axis) {
        const double frequency = static_cast<double>(waves[axis]) / sides_[axis];
        square += frequency * frequency;
    }
    return std::sqrt(square);
}

double PowerSpectrum::power(std::span<const std::int64_t> waves) const {
    const double length = this->length(waves);
    if (sets_ == 0 || length == 0 || length > highest_) {
        return 0;
    }
    // Real samples have the same power at opposite frequencies.
    const std::int64_t sign = waves.back() < 0 ? -1 : 1;
    std::size_t row = 0;
    for (std::size_t axis = sides_.size() - 1; axis > 0; --axis) {
        const bool is_last = axis + 1 == sides_.size();
        const std::int64_t count = is_last ? max_[axis] + 1 : 2 * max_[axis] + 1;
        row = row * static_cast<std::size_t>(count) +
              static_cast<std::size_t>(sign * waves[axis] + (is_last ? 0 : max_[axis]));
    }
    const auto column = static_cast<std::size_t>(sign * waves[0] + max_[0]);
    return sums_[row * columns() + column] / sets_;
}

void PowerSpectrum::add(std::span<const double> points, const PartDone& tell) {
    std::vector<double> powers(sums_.size(), 0);
    const std::size_t dimension = sides_.size(), stride = columns();
    const std::size_t samples = points.size() / dimension;
    const auto make_worker = [&] {
        return [&, waves = std::vector<std::int64_t>(dimension)](std::size_t, std::size_t begin,
                                                                 std::size_t end) mutable {
            // Rows within reach, waves along all sides but the first.
            std::vector<std::size_t> rows;
            std::vector<double> factors;
            for (std::size_t row = begin; row < end; ++row) {
                set_row(row, waves);
                if (length(waves) <= highest_) {
                    rows.push_back(row);
                    factors.insert(factors.end(), waves.begin() + 1, waves.end());
                }
            }
            RowSums sums(rows.size(), max_[0]);
            std::vector<Wave> along(rows.size());
            for (std::size_t i = 0; i < samples; ++i) {
                const double* const point = &points[i * dimension];
                const double* factor = factors.data();
                for (Wave& one : along) {
                    double turns = 0;
                    for (std::size_t axis = 1; axis < dimension; ++axis) {
                        turns += *factor++ * (point[axis] / sides_[axis]);
                    }
                    one = wave(turns);
                }
                sums.add(point[0] / sides_[0], along);
            }
            for (std::size_t k = 0; k < rows.size(); ++k) {
                for (std::size_t i = 0; i < stride; ++i) {
                    powers[rows[k] * stride + i] = sums.square(k, i) / static_cast<double>(samples);
                }
            }
        };
    };
    in_batches(rows(), kRows, make_worker, tell);
    std::transform(powers.begin(), powers.end(), sums_.begin(), sums_.begin(), std::plus<>());
    ++sets_;
}

std::vector<SpectrumRing> PowerSpectrum::rings() const {
    RingSums sums(1 / *std::min_element(sides_.begin(), sides_.end()), highest_);
    std::vector<std::int64_t> waves(sides_.size(), 0);
    for (std::size_t row = 0; row < rows(); ++row) {
        set_row(row, waves);
        const auto slowest =
            std::find_if(waves.rbegin(), waves.rend() - 1, [](auto wave) { return wave != 0; });
        const bool is_alone = slowest == waves.rend() - 1;
        if (!is_alone && *slowest < 0) {
            continue; // What is mirrored,
        }
        for (waves[0] = is_alone ? 1 : -max_[0]; waves[0] <= max_[0]; ++waves[0]) {
            sums.add(length(waves), power(waves)); // and the mean.
        }
        waves[0] = 0;
    }
    return sums.rings();
}

} // namespace geodisk::tools::analysis
