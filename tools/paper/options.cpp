#include "paper/options.hpp"

#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {

std::vector<double> NumberList::counts() const {
    std::vector<double> values;
    for (const std::string& text : texts) {
        values.push_back(tools::parse_count(option, text));
    }
    return values;
}

std::vector<double> NumberList::ratios(double low, double high) const {
    std::vector<double> values;
    for (const std::string& text : texts) {
        values.push_back(tools::parse_ratio(option, text, low, high));
    }
    return values;
}

std::string CommonOptions::text() const {
    return "repeats " + std::to_string(repeats) + " from seed " + std::to_string(seed);
}

void add_common_options(CLI::App& command, CommonOptions& options) {
    tools::add_option(command, "-o,--out", options.out, "DIR",
                      "Folder for the files, which must exist")
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--seed",
            [&options](const std::string& text) {
                options.seed = tools::parse_seed("--seed", text);
            },
            "Of the first repetition; the next ones count up")
        ->type_name("S")
        ->default_str("1");
    tools::add_option(command, "--repeats", options.repeats, "K",
                      "Repetitions of each row, 1 to 1000")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
}

void add_meshes(CLI::App& command, std::vector<std::string>& meshes) {
    tools::add_option(command, "MESH", meshes, "",
                      "Meshes: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
        ->required();
}

void add_list(CLI::App& command, NumberList& list, const std::string& option,
              const std::string& what) {
    list.option = option;
    tools::add_option(command, option, list.texts, "X,...", what)
        ->delimiter(',')
        ->capture_default_str();
}

void add_device(CLI::App& command, std::string& device) {
    tools::add_option(command, "--device", device, "NAME|INDEX",
                      "Device by name, index or UUID (geodisk info)");
}

std::uint32_t PanelSize::pixels() const {
    constexpr double kFewest = 16, kMost = 4096;
    return static_cast<std::uint32_t>(tools::parse_ratio("--size", text, kFewest, kMost));
}

void add_panel_size(CLI::App& command, PanelSize& size) {
    tools::add_option(command, "--size", size.text, "W",
                      "Pixels along each side of a picture, 16 to 4096")
        ->capture_default_str();
}

} // namespace geodisk::paper
