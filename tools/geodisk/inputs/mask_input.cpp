#include "geodisk/inputs/mask_input.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include <geodisk/outside_faces.hpp>

#include "files/images/image.hpp"
#include "files/meshes/value_fields.hpp"
#include "files/name_text.hpp"
#include "geodisk/inputs/radii_input.hpp"
#include "geometry/mesh_parts.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {
namespace {

using RuleKind = OnlyRule::Kind;
using Mask = std::vector<std::uint8_t>;
/// Numbers of what a part of the file belongs to.
using Numbers = std::vector<std::uint32_t>;

/// Names for what --only selects, and for what files hold it.
struct Naming {
    const char* plural;
    const char* source;
};

Naming naming_of(RuleKind kind) {
    switch (kind) {
    case RuleKind::material:
        return {"materials", "; OBJ (usemtl) and glTF files may"};
    case RuleKind::group:
        return {"groups", "; OBJ files may (g, o)"};
    default:
        return {"nodes", "; glTF files may"};
    }
}

const std::vector<std::string>& names_of(const MeshFile& mesh, RuleKind kind) {
    const PartNames& names = mesh.part_names;
    return kind == RuleKind::material ? names.materials
           : kind == RuleKind::group  ? names.groups
                                      : names.nodes;
}

Numbers numbers_of(const MeshFile& mesh, const MeshPart& part, RuleKind kind) {
    if (kind == RuleKind::group) {
        return part.groups;
    }
    if (kind == RuleKind::material) {
        return part.material ? Numbers{*part.material} : Numbers{};
    }
    Numbers numbers;
    const auto& above = mesh.part_names.node_above;
    for (auto node = part.node; node; node = *node < above.size() ? above[*node] : std::nullopt) {
        numbers.push_back(*node);
    }
    return numbers;
}

/// Index of the parts of the file that have what a rule of this kind may name.
class PartIndex {
  public:
    PartIndex(const MeshFile& mesh, RuleKind kind) : mesh_(mesh), kind_(kind) {
        std::vector<bool> has_triangles(mesh.parts.size(), false);
        for (const std::uint32_t part : mesh.part_of_triangle) {
            has_triangles[part] = true;
        }
        for (std::size_t part = 0; part < mesh.parts.size(); ++part) {
            numbers_.push_back(has_triangles[part] ? numbers_of(mesh, mesh.parts[part], kind)
                                                   : Numbers{});
            known_.insert(numbers_.back().begin(), numbers_.back().end());
        }
    }

    /// Adds to `chosen` the parts that the rule names.
    void choose(const std::string& path, const OnlyRule& rule, std::vector<bool>& chosen) const {
        std::set<std::uint32_t> wanted;
        for (const std::uint32_t number : known_) {
            if (composed_name(name_of(number)) == composed_name(rule.name)) {
                wanted.insert(number);
            }
        }
        const auto number = parse_integer<std::uint32_t>(rule.name);
        if (wanted.empty() && number && known_.contains(*number)) {
            wanted.insert(*number);
        }
        if (wanted.empty()) {
            fail_unknown(path, rule);
        }
        for (std::size_t part = 0; part < numbers_.size(); ++part) {
            if (std::ranges::any_of(numbers_[part],
                                    [&](std::uint32_t n) { return wanted.contains(n); })) {
                chosen[part] = true;
            }
        }
    }

  private:
    std::string name_of(std::uint32_t number) const {
        const std::vector<std::string>& names = names_of(mesh_, kind_);
        return number < names.size() ? names[number] : "";
    }

    [[noreturn]] void fail_unknown(const std::string& path, const OnlyRule& rule) const {
        constexpr std::size_t kMax = 10;
        const Naming naming = naming_of(kind_);
        if (known_.empty()) {
            fail_input(path, "has no " + std::string(naming.plural) + " for " + rule.option + " " +
                                 rule.text + naming.source);
        }
        std::vector<std::string> names, shown;
        for (const std::uint32_t number : known_) {
            const std::string name = name_of(number);
            names.push_back(name.empty() ? std::to_string(number) : name);
        }
        shown.assign(names.begin(),
                     names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMax)));
        for (std::string& name : shown) {
            name = in_quotes(name);
        }
        if (names.size() > kMax) {
            shown.push_back(std::to_string(names.size() - kMax) + " more");
        }
        fail_input(path, "no face is of " + rule.text + ", as " + rule.option + " requests; the " +
                             naming.plural + " are " + listed(shown) +
                             did_you_mean(rule.name, names));
    }

    const MeshFile& mesh_;
    RuleKind kind_;
    std::vector<Numbers> numbers_; ///< Numbers of each part; none of a part without triangles.
    std::set<std::uint32_t> known_;
};

/// Marks the triangles of a part that no path joins to others.
void choose_component(const std::string& path, const MeshFile& mesh, const OnlyRule& rule,
                      Mask& chosen) {
    const Numbers parts = part_of_triangles(mesh.triangles);
    const std::uint32_t wanted = parse_integer<std::uint32_t>(rule.name).value_or(kNoPart);
    std::uint32_t count = 0;
    bool is_known = false;
    for (std::size_t t = 0; t < parts.size(); ++t) {
        const bool is_wanted = parts[t] == wanted && wanted != kNoPart;
        chosen[t] = is_wanted ? 1 : chosen[t];
        is_known = is_known || is_wanted;
        count = parts[t] == kNoPart ? count : std::max(count, parts[t] + 1);
    }
    if (!is_known) {
        fail_input(path, "has no " + rule.text + ", as " + rule.option + " requests; its " +
                             (count == 1 ? "only part is 0"
                                         : counted(count, "part", "parts") + " are 0 to " +
                                               std::to_string(count - 1)));
    }
}

/// Marks the triangles that are seen from outside.
void choose_outside(const std::string& path, const MeshFile& mesh, const OnlyRule& rule,
                    Mask& chosen) {
    if (mesh.positions.empty() || mesh.dimension != 3) {
        fail_usage(rule.option + " " + rule.text + " needs a mesh with 3 coordinates per vertex");
    }
    auto seen = outside_faces({mesh.positions, mesh.triangles, 3}, rule.share, {},
                              [](const Progress&) { return !is_interrupted(); });
    check_interrupted();
    std::ranges::transform(chosen, take(std::move(seen), path), chosen.begin(),
                           std::bit_or<std::uint8_t>());
}

Mask chosen_by(const std::string& path, const MeshFile& mesh, const std::vector<OnlyRule>& rules) {
    Mask chosen(mesh.triangle_count(), rules.empty() ? 1 : 0);
    std::vector<bool> parts(mesh.parts.size(), false);
    for (const OnlyRule& rule : rules) {
        if (rule.kind == RuleKind::part) {
            choose_component(path, mesh, rule, chosen);
        } else if (rule.kind == RuleKind::outside) {
            choose_outside(path, mesh, rule, chosen);
        } else {
            PartIndex(mesh, rule.kind).choose(path, rule, parts);
        }
    }
    for (std::size_t t = 0; t < mesh.part_of_triangle.size(); ++t) {
        chosen[t] = parts[mesh.part_of_triangle[t]] ? 1 : chosen[t];
    }
    return chosen;
}

/// Values that a rule compares, of vertices or corners.
struct RuleValues {
    std::vector<double> values;
    const std::vector<std::uint32_t>* vertices = nullptr; ///< Vertex of each corner, or null.

    double at(std::size_t corner) const {
        return values[vertices != nullptr ? (*vertices)[corner] : corner];
    }
};

std::vector<double> coordinates_for(const MaskRule& rule, std::size_t axis, const MeshFile& mesh) {
    if (axis >= mesh.dimension && !mesh.positions.empty()) {
        fail_usage(rule.option + " " + rule.name + ": the mesh has " +
                   std::to_string(mesh.dimension) + " coordinates per vertex");
    }
    std::vector<double> coordinates;
    for (std::size_t i = axis; i < mesh.positions.size(); i += mesh.dimension) {
        coordinates.push_back(mesh.positions[i]);
    }
    if (coordinates.empty()) {
        fail_usage(rule.option + " " + rule.name + " needs a mesh with coordinates");
    }
    return coordinates;
}

RuleValues values_for(const MaskRule& rule, const MeshFile& mesh, const MeshField* number,
                      const SplitFaces* split) {
    if (const auto axis = rule.axis()) {
        return {coordinates_for(rule, *axis, mesh), &mesh.triangles};
    }
    if (number == nullptr) {
        const auto& corners = split ? split->parts().triangles() : mesh.triangles;
        return {map_values(GreyImage(rule.name), mesh, split,
                           std::size_t{1} + *std::ranges::max_element(corners)),
                &corners};
    }
    RuleValues of_corners;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const std::size_t index = mesh.value_index(*number, corner);
        const bool has_value = index < number->values.size(); // Else its triangle takes no part.
        of_corners.values.push_back(has_value ? number->values[index] : std::nan(""));
    }
    return of_corners;
}

/// Returns the rule with the value that the name in it means.
MaskRule with_value(MaskRule rule, const MeshField& number) {
    const std::vector<ValueName>& names = number.value_names;
    if (!rule.has_comparison && !names.empty()) {
        fail_usage(rule.option + ": the values of " + in_quotes(rule.name) +
                   " are labels; tell which, such as " +
                   in_quotes(rule.name + '=' + names.back().name));
    }
    const auto found = std::ranges::find_if(names, [&](const ValueName& one) {
        return composed_name(one.name) == composed_name(rule.value_name);
    });
    if (!rule.value_name.empty() && found != names.end()) {
        rule.value = found->value;
        const auto other = std::ranges::find_if(names, [&](const ValueName& one) {
            return one.value == found->value && one.name != found->name;
        });
        if (other != names.end()) {
            fail_input(value_file(rule.name).value_or(rule.name),
                       "the labels " + in_quotes(found->name) + " and " + in_quotes(other->name) +
                           " have one number or colour, so that nothing tells them apart");
        }
    } else if (std::isnan(rule.value)) {
        std::vector<std::string> known;
        known.reserve(names.size());
        for (const ValueName& one : names) {
            known.push_back(one.name);
        }
        fail_input(value_file(rule.name).value_or(rule.name),
                   "has no value called " + in_quotes(rule.value_name) +
                       (names.empty() ? ", as its values have no names"
                                      : did_you_mean(rule.value_name, known)));
    }
    return rule;
}

/// Parts that a rule left out, and the values that it found.
class RuleEffect {
  public:
    /// Takes out of the mask what the rule does not hold for.
    RuleEffect(const MaskRule& rule, const MeshFile& mesh, const MeshField* number, Mask& mask,
               const SplitFaces* split = nullptr)
        : rule_(rule) {
        const RuleValues found = values_for(rule, mesh, number, split);
        for (std::size_t t = 0; t < mask.size(); ++t) {
            const std::size_t face = split ? split->parts().parts()[t].face : t;
            bool holds = true;
            for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
                holds = regard(found.at(corner)) && holds; // All count for the range.
            }
            mask[t] = holds ? mask[t] : 0;
            leaves_out_ = leaves_out_ || (!holds && mesh.takes_part(face));
        }
    }

    bool leaves_out() const { return leaves_out_; }
    /// Returns the range of the values, such as "'green' is from 0 to 1".
    std::string range() const {
        return in_quotes(rule_.name) + " is from " + rounded(min_, 6) + " to " + rounded(max_, 6);
    }

  private:
    bool regard(double value) {
        min_ = std::min(min_, value);
        max_ = std::max(max_, value);
        return rule_.holds(value);
    }

    MaskRule rule_;
    bool leaves_out_ = false;
    double min_ = HUGE_VAL, max_ = -HUGE_VAL;
};

MeshWarning warning_of_all(const std::string& option, const std::string& range) {
    return {"mask_of_all", 1, "",
            option + " leaves out no face" + (range.empty() ? "" : ": " + range), ""};
}

/// Rules that all must hold, and what they found.
class RuleSet {
  public:
    /// `texts` are the rules as `option` has them, for warnings.
    RuleSet(const char* option, const std::vector<MaskRule>& rules,
            const std::vector<std::string>& texts, const MeshFile& mesh, const SplitFaces* split)
        : option_(option), rules_(rules), texts_(texts), mesh_(mesh), split_(split) {}

    /// Takes out of a mask of the faces of the file, which becomes one of parts, what a rule does
    /// not hold for.
    void apply(Mask& mask) {
        for (std::size_t i = 0; i < rules_.size(); ++i) {
            if (!rules_[i].is_map) {
                const bool is_axis = rules_[i].axis().has_value();
                const MeshField* const number = is_axis ? nullptr : &mesh_.number(rules_[i].name);
                note(RuleEffect(is_axis ? rules_[i] : with_value(rules_[i], *number), mesh_, number,
                                mask),
                     i);
            }
        }
        if (split_ != nullptr) {
            Mask of_parts;
            for (const FacePart& part : split_->parts().parts()) {
                of_parts.push_back(mask[part.face]);
            }
            mask = std::move(of_parts);
        }
        for (std::size_t i = 0; i < rules_.size(); ++i) {
            if (rules_[i].is_map) {
                note(RuleEffect(rules_[i], mesh_, nullptr, mask, split_), i);
            }
        }
    }

    /// Returns the ranges of the values, to end a message with; "" without rules.
    std::string ranges() const { return ranges_.empty() ? "" : ": " + ranges_; }
    /// Returns warnings of rules that leave out nothing.
    const std::vector<MeshWarning>& warnings() const { return warnings_; }

  private:
    void note(const RuleEffect& effect, std::size_t rule) {
        ranges_ += (ranges_.empty() ? "" : ", ") + effect.range();
        if (!effect.leaves_out()) {
            warnings_.push_back(
                warning_of_all(std::string(option_) + " " + texts_[rule], effect.range()));
        }
    }

    const char* option_;
    const std::vector<MaskRule>& rules_;
    const std::vector<std::string>& texts_;
    const MeshFile& mesh_;
    const SplitFaces* split_;
    std::string ranges_;
    std::vector<MeshWarning> warnings_;
};

bool is_empty(const Mask& mask) {
    return std::ranges::count(mask, 1) == 0;
}

void add_to(std::vector<MeshWarning>& warnings, const std::vector<MeshWarning>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

} // namespace

std::vector<std::uint8_t> faces_of(const OnlyRule& part, const std::string& path,
                                   const MeshFile& mesh) {
    return chosen_by(path, mesh, {part});
}

std::vector<std::uint8_t> faces_of(const MaskRule& rule, const std::string& path,
                                   const MeshFile& mesh) {
    const bool has_number = !rule.is_map && !rule.axis();
    const MeshField* const number = has_number ? &mesh.number(rule.name) : nullptr;
    Mask mask(mesh.triangle_count(), 1);
    const RuleEffect applied(has_number ? with_value(rule, *number) : rule, mesh, number, mask);
    for (std::size_t t = 0; t < mask.size(); ++t) {
        if (mask[t] != 0 && mesh.takes_part(t)) {
            return mask;
        }
    }
    fail_input(path, rule.option + " takes no face: " + applied.range());
}

LoadedMask load_mask(const MaskOptions& options, const std::string& path, const MeshFile& mesh,
                     const SplitFaces* split) {
    if (options.only.empty() && options.masks.empty()) {
        return {};
    }
    LoadedMask loaded{chosen_by(path, mesh, options.only_rules()), {}};
    Mask& mask = loaded.faces;
    bool leaves_out = false;
    for (std::size_t t = 0; t < mask.size(); ++t) {
        leaves_out = leaves_out || (mask[t] == 0 && mesh.takes_part(t));
    }
    if (!options.only.empty() && !leaves_out) {
        loaded.warnings.push_back(warning_of_all("--only", ""));
    }
    const std::vector<MaskRule> rules = options.mask_rules();
    RuleSet set("--mask", rules, options.masks, mesh, split);
    set.apply(mask);
    add_to(loaded.warnings, set.warnings());
    if (is_empty(mask)) {
        fail_input(path,
                   "has no face that " + options.of_all_classes().names() +
                       (options.only.empty() || options.masks.empty() ? " allows" : " allow") +
                       ", so " + options.lacking + set.ranges());
    }
    return loaded;
}

LoadedShares load_shares(const MaskOptions& options, const std::string& path, const MeshFile& file,
                         const PreparedMesh& mesh, const SplitFaces* split) {
    LoadedShares loaded;
    const std::vector<ClassPlace> places = options.class_places();
    if (places.empty()) {
        return loaded;
    }
    loaded.count = std::max(options.class_count, std::size_t{1} + places.back().number);
    const auto corners = split ? std::span(split->parts().triangles()) : std::span(file.triangles);
    loaded.shares.assign(loaded.count * corners.size(), 1);
    for (const ClassPlace& place : places) {
        const std::string name = "class " + std::to_string(place.number);
        const auto shares =
            std::span(loaded.shares).subspan(place.number * corners.size(), corners.size());
        Mask mask(file.triangle_count(), 1);
        RuleSet set("--class-mask", place.rules, place.texts, file, split);
        set.apply(mask);
        add_to(loaded.warnings, set.warnings());
        const std::vector<double> density =
            place.density ? density_parts(*place.density, path, file, mesh, split)
                          : std::vector<double>();
        bool has_room = false;
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            shares[corner] = mask[corner / 3] == 0 ? 0
                             : density.empty()     ? 1
                                                   : static_cast<float>(density[corners[corner]]);
            has_room = has_room || shares[corner] > 0;
        }
        if (!has_room) {
            fail_input(path, "has no face for " + name + " by --class-mask and --class-density" +
                                 set.ranges());
        }
    }
    return loaded;
}

} // namespace geodisk::tools
