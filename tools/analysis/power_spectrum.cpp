#include "analysis/power_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>
#include <numbers>

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
    RowSums(std::size_t rows, std::uint32_t columns)
        : stride_(2 * std::size_t{columns} + 1), columns_(columns), real_(rows * stride_, 0),
          imaginary_(rows * stride_, 0), wave_real_(stride_), wave_imaginary_(stride_) {}

    /// A sample at x and y, in parts of the sides; rows from `first` on.
    void add(double x, double y, std::size_t first) {
        const Wave step = wave(x);
        Wave at = 1;
        for (std::size_t column = 0; column <= columns_; ++column, at *= step) {
            wave_real_[columns_ + column] = wave_real_[columns_ - column] = at.real();
            wave_imaginary_[columns_ + column] = at.imag();
            wave_imaginary_[columns_ - column] = -at.imag();
        }
        for (std::size_t row = 0; row * stride_ < real_.size(); ++row) {
            const Wave along = wave(static_cast<double>(first + row) * y);
            const double a = along.real(), b = along.imag();
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
    std::size_t stride_, columns_;
    std::vector<double> real_, imaginary_, wave_real_, wave_imaginary_;
};

} // namespace

PowerSpectrum::PowerSpectrum(const BoxParams& box, double highest)
    : width_(box.extents[0]), height_(box.extents[1]), highest_(highest),
      columns_(static_cast<std::uint32_t>(highest * width_)),
      rows_(static_cast<std::uint32_t>(highest * height_)), sums_(size(), 0) {}

std::size_t PowerSpectrum::size() const {
    return (2 * std::size_t{columns_} + 1) * (std::size_t{rows_} + 1);
}

std::size_t PowerSpectrum::index(std::int64_t column, std::uint32_t row) const {
    return row * (2 * std::size_t{columns_} + 1) +
           static_cast<std::size_t>(column + std::int64_t{columns_});
}

double PowerSpectrum::power(std::int64_t column, std::int64_t row) const {
    // Real samples have the same power at opposite frequencies.
    if (row < 0) {
        column = -column;
        row = -row;
    }
    const double length =
        std::hypot(static_cast<double>(column) / width_, static_cast<double>(row) / height_);
    if (sets_ == 0 || (column == 0 && row == 0) || length > highest_ || row > rows_ ||
        std::abs(column) > columns_) {
        return 0;
    }
    return sums_[index(column, static_cast<std::uint32_t>(row))] / sets_;
}

void PowerSpectrum::add(std::span<const double> points, const PartDone& tell) {
    std::vector<double> powers(sums_.size(), 0);
    const std::size_t samples = points.size() / 2;
    const auto make_worker = [&] {
        return [&](std::size_t, std::size_t begin, std::size_t end) {
            RowSums sums(end - begin, columns_);
            for (std::size_t i = 0; i < samples; ++i) {
                sums.add(points[2 * i] / width_, points[2 * i + 1] / height_, begin);
            }
            const std::size_t stride = 2 * std::size_t{columns_} + 1;
            for (std::size_t row = begin; row < end; ++row) {
                for (std::size_t i = 0; i < stride; ++i) {
                    powers[row * stride + i] =
                        sums.square(row - begin, i) / static_cast<double>(samples);
                }
            }
        };
    };
    in_batches(std::size_t{rows_} + 1, kRows, make_worker, tell);
    std::transform(powers.begin(), powers.end(), sums_.begin(), sums_.begin(), std::plus<>());
    ++sets_;
}

std::vector<SpectrumRing> PowerSpectrum::rings() const {
    RingSums sums(1 / std::min(width_, height_), highest_);
    for (std::uint32_t row = 0; row <= rows_; ++row) {
        for (std::int64_t column = -std::int64_t{columns_}; column <= std::int64_t{columns_};
             ++column) {
            if (row == 0 && column <= 0) {
                continue; // The mean, and what is mirrored.
            }
            sums.add(std::hypot(static_cast<double>(column) / width_, row / height_),
                     power(column, row));
        }
    }
    return sums.rings();
}

} // namespace geodisk::tools::analysis
