#include "geodisk/commands/help_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kExitStatus = R"(
Exit status:
  0    success
  1    verify found samples too close, misplaced or with a wrong radius, or a gap; some meshes
       of a list failed; conformance found a set that differs
  2    wrong usage: an unknown option, no distance or several, a value out of range
  3    an input file is missing, unreadable or malformed
  4    an output cannot be written
  5    no Vulkan device that can run geodisk
  6    the work does not fit into the memory of the host or the device
  7    the device was lost, or an error or crash inside geodisk or the driver
  130  interrupted (SIGINT)
  143  terminated (SIGTERM), or 128 + signal for SIGHUP and SIGQUIT
If the status is 2 or more, no output file is written or replaced, except for meshes of a list or
batch that are done.)";

} // namespace

std::string help_footer(std::span<const char* const> examples) {
    std::string text = "Examples:\n";
    for (const char* const example : examples) {
        text += std::string("  ") + example + '\n';
    }
    return text + kExitStatus;
}

} // namespace geodisk::tools
