// Opens the page in the user's browser.
#pragma once

#include "util/temporary_folder.h"

#include <string>

namespace quasilux {

/// Whether there is a desktop to show it.
bool hasDesktop();

/// Asks the desktop to show an address, by a file that only this user can read: a command line can be read by all
/// users, and the address has the token. The file goes with this object.
class OpenedPage {
public:
    /// Nothing happens where there is no program that opens addresses.
    explicit OpenedPage(const std::string& address);

private:
    TemporaryFolder folder_;
};

} // namespace quasilux
