#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <sys/types.h>

#include "Tools/View/DriverOptions.h"
#include "Tools/View/RunFolder.h"
#include "Tools/View/StartLocks.h"

namespace pendular::view {

/// Starts runs one after another, or a few at once; stops them, and resumes them. A run that is under way
/// does not end with this server. Several servers may serve one folder, and programs that no server has
/// started may run in it: StartLocks.h keeps them apart.
class RunQueue {
public:
    using Json = nlohmann::ordered_json;

    RunQueue(const RunFolder& runFolder, DriverOptions& driverOptions, std::size_t runsAtOnce)
        : runs(runFolder), drivers(driverOptions), atOnce(runsAtOnce) {}

    static constexpr std::size_t mostWaiting = 200;

    /// Puts a run into the queue; returns its id. Throws InputError; there is no folder of it then.
    /// @param wish {"driver", "name" of its folder (empty: the driver's with a number), "options"}
    std::string start(const Json& wish);
    /// Whether such a run could be put into the queue. Throws InputError where not; makes nothing.
    void check(const Json& wish);
    /// Asks a run to stop after its step, with a restart file. One that waits is taken from the queue.
    /// Returns a sentence of what was done. Throws InputError where nothing of this run can be stopped here.
    std::string stop(const std::string& id);
    /// Resumes a run from its restart file. Throws InputError, also where it is under way, by whomever it was
    /// started. The options are on record when it is started, and not while it waits.
    /// @param wish {"id", "options" that are to be others than before}
    void resume(const Json& wish);
    /// How a run is that this server has started, or was to start.
    struct Outcome {
        std::string state;   // "waiting", "running", "ended", "stopped", "failed"; empty: not of this server
        std::string reason;  // why it failed; empty: as it has said itself
        double when = 0;     // s since 1970, when it was over
    };
    /// What its folder says since then is not in it: what is newer counts.
    [[nodiscard]] Outcome stateOf(const RunFiles& run);
    /// Looks after runs that have ended and starts the next; to be called a few times a second.
    void tend();
    /// The ids of the runs that wait.
    [[nodiscard]] std::vector<std::string> waiting();

private:
    struct Job {
        RunFiles run;
        std::string driver;
        Json options;
        std::vector<std::string> arguments;
        HeldLock turn;  // lockTurn()
    };
    /// The name of a folder that there is not yet. Throws InputError.
    [[nodiscard]] std::string freeFolder(const std::string& driver, const std::string& wished) const;
    [[nodiscard]] bool waits(const std::string& id) const;
    [[nodiscard]] bool computes(const std::string& id) const;
    void refuseMore() const;
    void add(Job job);
    void startAll();
    void startNext();
    [[nodiscard]] static pid_t begin(const Job& job, const std::filesystem::path& program);
    static void writeEnd(const Job& job, const Outcome& outcome);
    /// Asks the process of a run to stop, by whomever it was started; false: there is none.
    [[nodiscard]] bool stopDriver(const std::string& id) const;

    const RunFolder& runs;
    DriverOptions& drivers;
    std::size_t atOnce;
    std::mutex mutex;
    std::deque<Job> queue;
    std::map<pid_t, Job> running;
    std::map<std::string, Outcome> outcomes;  // by id, of those that are over
};

}  // namespace pendular::view
