#pragma once

#include <optional>
#include <set>
#include <string>

#include "Tools/View/Request.h"

namespace pendular::view {

/// Decides who may ask at all. A page of another site may make the browser send requests here, and a name of
/// its own may lead to this machine (DNS rebinding): so the Host must be a known name, the token must have
/// been given, and what changes something must come from our own page.
class Gate {
public:
    /// @param token that the printed address has; it moves into a cookie
    /// @param hosts names by which the server may be asked, without the port
    /// @param cookie its name
    Gate(std::string token, const std::set<std::string>& hosts, std::string cookie);

    static constexpr std::size_t longestBody = 65536;  // bytes

    /// The refusal, or the way on of one who brings the token in the address; nothing: the request may pass.
    [[nodiscard]] std::optional<Reply> answer(const Request& request) const;

private:
    [[nodiscard]] bool isKnownHost(const std::string& host) const;
    [[nodiscard]] std::optional<Reply> refuseChange(const Request& request) const;

    std::string token, cookie;
    std::set<std::string> hosts;
};

/// 128 random bits of the operating system, as 32 digits.
std::string newToken();

}  // namespace pendular::view
