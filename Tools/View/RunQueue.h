#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "Tools/View/DriverOptions.h"
#include "Tools/View/RunFolder.h"

namespace pendular::view {

/// Starts runs one after another, or a few at once; stops them, and goes on with them. A run that is under
/// way does not end with this server.
class RunQueue {
public:
    using Json = nlohmann::ordered_json;

    RunQueue(const RunFolder& runFolder, DriverOptions& driverOptions, std::size_t runsAtOnce)
        : runs(runFolder), drivers(driverOptions), atOnce(runsAtOnce) {}

    static constexpr std::size_t mostWaiting = 200;

    /// Puts a run into the queue; returns its id. Throws InputError.
    /// @param wish {"driver", "name" of its folder (empty: the driver's with a number), "options"}
    std::string start(const Json& wish);
    /// Whether such a run could be put into the queue. Throws InputError where not; makes nothing.
    void check(const Json& wish);
    /// Asks a run to stop after its step, with a restart file. One that waits is taken from the queue.
    void stop(const std::string& id);
    /// Goes on with a run from its restart file. Throws InputError.
    /// @param wish {"id", "options" that are to be others than before}
    void resume(const Json& wish);
    /// How a run is that this server has started, or was to start.
    struct Outcome {
        std::string state;   // "waiting", "running", "ended", "stopped", "failed"; empty: not of this server
        std::string reason;  // why it failed; empty: as it has said itself
    };
    [[nodiscard]] Outcome stateOf(const std::string& id);
    /// Looks after runs that have ended and starts the next; to be called a few times a second.
    void tend();

private:
    struct Job {
        std::string id, driver;
        std::filesystem::path folder;
        std::vector<std::string> arguments;
    };
    /// A folder that there is not yet. Throws InputError.
    [[nodiscard]] std::filesystem::path freeFolder(const std::string& driver,
                                                   const std::string& wished) const;
    void add(Job job);
    void startNext();

    const RunFolder& runs;
    DriverOptions& drivers;
    std::size_t atOnce;
    std::mutex mutex;
    std::deque<Job> queue;
    std::map<pid_t, Job> running;
    std::map<std::string, Outcome> outcomes;  // by id, of those that are over
};

}  // namespace pendular::view
