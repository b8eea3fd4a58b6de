#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <iostream>

#include "cli/command.hpp"

int main(int argc, char** argv) {
    using namespace geodisk::test;
    const TemporaryFolder folder;
    const Outcome info = run(folder, {"info"});
    if (info.status != 0) {
        std::cerr << "The tests of the command line need a device:\n" << info.err;
        return 1;
    }
    for (const std::string& line : lines_of(info.out)) {
        if (contains(line, "[default]")) {
            std::cout << "device " << line << '\n';
        }
    }
    doctest::Context context(argc, argv);
    return context.run();
}
