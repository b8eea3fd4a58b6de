// The options that say what new samples must respect, the same for every command that samples.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/params.hpp>

#include "files/output/files_in_use.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/options/option_use.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

class Command;

/// A value of --avoid.
struct AvoidOption {
    /// Points and lines of a file, or edges of the mesh: its borders or its creases.
    enum class Kind { file, border, creases };

    Kind kind = Kind::file;
    std::string points; ///< File.
    std::optional<Length> radius;
    std::string column;                    ///< Column of radii, if there is no `radius`.
    std::uint8_t only_class = kAllClasses; ///< Class that is kept out.
};

/// As given on the command line.
struct ConstraintOptions {
    std::string existing;                 ///< File of samples to keep, or "".
    std::vector<std::string> avoid;       ///< Points and lines to avoid, with radii.
    std::vector<std::string> class_avoid; ///< The same for one class, with its number before it.
    std::string tolerance;                ///< For points without faces, or "".

    bool is_given() const { return !existing.empty() || !avoid.empty() || !class_avoid.empty(); }
    /// Returns true if points are read from a file.
    bool reads_points() const;
    /// Returns both kinds. Throws UserError(usage) for what is not POINTS:RADIUS.
    std::vector<AvoidOption> parsed_avoid() const;
    /// Throws UserError(usage) for options that contradict each other, and for a tolerance that is
    /// no length.
    void check() const;
    /// Throws UserError(usage) for points of a class if there are not so many.
    void check_classes(std::size_t count) const;
    /// Adds the files that are read.
    void add_files(std::vector<NamedFile>& read) const;
    /// Puts `place(name)` for each file that is named.
    void place_files(const std::function<std::string(const std::string&)>& place);
    /// Name and value of what is given, as the header of a sample file names it.
    HeaderEntries entries() const;
};

void add_constraint_options(Command command, ConstraintOptions& options);

/// Adds --avoid and --class-avoid alone.
void add_avoid_option(Command command, ConstraintOptions& options, OptionUse use,
                      const std::string& group = "Options");

} // namespace geodisk::tools
