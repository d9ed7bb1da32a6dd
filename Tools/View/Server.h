#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "Tools/View/Api.h"

namespace pendular::view {

/// Takes requests by HTTP and has them answered. A connection is closed after one answer. One that has not
/// sent its request in `patience` is cut off, however it goes on sending; who takes nothing of an answer for
/// 120 s as well; a request has at most 16 kB of head and 64 kB of content; there are at most 200
/// connections, others wait.
class Server {
public:
    static constexpr int patience = 10;  // s
    static constexpr unsigned mostConnections = 200;

    /// @param address "127.0.0.1"; @param port 0: any that is free
    /// Throws InputError if it cannot listen there.
    Server(Api& api, const std::string& address, std::uint16_t port, std::string cookie);
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server();

    [[nodiscard]] std::uint16_t port() const;
    /// To be called a few times a second: cuts off those who are too slow.
    void tend();

private:
    struct Inside;
    std::unique_ptr<Inside> inside;
};

}  // namespace pendular::view
