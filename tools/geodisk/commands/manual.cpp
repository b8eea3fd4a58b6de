#include "program/manual.hpp"

#include <memory>
#include <string>

#include <geodisk/version.hpp>

#include "files/output/output_file.hpp"
#include "geodisk/commands/commands.hpp"

namespace geodisk::tools {

void add_manual_command(Command app) {
    const Command command = app.add_hidden_command("manual", "Write the manual pages");
    const auto folder = std::make_shared<std::string>();
    command.add_option("-o,--output", *folder, "DIR", "Folder to write to").required();
    command.calls([app, folder] {
        const CommandFacts program = app.facts();
        for (const ManualPage& page :
             manual_pages(program, program.name + " " GEODISK_VERSION_STRING)) {
            AtomicFile file(Path(*folder) / page.name);
            file.write(page.text);
            file.commit();
        }
    });
}

} // namespace geodisk::tools
