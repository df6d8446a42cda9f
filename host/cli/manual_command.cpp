#include "cli/commands.h"

#include "cli/manual_pages.h"
#include "cli/option_list.h"
#include "output/atomic_file.h"
#include "util/error.h"

#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

void manualCommand(CLI::App& program, const std::string& folder) {
    const auto write = [&](const std::string& name, const std::string& text) {
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        std::error_code error;
        std::filesystem::create_directories(path.parent_path(), error);
        if (error)
            throw InputError(fmt::format("manual {}: the folder {} cannot be made: {}; name another one", folder,
                                         path.parent_path().string(), error.message()));
        writeText(path.string(), text);
    };
    write("man/man1/quasilux.1", manualPage(program));
    for (CLI::App* command : listedCommands(program))
        write(fmt::format("man/man1/quasilux-{}.1", command->get_name()), manualPageOf(*command));
    write("bash-completion/completions/quasilux", bashCompletion(program));
    write("zsh/site-functions/_quasilux", zshCompletion(program));
    write("fish/vendor_completions.d/quasilux.fish", fishCompletion(program));
}

} // namespace quasilux
