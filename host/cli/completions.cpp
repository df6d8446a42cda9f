// What the shells bash, zsh and fish offer after "quasilux": commands, their options, values that options know, and
// files.
#include "cli/manual_pages.h"

#include "cli/option_list.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

std::vector<std::string> commandNames(CLI::App& program) {
    std::vector<std::string> names;
    for (CLI::App* command : listedCommands(program)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> optionNames(CLI::App& command) {
    std::vector<std::string> names;
    for (const ListedOption& option : listedOptions(command))
        if (!option.isPositional) names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

// Within single quotes of a shell; brackets and colons mean something to zsh, so that they become blanks there.
std::string quoted(const std::string& text, bool forZsh) {
    std::string result;
    for (const char c : text) {
        if (c == '\'')
            result += forZsh ? "'\\''" : "\\'";
        else if (forZsh && (c == '[' || c == ']' || c == ':'))
            result += ' ';
        else if (c == '\\')
            result += "\\\\";
        else
            result += c;
    }
    return result;
}

// What comes before further clauses and the default: a line has little room.
std::string shortened(const std::string& description) {
    size_t end = description.size();
    for (const char* mark : {". ", "; ", ": ", " ("}) end = std::min(end, description.find(mark));
    return description.substr(0, end);
}

std::string bashCases(CLI::App& command) {
    std::string text;
    for (const ListedOption& option : listedOptions(command)) {
        if (option.isPositional || option.value.empty()) continue;
        const std::string what = !option.choices.empty()
                                     ? fmt::format("compgen -W '{}' -- \"$word\"", fmt::join(option.choices, " "))
                                 : option.takesFile() ? "compgen -f -- \"$word\""
                                                      : "true";
        text += fmt::format("            {},{}) mapfile -t COMPREPLY < <({}); return ;;\n", command.get_name(),
                            fmt::join(option.names, "|" + command.get_name() + ","), what);
    }
    return text;
}

} // namespace

std::string bashCompletion(CLI::App& program) {
    std::string cases, options;
    for (CLI::App* command : listedCommands(program)) {
        cases += bashCases(*command);
        options += fmt::format("            {}) options='{}' ;;\n", command->get_name(),
                               fmt::join(optionNames(*command), " "));
    }
    return fmt::format("# Completion of quasilux for bash, made by quasilux {0}.\n"
                       "_quasilux() {{\n"
                       "    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} "
                       "command=${{COMP_WORDS[1]}} options=\n"
                       "    COMPREPLY=()\n"
                       "    if ((COMP_CWORD == 1)); then\n"
                       "        mapfile -t COMPREPLY < <(compgen -W '{1} {2}' -- \"$word\"; compgen -f -- \"$word\")\n"
                       "        return\n"
                       "    fi\n"
                       "    [[ ' {1} ' == *\" $command \"* ]] || command=render\n"
                       "    case $command,$before in\n"
                       "{3}"
                       "    esac\n"
                       "    case $command in\n"
                       "{4}"
                       "    esac\n"
                       "    if [[ $word == -* ]]; then\n"
                       "        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
                       "    else\n"
                       "        mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
                       "    fi\n"
                       "}}\n"
                       "complete -o filenames -F _quasilux quasilux\n",
                       QUASILUX_VERSION, fmt::join(commandNames(program), " "), fmt::join(optionNames(program), " "),
                       cases, options);
}

std::string zshCompletion(CLI::App& program) {
    std::string text = fmt::format("#compdef quasilux\n# Completion of quasilux for zsh, made by quasilux {}.\n"
                                   "local -a commands\ncommands=(\n",
                                   QUASILUX_VERSION);
    for (CLI::App* command : listedCommands(program))
        text += fmt::format("    '{}:{}'\n", command->get_name(), quoted(shortened(command->get_description()), true));
    text += ")\nif ((CURRENT == 2)); then\n    _describe command commands\n    _files\n    return\nfi\n"
            "local command=$words[2]\n((${commands[(I)$command:*]})) || command=render\nshift "
            "words\n((CURRENT--))\ncase $command in\n";
    for (CLI::App* command : listedCommands(program)) {
        text += fmt::format("{})\n    _arguments \\\n", command->get_name());
        for (const ListedOption& option : listedOptions(*command)) {
            if (option.isPositional) continue;
            std::string value;
            if (!option.value.empty())
                value = fmt::format(":{}:{}", quoted(option.value, true),
                                    !option.choices.empty() ? fmt::format("({})", fmt::join(option.choices, " "))
                                    : option.takesFile()    ? "_files"
                                                            : " ");
            for (const auto& name : option.names)
                text +=
                    fmt::format("        '{}[{}]{}' \\\n", name, quoted(shortened(option.description), true), value);
        }
        text += "        '*:file:_files'\n    ;;\n";
    }
    return text + "esac\n";
}

std::string fishCompletion(CLI::App& program) {
    std::string text = fmt::format("# Completion of quasilux for fish, made by quasilux {}.\n", QUASILUX_VERSION);
    for (CLI::App* command : listedCommands(program))
        text += fmt::format("complete -c quasilux -n __fish_use_subcommand -a {} -d '{}'\n", command->get_name(),
                            quoted(shortened(command->get_description()), false));
    for (CLI::App* command : listedCommands(program))
        for (const ListedOption& option : listedOptions(*command)) {
            if (option.isPositional) continue;
            text += fmt::format("complete -c quasilux -n '__fish_seen_subcommand_from {}'", command->get_name());
            for (const auto& name : option.names)
                text += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.choices.empty())
                text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
            else if (!option.value.empty())
                text += option.takesFile() ? " -r -F" : " -x";
            text += fmt::format(" -d '{}'\n", quoted(shortened(option.description), false));
        }
    return text;
}

} // namespace quasilux
