/// Shows the runs in a folder in a browser: pictures in 3D, charts, a form for each driver; starts, stops and
/// goes on with runs.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <ctime>
#include <fstream>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/View/Api.h"
#include "Tools/View/Server.h"

using namespace pendular;
using namespace pendular::view;

namespace {

namespace fs = std::filesystem;

/// Where the page and the drivers are: beside this program in a build, below share/pendular in a package.
struct Installation {
    fs::path page, drivers;
    std::vector<std::string> driverNames;  // in a package: of the programs beside this one that are drivers

    Installation() {
        std::error_code problem;
        const fs::path own = fs::read_symlink("/proc/self/exe", problem).parent_path();
        page = own / "ViewPage", drivers = own.parent_path() / "Drivers";
        for (fs::path above = own; above.has_relative_path() && !fs::exists(page / "main.js", problem);
             above = above.parent_path())
            takeShared(above / "share/pendular", own);
    }

private:
    void takeShared(const fs::path& shared, const fs::path& own) {
        std::error_code problem;
        if (!fs::exists(shared / "drivers.txt", problem)) return;
        page = shared / "ViewPage", drivers = own;
        std::ifstream names(shared / "drivers.txt");
        for (std::string name; std::getline(names, name);) driverNames.push_back(name);
    }
};

struct Options {
    Installation installed;
    std::string folder = ".", listen = "127.0.0.1", page = installed.page.string(),
                drivers = installed.drivers.string();
    bool endsWithInput = false;
    int port = 0, atOnce = 1, memory = 2000;
    std::vector<std::string> hosts;
    std::string frameOf;
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    app.add_option("folder", o.folder, "with the folders of runs; new ones are made there");
    app.add_option("--port", o.port, "0: any that is free");
    app.add_option(
        "--listen", o.listen,
        "address to listen at. Any 127.x.y.z is of this machine alone; with another one, others in the "
        "network can read all that is sent: take ssh -L instead");
    app.add_option("--host-name", o.hosts,
                   "name by which a browser may ask besides localhost, as that of a proxy (Open OnDemand, "
                   "JupyterHub)")
        ->allow_extra_args(false);
    app.add_option(
        "--frame-of", o.frameOf,
        "page that may show this one in a frame, as http://localhost:8888 of a notebook. Both must "
        "be asked for by the same host name, or browsers keep the cookie back");
    app.add_option("--at-once", o.atOnce, "runs that are started from the page and compute at once");
    app.add_option("--memory-MB", o.memory, "that reading the files of a run for one answer may take, MB");
    app.add_option("--drivers", o.drivers, "folder of the drivers");
    app.add_option("--page", o.page, "folder of the built page");
    app.add_flag("--end-with-input", o.endsWithInput,
                 "ends when its standard input does, as with the program that has started it");
}

void check(const Options& o) {
    checkValue("view", "--port", o.port, "", {0, 65535});
    checkValue("view", "--at-once", o.atOnce, "", {1, 64});
    checkValue("view", "--memory-MB", o.memory, "MB", {200, 1e6});
    if (!std::filesystem::exists(std::filesystem::path(o.page) / "main.js"))
        throw InputError(
            fmt::format("view: the page is not in {}; view.sh of the source builds it.", o.page));
    if (o.frameOf.find_first_of(" ;,'\"\n") != std::string::npos)
        throw InputError("view: --frame-of must be one address, as http://localhost:8888.");
}

/// "http://localhost:8888/lab": "localhost".
std::string hostOf(const std::string& address) {
    const std::size_t slashes = address.find("://"), begin = slashes == address.npos ? 0 : slashes + 3;
    return address.substr(begin, address.find_first_of(":/", begin) - begin);
}

/// The name in the printed address. In a frame it must be that of the page around it: a cookie that is
/// SameSite=Strict is not sent to 127.0.0.1 from a page of localhost.
std::string printedHost(const Options& o) {
    if (!o.frameOf.empty()) {
        std::string around = hostOf(o.frameOf);
        for (char& c : around) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return around;
    }
    return o.listen == "0.0.0.0" ? "localhost" : o.listen;
}

/// Whether nothing more can come from the standard input; what comes is not looked at.
bool hasInputEnded() {
    pollfd input{0, POLLIN, 0};
    char ignored[256];
    return poll(&input, 1, 0) > 0 && read(0, ignored, sizeof ignored) <= 0;
}

/// Until Ctrl-C or SIGTERM, or the end of the input.
void serve(Api& api, Server& server, const sigset_t& ends, bool endsWithInput) {
    const timespec wait{0, 200'000'000};
    while (sigtimedwait(&ends, nullptr, &wait) < 0 && !(endsWithInput && hasInputEnded())) {
        server.tend();
        api.tend();
    }
}

/// Runs that wait end with the server: they were not started.
void sayWaiting(const std::vector<std::string>& ids) {
    if (!ids.empty())
        fmt::print("{} that waited {} not started: {}. Resume {} from the page to start {}.\n",
                   ids.size() == 1 ? "A run" : fmt::format("{} runs", ids.size()),
                   ids.size() == 1 ? "was" : "were", fmt::join(ids, ", "), ids.size() == 1 ? "it" : "them",
                   ids.size() == 1 ? "it" : "them");
}

/// Frames are large and gone soon: their memory goes back to the system at once, and is not kept for each
/// thread.
void giveBackMemory() {
    mallopt(M_ARENA_MAX, 2);
    mallopt(M_MMAP_THRESHOLD, 1 << 18);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

int run(const Options& o) {
    check(o);
    giveBackMemory();
    // Blocked before threads are made, which inherit that. Processes that are started get back what they had.
    sigset_t ends;
    sigemptyset(&ends), sigaddset(&ends, SIGINT), sigaddset(&ends, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ends, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told in a sentence, as a full disk is
    const RunFolder runs(o.folder);
    std::set<std::string> hosts{"localhost", "127.0.0.1", "[::1]", o.listen};
    hosts.insert(o.hosts.begin(), o.hosts.end());
    const std::string token = newToken(), cookie = "pendular-" + token.substr(0, 8);
    Api api({token, hosts, cookie}, runs,
            {o.page, o.drivers,
             o.drivers == o.installed.drivers ? o.installed.driverNames : std::vector<std::string>(),
             o.frameOf.empty() ? "'none'" : "'self' " + o.frameOf, static_cast<std::size_t>(o.memory) << 20},
            static_cast<std::size_t>(o.atOnce));
    Server server(api, o.listen, static_cast<std::uint16_t>(o.port), cookie);
    fmt::print(
        "Runs in {}. Open this address in a browser; Ctrl-C ends the server, not the runs.\n"
        "http://{}:{}/?token={}\n",
        runs.root().path().string(), printedHost(o), server.port(), token);
    std::fflush(stdout);
    serve(api, server, ends, o.endsWithInput);
    sayWaiting(api.waiting());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Shows the runs in a folder in a browser: pictures in 3D, charts, a form for each driver; starts, "
        "stops and goes "
        "on with runs.");
    Options options;
    describe(app, options);
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(options); });
}
