#include "geodisk/reports/number_entries.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <geodisk/fields.hpp>

#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kToldElsewhere[] = {"min_distance", "seed", "darts", "stop_count",
                                               "maximal"};

} // namespace

HeaderEntries number_entries(const SampleParams& params) {
    const SampleParams plain;
    HeaderEntries defaults, entries;
    const auto write_to = [](HeaderEntries& list) {
        return [&list](const char* name, auto value) {
            if (std::ranges::find(kToldElsewhere, name) == std::end(kToldElsewhere)) {
                list.emplace_back(name, exact_text(+value)); // No bool.
            }
        };
    };
    for_each_number(plain, write_to(defaults));
    for_each_number(params, write_to(entries));
    std::erase_if(entries, [&](const auto& entry) {
        return std::ranges::find(defaults, entry) != defaults.end();
    });
    return entries;
}

void add_numbers(Json& report, const SampleParams& params) {
    for_each_number(params, [&](const char* name, auto value) {
        if (!report.contains(name)) {
            report[name] = value;
        }
    });
}

} // namespace geodisk::tools
