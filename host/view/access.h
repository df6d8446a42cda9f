// Who may talk to the live view: whoever knows its token, by an address that is ours.
#pragma once

#include <string>

namespace quasilux {

class Access {
public:
    /// `listen`: the address that the server listens on. Throws std::runtime_error where the system has no random
    /// bytes.
    explicit Access(const std::string& listen);

    /// 128 random bits, hexadecimal.
    const std::string& token() const { return token_; }
    /// Takes as long for a token that is nearly right as for any other of its length.
    bool isToken(const std::string& said) const;
    /// Whether the Host header of a request names this server. A page from elsewhere whose name was made to mean this
    /// computer (DNS rebinding) still has its own name in there.
    bool isOurHost(const std::string& host, int port) const;

private:
    bool isOurName(const std::string& name) const;

    std::string listen_, token_;
};

/// Whether only programs of this computer reach the address.
bool isLoopback(const std::string& address);
/// By which others know this computer, in small letters.
std::string computerName();

} // namespace quasilux
