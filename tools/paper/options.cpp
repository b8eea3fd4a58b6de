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

void add_common_options(CLI::App& command, CommonOptions& options) {
    command.add_option("-o,--out", options.out, "Folder for the files, which must exist")
        ->type_name("DIR")
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
    command.add_option("--repeats", options.repeats, "Repetitions of each row, 1 to 1000")
        ->type_name("K")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
}

void add_meshes(CLI::App& command, std::vector<std::string>& meshes) {
    command.add_option("MESH", meshes, "Meshes: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
        ->type_name("")
        ->required();
}

void add_list(CLI::App& command, NumberList& list, const std::string& option,
              const std::string& what) {
    list.option = option;
    command.add_option(option, list.texts, what)
        ->type_name("X,...")
        ->delimiter(',')
        ->capture_default_str();
}

void add_device(CLI::App& command, std::string& device) {
    command.add_option("--device", device, "Device by name, index or UUID (geodisk info)")
        ->type_name("NAME|INDEX");
}

} // namespace geodisk::paper
