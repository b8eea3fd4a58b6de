// The command `geodisk`: picks the subcommand and turns every failure into one line and an exit
// status.
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include <geodisk/version.hpp>

#include "common/user_error.hpp"
#include "geodisk/cmd_info.hpp"
#include "geodisk/cmd_sample.hpp"
#include "geodisk/cmd_shapes.hpp"
#include "geodisk/cmd_verify.hpp"
#include "geodisk/human_text.hpp"
#include "geodisk/interrupt.hpp"

namespace {

using geodisk::tools::ExitCode;
using geodisk::tools::UserError;

constexpr const char* kFooter = R"(Examples:
  geodisk sample builtin:showpiece -o points.ply --count 10000
  geodisk sample bunny.obj -o points.csv --min-distance 1%
  geodisk verify bunny.obj points.csv

Exit status:
  0    success
  1    verify found samples that are too close or do not lie on the mesh
  2    wrong usage: an unknown option, no or several distances, a value out of range
  3    an input file is missing, unreadable or malformed
  4    an output cannot be written
  5    no Vulkan device that can run geodisk
  6    the work does not fit into the memory of the host or the device
  7    the device was lost, or an error inside geodisk or the driver
  130  interrupted (SIGINT)
  143  terminated (SIGTERM)
Whenever the status is not 0, no output file is written or replaced.)";

int fail(ExitCode code, const std::string& message) {
    std::cout.flush();
    std::cerr << "geodisk: " << geodisk::tools::one_line(message) << '\n';
    return static_cast<int>(code);
}

/// Where the user finds the right usage.
std::string hint(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return " (see geodisk " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help)";
}

/// CLI11 counts values; people want to know what they did.
std::string usage_message(const CLI::ParseError& error) {
    const std::string message = error.what();
    const std::string option = message.substr(0, message.find(':'));
    if (message.find("At Most 1 required") != std::string::npos) {
        return option + " is given more than once";
    }
    if (message.find("1 required") != std::string::npos) {
        return option + " needs a value";
    }
    return message;
}

int run(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help(); // Of the subcommand if one is chosen.
        return 0;
    } catch (const CLI::CallForVersion& version) {
        std::cout << version.what() << '\n';
        return 0;
    } catch (const CLI::ParseError& error) {
        return fail(ExitCode::usage, usage_message(error) + hint(app));
    } catch (const UserError& error) {
        const bool is_usage = error.code() == ExitCode::usage;
        return fail(error.code(), error.what() + (is_usage ? hint(app) : ""));
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::out_of_memory, "the memory of this machine does not suffice");
    } catch (const std::exception& error) {
        return fail(ExitCode::internal, error.what());
    }
}

} // namespace

int main(int argc, char** argv) {
    geodisk::tools::install_signal_handlers();
    CLI::App app(
        "Random points on a triangle mesh, no two closer than a minimum distance along the "
        "surface",
        "geodisk");
    app.set_version_flag("--version", "geodisk " GEODISK_VERSION_STRING);
    app.require_subcommand(1);
    app.footer(kFooter);
    geodisk::tools::add_sample_command(app);
    geodisk::tools::add_verify_command(app);
    geodisk::tools::add_shapes_command(app);
    geodisk::tools::add_info_command(app);
    return run(app, argc, argv);
}
