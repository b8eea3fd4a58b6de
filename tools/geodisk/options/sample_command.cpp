#include "geodisk/options/sample_command.hpp"

#include <utility>
#include <vector>

#include "program/command_text.hpp"

namespace geodisk::tools {
namespace {

/// Arguments, without those that say what is so anyway.
class ArgumentList {
  public:
    explicit ArgumentList(std::vector<std::string> first) : words_(std::move(first)) {}

    void add(const char* name, const std::string& value, const std::string& usual = {}) {
        if (value != usual) {
            words_.insert(words_.end(), {name, value});
        }
    }
    void add_flag(const std::string& text, bool is_set) {
        if (is_set) {
            words_.push_back(text);
        }
    }
    const std::vector<std::string>& words() const { return words_; }

  private:
    std::vector<std::string> words_;
};

void add_mesh(ArgumentList& list, const MeshOptions& mesh) {
    const HeaderEntries additions = mesh.additions();
    for (const auto& [name, value] : additions) {
        if (name == "weld") { // A flag takes no value behind a blank.
            list.add_flag("--weld=" + value, true);
        }
    }
    list.add_flag("--keep-seams", mesh.keep_seams);
    list.add("--mesh-format", mesh.format);
    list.add_flag("--allow-outside", mesh.allows_outside);
    list.add("--coordinates", mesh.coordinates);
    list.add("--edge-lengths", mesh.edge_lengths);
    for (const std::string& lift : mesh.lifts) {
        list.add("--lift", lift);
    }
}

void add_density(ArgumentList& list, const DensityOptions& density) {
    for (const auto& [name, value] : density.given()) {
        if (value.empty()) {
            list.add_flag(name, true);
        } else {
            list.add(name.c_str(), value);
        }
    }
    list.add("--radius-factor-floor", density.factor_floor);
    list.add("--density-floor", density.floor);
}

} // namespace

std::string sample_command(const SampleOptions& options) {
    const SampleOptions usual;
    ArgumentList list({"sample", options.mesh.mesh, "-o", options.out.output});
    list.add("--min-distance", options.min_distance);
    list.add("--radius", options.radius);
    list.add("--count", options.count);
    list.add_flag("--exact", options.method.exact);
    add_mesh(list, options.mesh);
    add_density(list, options.density);
    for (const auto& [name, value] : options.constraints.given()) {
        list.add(name.c_str(), value);
    }
    list.add("--classes", options.classes);
    list.add("--features", options.features);
    for (const std::string& only : options.mask.only) {
        list.add("--only", only);
    }
    for (const std::string& mask : options.mask.masks) {
        list.add("--mask", mask);
    }
    list.add("--from", options.from);
    list.add("--metric", options.metric, usual.metric);
    list.add("--method", options.method.method, usual.method.method);
    list.add("--pool-ratio", options.method.pool_ratio);
    list.add("--order", options.method.order, usual.method.order);
    list.add("--levels", options.method.levels);
    list.add("--level-factor", options.method.level_factor);
    list.add("--keep", options.method.keep);
    list.add("--darts", options.method.darts);
    list.add_flag("--dense", options.method.is_dense);
    list.add_flag("--maximal", options.method.is_maximal);
    list.add("--seed", options.run.seed, usual.run.seed);
    list.add("--up", options.out.up);
    list.add("--units", options.out.units);
    list.add_flag("--ascii", options.out.ascii);
    list.add("--columns", options.out.columns);
    list.add("--attributes", options.out.record.attributes);
    list.add("--texture", options.out.record.texture);
    list.add("--normals", options.out.record.normals, usual.out.record.normals);
    list.add_flag("--frames", options.out.record.frames);
    list.add_flag("--no-header", options.out.no_header);
    return command_text("geodisk", list.words());
}

} // namespace geodisk::tools
