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

void add_common_options(tools::Command command, CommonOptions& options) {
    command.add_option("-o,--out", options.out, "DIR", "Folder for the files, which must exist")
        .shows_default();
    command
        .add_reader(
            "--seed",
            [&options](const std::string& text) {
                options.seed = tools::parse_seed("--seed", text);
            },
            "S", "Seed of the first repetition; later ones count up")
        .shows_default("1");
    command.add_option("--repeats", options.repeats, "K", "Repetitions of each row, 1 to 1000")
        .takes_range(1, 1000)
        .shows_default();
}

void add_meshes(tools::Command command, std::vector<std::string>& meshes) {
    command.add_option("MESH", meshes, "", "Meshes: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
        .required();
}

void add_list(tools::Command command, NumberList& list, const std::string& option,
              const std::string& what) {
    list.option = option;
    command.add_option(option, list.texts, "X,...", what).takes_commas().shows_default();
}

void add_device(tools::Command command, std::string& device) {
    command.add_option("--device", device, "NAME|INDEX",
                       "Device by name, index or UUID (geodisk info)");
}

std::uint32_t PanelSize::pixels() const {
    constexpr double kFewest = 16, kMax = 4096;
    return static_cast<std::uint32_t>(tools::parse_ratio("--size", text, kFewest, kMax));
}

void add_panel_size(tools::Command command, PanelSize& size) {
    command.add_option("--size", size.text, "W", "Pixels along each side of a picture, 16 to 4096")
        .shows_default();
}

} // namespace geodisk::paper
