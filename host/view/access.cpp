#include "view/access.h"

#include <arpa/inet.h>
#include <array>
#include <fmt/format.h>
#include <netinet/in.h>
#include <stdexcept>
#include <unistd.h>

namespace quasilux {

namespace {

std::string randomToken() {
    std::array<unsigned char, 16> bytes{};
    if (getentropy(bytes.data(), bytes.size()) != 0)
        throw std::runtime_error("the system gives no random bytes, so that the view can have no secret address");
    std::string token;
    for (const unsigned byte : bytes) token += fmt::format("{:02x}", byte);
    return token;
}

bool isNumeric(const std::string& address) {
    in6_addr bytes{};
    return inet_pton(AF_INET, address.c_str(), &bytes) == 1 || inet_pton(AF_INET6, address.c_str(), &bytes) == 1;
}

// Of host names only these letters differ in case; browsers send small ones.
std::string inSmallLetters(std::string name) {
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
}

} // namespace

Access::Access(const std::string& listen) : listen_(inSmallLetters(listen)), token_(randomToken()) {}

bool Access::isToken(const std::string& said) const {
    if (said.size() != token_.size()) return false; // its length is no secret
    unsigned difference = 0;
    for (size_t k = 0; k < said.size(); ++k) difference |= static_cast<unsigned char>(said[k] ^ token_[k]);
    return difference == 0;
}

bool Access::isOurHost(const std::string& host, int port) const {
    const std::string end = ':' + std::to_string(port);
    std::string name = host;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
        name.resize(name.size() - end.size());
    else if (port != 80)
        return false;
    if (name.size() > 2 && name.front() == '[' && name.back() == ']') name = name.substr(1, name.size() - 2);
    return isOurName(inSmallLetters(name));
}

bool Access::isOurName(const std::string& name) const {
    if (name == listen_ || name == "localhost" || name == "127.0.0.1" || name == "::1") return true;
    // Numbers cannot be made to mean something else, as names can.
    return !isLoopback(listen_) && (isNumeric(name) || name == computerName());
}

std::string computerName() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? inSmallLetters(name.data()) : "";
}

bool isLoopback(const std::string& address) {
    return address == "localhost" || address == "::1" || (isNumeric(address) && address.rfind("127.", 0) == 0);
}

} // namespace quasilux
