#include "geodisk/options/constraint_options.hpp"

#include "geodisk/options/tolerance_option.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

void ConstraintOptions::check(const std::string& metric) const {
    check_tolerance(tolerance);
    if (!is_given() && !tolerance.empty()) {
        fail_usage("--tolerance is for points that are read; give --existing");
    }
    if (is_given() && metric != "geodesic") {
        fail_usage("--existing goes by distances along the surface, so it takes no --metric " +
                   metric);
    }
}

void ConstraintOptions::add_files(std::vector<NamedFile>& read) const {
    if (!existing.empty()) {
        read.push_back({"the existing samples", existing});
    }
}

void ConstraintOptions::place_files(const std::function<std::string(const std::string&)>& place) {
    if (!existing.empty()) {
        existing = place(existing);
    }
}

HeaderEntries ConstraintOptions::entries() const {
    return existing.empty() ? HeaderEntries{} : HeaderEntries{{"existing", existing}};
}

HeaderEntries ConstraintOptions::given() const {
    HeaderEntries options;
    for (const auto& [name, value] :
         {std::pair{"--existing", &existing}, {"--tolerance", &tolerance}}) {
        if (!value->empty()) {
            options.emplace_back(name, *value);
        }
    }
    return options;
}

void add_constraint_options(Command command, ConstraintOptions& options) {
    const char* const group = "Constraints";
    command.add_option("--existing", options.existing, "SAMPLES",
                       "Keep the samples of a file, and place new ones at the distance\n"
                       "from them. They come first, marked by the column given, and\n"
                       "count towards --count. Samples of this mesh, or points of\n"
                       "another program",
                       group);
    add_tolerance_option(command, options.tolerance, group);
}

} // namespace geodisk::tools
