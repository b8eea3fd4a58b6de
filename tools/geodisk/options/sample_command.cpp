#include "geodisk/options/sample_command.hpp"

#include <vector>

#include "program/command.hpp"
#include "program/command_text.hpp"
#include "program/program.hpp"

namespace geodisk::tools {

void add_manifest_options(Command command, SampleOptions& options) {
    add_subject_options(command, options);
    add_text_options(command, options.out);
    add_columns_options(command, options.out);
    add_scene_options(command, options.out);
}

std::string sample_command(const SampleOptions& options) {
    SampleOptions given = options, usual;
    std::vector<std::string> words{"sample", options.mesh.mesh, "-o", options.out.output};
    const std::vector<std::string> more =
        words_of([&](Command command) { add_manifest_options(command, given); },
                 [&](Command command) { add_manifest_options(command, usual); });
    words.insert(words.end(), more.begin(), more.end());
    return command_text("geodisk", words);
}

} // namespace geodisk::tools
