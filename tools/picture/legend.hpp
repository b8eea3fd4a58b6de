// Legend of a picture, in a strip below it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "picture/picture.hpp"

namespace geodisk::tools::picture {

/// A class of samples in a legend.
struct LegendClass {
    std::uint64_t samples = 0;
    double min_distance = 0; ///< Distance of two samples of the class, in mesh units.
};

/// Facts that a legend shows.
struct LegendFacts {
    std::uint64_t samples = 0;
    /// Minimum distances in mesh units; they differ where radii vary.
    double smallest_distance = 0, largest_distance = 0;
    Style style = Style::disks; ///< Has a colour bar if its colours are a scale.
    bool has_lengths = true;    ///< The picture shows lengths of the mesh, so a bar can be one.
    /// Classes, which have an entry each in place of the minimum distances; none without classes.
    std::vector<LegendClass> classes{};
};

/// Returns the largest of 1, 2 and 5 times a power of ten that is at most `limit` > 0.
double round_below(double limit);

/// Returns the colour of a class, sRGB from 0 to 1.
glm::vec3 class_color(std::size_t number);

/// Returns the colour of the scale at `part`, 0 (dark) to 1 (light), as sRGB from 0 to 1.
glm::vec3 scale_color(double part);

class Legend {
  public:
    /// Lays it out below a view; both share `width` x `height` pixels. Words are left out where
    /// there is little room. Throws UserError(usage) if even that does not fit.
    Legend(const LegendFacts& facts, std::uint32_t width, std::uint32_t height);

    std::uint32_t height() const { return height_; }

    /// Scales that are known once the view is drawn.
    struct Scale {
        double pixels_per_unit = 0; ///< Pixels per unit of the mesh, in the middle of the scene.
        double densest = 0;         ///< The end of the scale of Style::density, samples per area.
    };

    /// Draws it into the strip whose upper left corner is (x, y).
    void draw(Pixels& pixels, const Background& background, std::uint32_t x, std::uint32_t y,
              const Scale& scale) const;

  private:
    enum class Kind { text, class_entry, length, distance, density };
    struct Item {
        Kind kind;
        std::string text; ///< Text; for a colour bar, the words beside it.
        double width;
        std::size_t number = 0; ///< Class of an entry.
        double x = 0, y = 0;    ///< Start of the item; y is the upper end of a bar.
    };
    struct Strip;

    bool lay_out(const LegendFacts& facts, double em, bool is_short, std::uint32_t width,
                 double most);
    void draw_class(Strip& strip, const Item& item) const;
    void draw_length(Strip& strip, const Item& item, double pixels_per_unit) const;
    void draw_colors(Strip& strip, const Item& item, double densest) const;
    double bar_width(Kind kind) const;

    double em_ = 0; ///< Size of letters in pixels.
    bool is_short_ = false;
    std::uint32_t height_ = 0;
    std::vector<Item> items_;
};

} // namespace geodisk::tools::picture
