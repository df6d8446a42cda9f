#include "cli/manual_pages.h"

#include "cli/option_list.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

// As troff takes it: a backslash and a hyphen mean something else there, and so does a dot or quote that begins a line.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result.empty() || (result[0] != '.' && result[0] != '\'') ? result : "\\&" + result;
}

std::string heading(std::string title) {
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
    return fmt::format(".TH \"{}\" 1 \"\" \"quasilux {}\" \"quasilux\"\n", title, QUASILUX_VERSION);
}

std::string optionText(const ListedOption& option) {
    std::vector<std::string> names;
    for (const auto& name : option.names) names.push_back("\\fB" + escaped(name) + "\\fR");
    const std::string value =
        option.isPositional || option.value.empty() ? "" : " \\fI" + escaped(option.value) + "\\fR";
    return fmt::format(".TP\n{}{}\n{}\n", fmt::join(names, ", "), value, escaped(option.description));
}

std::string optionsText(CLI::App& command) {
    std::string text = ".SH OPTIONS\n", group;
    for (const ListedOption& option : listedOptions(command)) {
        if (!group.empty() && option.group != group) text += fmt::format(".SS \"{}\"\n", escaped(option.group));
        group = option.group;
        text += optionText(option);
    }
    return text;
}

std::string exitStatus() {
    return ".SH EXIT STATUS\n0: done. 1: the device or the program failed, or a limit was exceeded. 2: bad input. 128 "
           "+ the number of "
           "a signal: ended by it.\n";
}

} // namespace

std::string manualPage(CLI::App& program) {
    std::string text = heading("quasilux");
    text += ".SH NAME\nquasilux \\- photon\\-mapping renderer with quasi\\-specular elements\n";
    text += ".SH SYNOPSIS\n\\fBquasilux\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
    text += fmt::format(".SH DESCRIPTION\n{}\n.SH COMMANDS\n", escaped(program.get_description()));
    for (CLI::App* command : listedCommands(program))
        text += fmt::format(".TP\n\\fBquasilux\\-{}\\fR(1)\n{}\n", escaped(command->get_name()),
                            escaped(command->get_description()));
    return text + optionsText(program) + exitStatus();
}

std::string manualPageOf(CLI::App& command) {
    const std::string name = escaped(command.get_name());
    std::string text = heading("quasilux-" + command.get_name());
    text += fmt::format(".SH NAME\nquasilux\\-{} \\- {}\n", name, escaped(command.get_description()));
    text += fmt::format(".SH SYNOPSIS\n\\fBquasilux {}\\fR [\\fIOPTIONS\\fR]", name);
    for (const ListedOption& option : listedOptions(command))
        if (option.isPositional) text += fmt::format(" \\fI{}\\fR", escaped(option.names.front()));
    return text + "\n" + optionsText(command) + exitStatus() + ".SH SEE ALSO\n\\fBquasilux\\fR(1)\n";
}

} // namespace quasilux
