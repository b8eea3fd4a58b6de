#include "bench/measurement.hpp"

namespace geodisk::bench {

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

double swept_value(Sweep sweep, const Measurement& row) {
    return static_cast<double>(sweep == Sweep::triangles ? row.triangles : row.samples);
}

std::vector<Growth> fit_growth(Sweep sweep, const std::vector<Measurement>& rows) {
    std::vector<Point> device;
    std::vector<Point> reference;
    std::vector<Point> prepare;
    for (const Measurement& row : rows) {
        const double x = swept_value(sweep, row);
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

} // namespace geodisk::bench
