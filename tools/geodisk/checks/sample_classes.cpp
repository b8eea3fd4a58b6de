#include "geodisk/checks/sample_classes.hpp"

#include <algorithm>
#include <cstddef>

#include "files/samples/sample_columns.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

ClassTable classes_in_header(const SampleFile& samples) {
    const std::string* const entry = samples.header.find(key_of_column(kClassColumn));
    if (entry == nullptr) {
        return {};
    }
    if (names_class_file(*entry)) {
        fail_input(samples.path, "its header has the classes " + in_quotes(*entry) +
                                     ", which are none; give --min-distance");
    }
    return parse_classes(*entry);
}

void check_classes(const SampleFile& samples, std::size_t count) {
    const auto values = samples.extra_values(kClassColumn);
    if (values.size() != samples.rows.size()) {
        fail_input(samples.path,
                   "has no column class, so the classes of its samples are not known; give "
                   "--min-distance to use one distance for all");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= count) {
            fail_input(samples.path, "sample " + std::to_string(i) + ": its class is " +
                                         std::to_string(values[i]) + ", but there are " +
                                         std::to_string(count) + ", numbered from 0");
        }
    }
}

void check_class_options(const SampleFile& samples, const MaskOptions& mask,
                         const ConstraintOptions& constraints) {
    std::size_t most = 0;
    for (const ClassPlace& place : mask.class_places()) {
        most = std::max(most, std::size_t{1} + place.number);
    }
    for (const AvoidOption& option : constraints.parsed_avoid()) {
        if (option.only_class != kAllClasses) {
            most = std::max(most, std::size_t{1} + option.only_class);
        }
    }
    if (most == 0 || samples.rows.empty()) {
        return;
    }
    const auto classes = samples.extra_values(kClassColumn);
    if (classes.empty()) {
        fail_input(samples.path, "has no column class, so options of single classes check nothing");
    }
    const std::size_t told = classes_in_header(samples).count;
    const std::size_t count = std::max<std::size_t>(told, 1 + *std::ranges::max_element(classes));
    if (most > count) {
        fail_input(samples.path, "has " + std::to_string(count) +
                                     " classes, numbered from 0, so there is no class " +
                                     std::to_string(most - 1));
    }
}

} // namespace geodisk::tools
