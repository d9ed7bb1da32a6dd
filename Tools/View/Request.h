#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pendular::view {

/// What a browser asks, after the HTTP library has taken it apart. Fields that were not sent are empty.
struct Request {
    std::string method, path;  // "GET", "/api/runs"
    std::map<std::string, std::string> query;
    std::string host, origin, contentType, mark, cookie;  // mark: the header X-Pendular; cookie: ours
    std::string body;
    bool bodyIsTooLong = false;

    /// The value of a word of the query; empty where there is none.
    [[nodiscard]] std::string asked(const std::string& word) const {
        const auto found = query.find(word);
        return found == query.end() ? std::string() : found->second;
    }
};

struct Reply {
    int status = 200;
    std::string type = "application/json";
    std::string body{};
    std::vector<std::pair<std::string, std::string>> headers{};
};

/// An answer that is a sentence for the user.
inline Reply sentence(int status, std::string_view text) {
    return {status, "text/plain; charset=utf-8", std::string(text) + "\n"};
}

}  // namespace pendular::view
