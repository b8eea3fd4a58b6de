#include "program/completion.hpp"

#include <iostream>
#include <memory>
#include <string>

#include "geodisk/commands/commands.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

void add_completion_command(Command app) {
    const Command command = app.add_hidden_command(
        "completion", "Print the script that completes commands and options in a shell");
    const auto shell = std::make_shared<std::string>();
    command.add_option("SHELL", *shell, "", "bash or zsh").required();
    command.calls([app, shell] {
        if (*shell != "bash" && *shell != "zsh") {
            fail_usage("SHELL: " + in_quotes(*shell) + " is neither bash nor zsh");
        }
        std::cout << (*shell == "bash" ? bash_completion(app.facts())
                                       : zsh_completion(app.facts()));
        flush_or_fail("the script");
    });
}

} // namespace geodisk::tools
