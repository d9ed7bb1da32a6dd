#include "Tools/View/Server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <sys/socket.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::view {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t headBytes = 16384;
constexpr unsigned silence = 20;          // s, in which nothing of a request is sent
constexpr unsigned readersSilence = 120;  // s, in which nothing of an answer is taken
constexpr std::size_t workers = 4;

/// Connections that have not sent their request yet.
class Senders {
public:
    void begin(int socket) {
        const std::scoped_lock one(mutex);
        since[socket] = Clock::now();
    }
    void end(int socket) {
        const std::scoped_lock one(mutex);
        since.erase(socket);
    }
    void cutOffSlow() {
        const std::scoped_lock one(mutex);
        for (const auto& [socket, begin] : since)
            if (Clock::now() - begin > std::chrono::seconds(Server::patience)) shutdown(socket, SHUT_RDWR);
    }

private:
    std::mutex mutex;
    std::map<int, Clock::time_point> since;
};

int socketOf(MHD_Connection* connection) {
    return MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
}

std::string valueOf(MHD_Connection* connection, MHD_ValueKind kind, const char* name) {
    const char* const text = MHD_lookup_connection_value(connection, kind, name);
    return text ? text : "";
}

MHD_Result addWord(void* query, MHD_ValueKind, const char* name, std::size_t nameLength, const char* value,
                   std::size_t valueLength) {
    auto& words = *static_cast<std::map<std::string, std::string>*>(query);
    words.try_emplace({name, nameLength}, value ? std::string(value, valueLength) : "");
    return MHD_YES;
}

void readHead(Request& request, MHD_Connection* c, const char* path, const char* method,
              const std::string& cookie) {
    request.method = method, request.path = path;
    request.host = valueOf(c, MHD_HEADER_KIND, "Host");
    request.origin = valueOf(c, MHD_HEADER_KIND, "Origin");
    request.contentType = valueOf(c, MHD_HEADER_KIND, "Content-Type");
    request.mark = valueOf(c, MHD_HEADER_KIND, "X-Pendular");
    request.cookie = valueOf(c, MHD_COOKIE_KIND, cookie.c_str());
    MHD_get_connection_values_n(c, MHD_GET_ARGUMENT_KIND, &addWord, &request.query);
}

MHD_Result send(MHD_Connection* connection, Reply reply) {
    auto* const body = new std::string(std::move(reply.body));
    MHD_Response* const response = MHD_create_response_from_buffer_with_free_callback_cls(
        body->size(), body->data(), [](void* text) { delete static_cast<std::string*>(text); }, body);
    if (!response) return MHD_NO;
    MHD_add_response_header(response, "Content-Type", reply.type.c_str());
    MHD_add_response_header(response, "Connection", "close");
    for (const auto& [name, value] : reply.headers)
        MHD_add_response_header(response, name.c_str(), value.c_str());
    const MHD_Result done = MHD_queue_response(connection, static_cast<unsigned>(reply.status), response);
    MHD_destroy_response(response);
    return done;
}

}  // namespace

/// A request, and its answer once that is there.
struct Exchange {
    Request request;
    std::optional<Reply> reply{};
    bool isAnswered = false;  // also where there was no memory for a reply
};

/// Computes answers in threads of their own, so that the one that sends and takes never waits for them: the
/// time of a slow sender is its own.
class Workers {
public:
    explicit Workers(Api& answers) : api(answers) {
        for (std::size_t k = 0; k < workers; ++k) threads.emplace_back([this] { work(); });
    }
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    ~Workers() { end(); }

    /// The connection sleeps until there is an answer. False: the server ends.
    bool take(MHD_Connection* connection, Exchange& exchange) {
        const std::scoped_lock one(mutex);
        if (isOver) return false;
        MHD_suspend_connection(connection);
        waiting.emplace_back(connection, &exchange);
        some.notify_one();
        return true;
    }
    /// Wakes all connections; those without an answer are closed.
    void end() {
        {
            const std::scoped_lock one(mutex);
            isOver = true;
        }
        some.notify_all();
        for (std::thread& thread : threads)
            if (thread.joinable()) thread.join();
        for (const auto& [connection, exchange] : std::exchange(waiting, {})) wake(connection, *exchange);
    }

private:
    static void wake(MHD_Connection* connection, Exchange& exchange) {
        exchange.isAnswered = true;
        MHD_resume_connection(connection);
    }
    void work() {
        for (;;) {
            std::unique_lock lock(mutex);
            some.wait(lock, [&] { return isOver || !waiting.empty(); });
            if (isOver) return;
            const auto [connection, exchange] = waiting.front();
            waiting.pop_front();
            lock.unlock();
            try {
                exchange->reply = api.answer(exchange->request);
            } catch (const std::exception&) {
                exchange->reply.reset();  // no memory: the connection is closed
            }
            wake(connection, *exchange);
        }
    }

    Api& api;
    std::mutex mutex;
    std::condition_variable some;
    std::deque<std::pair<MHD_Connection*, Exchange*>> waiting;
    bool isOver = false;
    std::vector<std::thread> threads;
};

struct Server::Inside {
    Workers workers;
    std::string cookie;
    Senders senders{};
    MHD_Daemon* daemon = nullptr;

    Inside(Api& api, std::string name) : workers(api), cookie(std::move(name)) {}

    /// Called when the head is there, for each piece of the content, at its end, and when the answer is
    /// there. An exception must not reach the library, which is in C.
    static MHD_Result take(void* self, MHD_Connection* c, const char* path, const char* method, const char*,
                           const char* piece, std::size_t* size, void** state) {
        auto& inside = *static_cast<Inside*>(self);
        try {
            if (!*state) {
                *state = new Exchange;
                readHead(static_cast<Exchange*>(*state)->request, c, path, method, inside.cookie);
                return MHD_YES;
            }
            Exchange& exchange = *static_cast<Exchange*>(*state);
            Request& request = exchange.request;
            if (*size > 0) {
                if (request.body.size() + *size > Gate::longestBody)
                    request.bodyIsTooLong = true, request.body.clear();
                else if (!request.bodyIsTooLong) request.body.append(piece, *size);
                *size = 0;
                return MHD_YES;
            }
            if (exchange.isAnswered) return exchange.reply ? send(c, std::move(*exchange.reply)) : MHD_NO;
            inside.senders.end(socketOf(c));
            MHD_set_connection_option(c, MHD_CONNECTION_OPTION_TIMEOUT, readersSilence);
            return inside.workers.take(c, exchange) ? MHD_YES : MHD_NO;
        } catch (const std::exception&) {
            return MHD_NO;  // no memory: the connection is closed
        }
    }
    static void forget(void*, MHD_Connection*, void** state, MHD_RequestTerminationCode) {
        delete static_cast<Exchange*>(*state);
        *state = nullptr;
    }
    static void watch(void* self, MHD_Connection* c, void**, MHD_ConnectionNotificationCode what) {
        auto& inside = *static_cast<Inside*>(self);
        if (what == MHD_CONNECTION_NOTIFY_STARTED) inside.senders.begin(socketOf(c));
        else inside.senders.end(socketOf(c));
    }
};

Server::Server(Api& api, const std::string& address, std::uint16_t port, std::string cookie)
    : inside(std::make_unique<Inside>(api, std::move(cookie))) {
    sockaddr_in place{};
    place.sin_family = AF_INET, place.sin_port = htons(port);
    if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
        throw InputError(fmt::format("view: --listen = '{}'; it must be an address as 127.0.0.1.", address));
    inside->daemon = MHD_start_daemon(
        MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME, port, nullptr, nullptr, &Inside::take,
        inside.get(), MHD_OPTION_SOCK_ADDR, &place, MHD_OPTION_NOTIFY_COMPLETED, &Inside::forget, nullptr,
        MHD_OPTION_NOTIFY_CONNECTION, &Inside::watch, inside.get(), MHD_OPTION_CONNECTION_LIMIT,
        mostConnections, MHD_OPTION_CONNECTION_TIMEOUT, silence, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
        headBytes, MHD_OPTION_END);
    if (!inside->daemon)
        throw InputError(fmt::format("view: the port {} of {} cannot be had: {}; give another one (--port).",
                                     port, address, std::strerror(errno)));
}

Server::~Server() {
    inside->workers.end();
    MHD_stop_daemon(inside->daemon);
}

std::uint16_t Server::port() const {
    return MHD_get_daemon_info(inside->daemon, MHD_DAEMON_INFO_BIND_PORT)->port;
}

void Server::tend() { inside->senders.cutOffSlow(); }

}  // namespace pendular::view
