// The option --classes, the same for every command that takes it, and the classes that it asks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "files/output/files_in_use.hpp"
#include "geodisk/options/option_use.hpp"
#include "geometry/surface_disk.hpp"

namespace geodisk::tools {

class Command;

/// Classes of samples and how far they must be apart.
struct ClassTable {
    std::size_t count = 0; ///< 0 if samples have no classes.
    /// Distances in mesh units, count * count, row by row; empty if they follow from the minimum
    /// distance of each class.
    std::vector<double> distances;

    bool is_given() const { return count != 0; }
    /// Returns the largest distance, if there are distances.
    double largest() const;
    /// Returns the distance of samples of two classes as a part of the largest.
    double factor(std::size_t a, std::size_t b) const;
    /// Returns the distance of samples of two classes in mesh units, `min_distance` being the
    /// largest one.
    double distance(std::size_t a, std::size_t b, double min_distance) const {
        return factor(a, b) * min_distance;
    }
    /// Returns the radius of samples of a class: half of their distance from each other.
    double radius(std::size_t a, double min_distance) const {
        return distance(a, a, min_distance) / 2;
    }
    /// Returns true if some class has another radius than half of the largest distance.
    bool has_radii() const;
    /// Returns all distances in mesh units; none for a single class, which is like none.
    ClassDistances in_mesh_units(double min_distance) const;
    /// Returns SampleParams::class_factors: empty for a single class.
    std::vector<float> factors() const;
    /// Returns what parse_classes() reads the table from, with `min_distance` as the largest one.
    std::string text(double min_distance) const;
};

/// Returns a factor of two classes as SampleParams::class_factors takes it.
float class_factor(double factor);

/// Reads the number of classes, or a table of distances: from the text, rows divided by semicolons,
/// or else from the file that it names. Throws UserError for what is neither.
ClassTable parse_classes(const std::string& text);

/// What an option says of a single class.
struct OfClass {
    std::uint8_t number;
    std::string text;

    /// Returns it as the option takes it.
    std::string joined() const { return std::to_string(number) + ":" + text; }
};

/// Reads CLASS:TEXT, as `option` takes it. Throws UserError(usage) for what is not.
OfClass parse_of_class(const std::string& option, const std::string& text);

/// Throws UserError(usage) unless there are `count` classes and this is one of them.
void check_of_class(const std::string& option, const OfClass& own, std::size_t count);

/// Returns true for a table, which has all distances, read or not.
bool has_distances(const std::string& text);
/// Returns true if parse_classes() reads a file.
bool names_class_file(const std::string& text);
/// Adds that file.
void add_class_file(const std::string& text, std::vector<NamedFile>& read);
/// Puts `place(name)` for that file.
void place_class_file(std::string& text,
                      const std::function<std::string(const std::string&)>& place);

void add_class_option(Command command, std::string& text, OptionUse use,
                      const std::string& group = "Options");

} // namespace geodisk::tools
