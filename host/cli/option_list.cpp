#include "cli/option_list.h"

#include "cli/option_checks.h"

#include <algorithm>

namespace quasilux {

namespace {

ListedOption describe(CLI::Option& option) {
    ListedOption listed;
    for (const auto& name : option.get_snames()) listed.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) listed.names.push_back("--" + name);
    listed.isPositional = listed.names.empty();
    if (listed.isPositional) listed.names.push_back(option.get_name(true));
    if (option.get_items_expected_max() > 0) listed.value = option.get_type_name();
    listed.choices = choicesOf(option);
    listed.description = option.get_description();
    listed.group = option.get_group();
    return listed;
}

} // namespace

std::vector<ListedOption> listedOptions(CLI::App& command) {
    std::vector<ListedOption> options;
    std::vector<std::string> groups;
    for (CLI::Option* option : command.get_options()) {
        options.push_back(describe(*option));
        if (std::find(groups.begin(), groups.end(), options.back().group) == groups.end())
            groups.push_back(options.back().group);
    }
    const auto place = [&](const ListedOption& option) {
        return std::find(groups.begin(), groups.end(), option.group) - groups.begin();
    };
    std::stable_sort(options.begin(), options.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return options;
}

std::vector<CLI::App*> listedCommands(CLI::App& program) {
    return program.get_subcommands([](CLI::App*) { return true; });
}

} // namespace quasilux
