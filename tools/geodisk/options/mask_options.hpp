// The options that say where samples may lie, the same for every command that takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/output/files_in_use.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/options/density_options.hpp"
#include "geodisk/options/option_use.hpp"

namespace geodisk::tools {

class Command;

/// A part of a mesh that takes samples.
struct OnlyRule {
    enum class Kind { material, group, node, part, outside };

    Kind kind = Kind::material;
    std::string name; ///< Name or number; of a part, its number; "" for what is outside.
    double share = 0; ///< Of the rays of a face, for what is outside.
    std::string text; ///< As given.
    std::string option = "--only";
};

/// A comparison that holds where samples may lie.
struct MaskRule {
    enum class Comparison { less, at_most, equal, unequal, at_least, greater };

    bool is_map = false; ///< Grey of an image; else a property of faces or vertices.
    std::string name;    ///< Image, property, or "file:" and a file of values.
    Comparison comparison = Comparison::at_least;
    double value = 0;
    std::string value_name{}; ///< As given for values of a file, which may have names. Or "".
    std::string option = "--mask";
    bool has_comparison = true; ///< As given; else a file of shares, white from one half on.

    /// False for a value that is not a number.
    bool holds(double of) const;
    /// The axis of x, y and z, or of x0 to x7.
    std::optional<std::size_t> axis() const;
};

/// Where samples of one class may lie, and how dense they are there.
struct ClassPlace {
    std::uint8_t number = 0;
    std::vector<std::string> texts; ///< Its rules, as given.
    std::vector<MaskRule> rules;
    std::optional<DensitySource> density;
};

/// As given on the command line.
struct MaskOptions {
    std::vector<std::string> only, masks;
    std::vector<std::string> class_masks, class_densities; ///< With the number of a class before.
    std::size_t class_count = 0;            ///< Number of --classes, where that is known.
    std::string lacking = "no samples fit"; ///< What follows from a mask that leaves nothing.

    bool is_given() const {
        return !only.empty() || !masks.empty() || !class_masks.empty() || !class_densities.empty();
    }
    /// Throw UserError(usage) for what they cannot read.
    std::vector<OnlyRule> only_rules() const;
    std::vector<MaskRule> mask_rules() const;
    /// The classes with rules or a density, by number.
    std::vector<ClassPlace> class_places() const;
    /// Checks all that can be read of the options without a mesh.
    void check(std::size_t classes) const;
    /// Adds the files that are read.
    void add_files(std::vector<NamedFile>& read) const;
    /// Puts `place(name)` for each file that is named.
    void place_files(const std::function<std::string(const std::string&)>& place);
    /// Name and value of what is given, as the header of a sample file names it.
    HeaderEntries entries() const;
    /// Returns the options that are for samples of all classes.
    MaskOptions of_all_classes() const {
        MaskOptions options = *this;
        options.class_masks.clear();
        options.class_densities.clear();
        return options;
    }
    /// Names the options that are given, for messages.
    std::string names() const;
};

/// Returns the part that a value of `option` names; nothing if its beginning is of no part. Throws
/// UserError(usage) for what is no number of a part, and no share.
std::optional<OnlyRule> parse_part(const std::string& option, const std::string& text);

/// Returns the rule that a value of `option` is. Throws UserError(usage) for one that is none.
MaskRule parse_mask(const std::string& option, const std::string& text);

/// Returns the file that a rule reads; nothing for a property of the mesh.
std::optional<std::string> file_of(const MaskRule& rule);

/// Puts `place(name)` for the file of a rule that is a value of `option`.
void place_file(const std::string& option, std::string& text,
                const std::function<std::string(const std::string&)>& place);

/// Returns `entries` with those of the options behind them.
HeaderEntries with_entries(HeaderEntries entries, const MaskOptions& options);

void add_mask_options(Command command, MaskOptions& options, OptionUse use);

} // namespace geodisk::tools
