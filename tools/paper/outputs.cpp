#include "paper/outputs.hpp"

#include <filesystem>
#include <iostream>
#include <list>
#include <sstream>
#include <utility>

#include <geodisk/version.hpp>

#include "files/output/output_file.hpp"
#include "paper/commit.hpp"
#include "picture/png.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {

std::string numbered(std::size_t i, std::size_t count) {
    return count > 1 ? "-" + std::to_string(i + 1) : "";
}

Outputs::Outputs(const std::string& folder, const std::string& name, bool has_plots)
    : prefix_((std::filesystem::path(folder) / name).string()) {
    tools::check_writable(prefix_ + ".csv");
    if (has_plots) {
        check_gnuplot();
    }
}

void Outputs::add_table(const Table& table, const std::vector<std::string>& circumstances,
                        const std::string& heading, const std::string& remarks) {
    std::cout << heading << "\n\n" << table.text() << '\n' << remarks << '\n';
    circumstances_ = "# geodisk " GEODISK_VERSION_STRING ", commit ";
    circumstances_ += kCommit;
    circumstances_ += kCommitIsDirty ? " with changes\n" : "\n";
    for (const std::string& line : circumstances) {
        circumstances_ += "# " + tools::csv_comment(line) + '\n';
    }
    std::istringstream caption(heading + ".\n" + remarks);
    for (std::string line; std::getline(caption, line);) {
        circumstances_ += "# " + line + '\n';
    }
    add_data("", table);
}

void Outputs::add_data(const std::string& ending, const Table& table) {
    files_.push_back({prefix_ + ending + ".csv", circumstances_ + table.csv()});
}

void Outputs::add_plot(const std::string& ending, const LinePlot& plot) {
    files_.push_back({prefix_ + ending + ".svg", svg_text(plot)});
}

void Outputs::add_picture(const std::string& ending, tools::picture::Pixels picture) {
    files_.push_back({prefix_ + ending + ".png", std::move(picture)});
}

void Outputs::write() const {
    std::list<tools::AtomicFile> written;
    for (const File& file : files_) {
        tools::AtomicFile& output = written.emplace_back(file.path);
        if (const auto* const text = std::get_if<std::string>(&file.content)) {
            output.write(*text);
        } else {
            tools::picture::write_png(output, std::get<tools::picture::Pixels>(file.content));
        }
        output.sync();
    }
    for (tools::AtomicFile& file : written) {
        file.commit();
    }
    std::cout << '\n';
    for (const File& file : files_) {
        std::cout << "file  " << tools::one_line(file.path) << '\n';
    }
    std::cout << std::flush;
    if (!std::cout) {
        tools::fail_output("the table cannot be written to standard output");
    }
}

} // namespace geodisk::paper
