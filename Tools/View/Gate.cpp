#include "Tools/View/Gate.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::view {

namespace {

/// In a time that does not tell how many characters are right.
bool isSame(const std::string& given, const std::string& secret) {
    if (given.size() != secret.size()) return false;
    unsigned difference = 0;
    for (std::size_t k = 0; k < secret.size(); ++k)
        difference |= static_cast<unsigned char>(given[k]) ^ static_cast<unsigned char>(secret[k]);
    return difference == 0;
}

/// "[::1]:8123": "[::1]".
std::string withoutPort(const std::string& host) {
    const std::size_t colon = host.rfind(':');
    if (colon == host.npos || host.find(']', colon) != host.npos) return host;
    if (host.find_first_not_of("0123456789", colon + 1) != host.npos) return {};
    return host.substr(0, colon);
}

/// Names of hosts are the same in capitals.
std::string lowered(std::string name) {
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
}

/// Letters and digits as they are, all else by its code, so that it says nothing in a page.
std::string encoded(const std::string& text) {
    std::string result;
    for (const unsigned char c : text) {
        const bool isPlain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        result += isPlain ? std::string(1, static_cast<char>(c)) : fmt::format("%{:02X}", c);
    }
    return result;
}

/// Leads on to the page, of a run if one is named. A redirection would still count as asked for by the page
/// that led here, a file or a message, and the browser would keep back a cookie that is SameSite=Strict.
std::string leadsOn(const std::string& run) {
    const std::string to = run.empty() ? "." : ".#run=" + encoded(run);
    return fmt::format(
        "<!doctype html><html lang=\"en\"><meta http-equiv=\"refresh\" content=\"0; url={0}\">"
        "<link rel=\"icon\" href=\"data:,\"><title>Pendular</title><a href=\"{0}\">To the runs</a></html>\n",
        to);
}

}  // namespace

Gate::Gate(std::string secret, const std::set<std::string>& names, std::string cookieName)
    : token(std::move(secret)), cookie(std::move(cookieName)) {
    for (const std::string& name : names) hosts.insert(lowered(name));
}

bool Gate::isKnownHost(const std::string& host) const {
    return host.size() < 256 && hosts.contains(lowered(withoutPort(host)));
}

std::optional<Reply> Gate::refuseChange(const Request& request) const {
    if (request.mark.empty() ||
        (request.origin != "http://" + request.host && request.origin != "https://" + request.host))
        return sentence(403, "Only the page of this server may ask for this.");
    if (request.contentType != "application/json")
        return sentence(415, "The content must be application/json.");
    if (request.bodyIsTooLong)
        return sentence(413, fmt::format("The request is longer than {} bytes.", longestBody));
    return {};
}

std::optional<Reply> Gate::answer(const Request& request) const {
    if (request.method != "GET" && request.method != "POST")
        return sentence(405, "Only GET and POST are answered.");
    if (!isKnownHost(request.host))
        return sentence(403, "The server is not known by this name: start it with --host-name NAME.");
    if (request.method == "GET" && isSame(request.asked("token"), token))
        return Reply{
            200,
            "text/html; charset=utf-8",
            leadsOn(request.asked("run")),
            {{"Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", cookie, token)}}};
    if (!isSame(request.cookie, token))
        return sentence(403, "Open the address that the program view has printed; it has the token.");
    if (request.method == "POST") return refuseChange(request);
    if (!request.body.empty() || request.bodyIsTooLong) return sentence(400, "GET has no content.");
    return {};
}

std::string newToken() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw InputError("view: this system gives no random numbers, so that there can be no token.");
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

}  // namespace pendular::view
