#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
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
    /// Asks a run to stop after its step, with a restart file. One that waits is taken from the queue.
    void stop(const std::string& id);
    /// Goes on with a run from its restart file. Throws InputError.
    /// @param wish {"id", "options" that are to be others than before}
    void resume(const Json& wish);
    /// "waiting", "running", "failed" (it ended with an error), or empty: of another time, or ended.
    [[nodiscard]] std::string stateOf(const std::string& id);
    /// Looks after runs that have ended and starts the next; to be called a few times a second.
    void tend();

private:
    struct Job {
        std::string id, driver;
        std::filesystem::path folder;
        std::vector<std::string> arguments;
    };
    [[nodiscard]] std::filesystem::path newFolder(const std::string& driver, const std::string& wished) const;
    void add(Job job);
    void startNext();

    const RunFolder& runs;
    DriverOptions& drivers;
    std::size_t atOnce;
    std::mutex mutex;
    std::deque<Job> queue;
    std::map<pid_t, Job> running;
    std::set<std::string> failed;  // ids
};

}  // namespace pendular::view
