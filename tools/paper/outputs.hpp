// The files of a figure: a table, plots and pictures.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "paper/line_plot.hpp"
#include "picture/picture.hpp"
#include "program/table.hpp"

namespace geodisk::paper {

using tools::Table;

/// Returns the end of the name of picture or plot `i` of so many, counted from 1; "" for the only
/// one.
std::string numbered(std::size_t i, std::size_t count);

/// Files that appear together, NAME.csv, plots and pictures.
class Outputs {
  public:
    /// Throws UserError(bad_output) if `folder` cannot take a file `name`.csv, or plots are to come
    /// and gnuplot is missing.
    Outputs(const std::string& folder, const std::string& name, bool has_plots = true);

    /// `name`.csv, below comment lines with program, circumstances, `heading` and `remarks`. Prints
    /// the table as well, between the latter two.
    void add_table(const Table& table, const std::vector<std::string>& circumstances,
                   const std::string& heading, const std::string& remarks);

    /// `name` + `ending`.csv, which is not printed; after add_table(), whose circumstances it has.
    void add_data(const std::string& ending, const Table& table);

    /// `name` + `ending`.png.
    void add_picture(const std::string& ending, tools::picture::Pixels picture);

    /// `name` + `ending`.svg.
    void add_plot(const std::string& ending, const LinePlot& plot);

    /// Writes all of them, or throws and writes none. Prints their names.
    void write() const;

  private:
    struct File {
        std::string path;
        std::variant<std::string, tools::picture::Pixels> content;
    };
    std::string prefix_; ///< Folder and name.
    std::string circumstances_;
    std::vector<File> files_;
};

} // namespace geodisk::paper
