#include <cstdio>

#include <CLI/CLI.hpp>

#include "common/user_error.hpp"
#include "geodisk/cmd_info.hpp"

int main(int argc, char** argv) {
    CLI::App app("geodisk");
    geodisk::tools::add_info_command(app);
    CLI11_PARSE(app, argc, argv);
    return 0;
}
