#include "program/completion.hpp"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "geodisk/commands/commands.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {

void add_completion_command(Command app) {
    const Command command = app.add_hidden_command(
        "completion", "Print the script that completes commands and options in a shell");
    const auto shell = std::make_shared<std::string>();
    command.add_option("SHELL", *shell, "", "bash or zsh").required();
    command.calls([app, shell] {
        check_choice("SHELL", *shell, std::vector<std::string>{"bash", "zsh"});
        std::cout << (*shell == "bash" ? bash_completion(app.facts(), "quick")
                                       : zsh_completion(app.facts(), "quick"));
        flush_or_fail("the script");
    });
}

} // namespace geodisk::tools
