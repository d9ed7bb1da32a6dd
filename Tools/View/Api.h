#pragma once

#include <filesystem>
#include <mutex>

#include "Tools/View/DriverOptions.h"
#include "Tools/View/Gate.h"
#include "Tools/View/Request.h"
#include "Tools/View/RunFolder.h"
#include "Tools/View/RunQueue.h"

namespace pendular::view {

/// What the server answers: the page's own files, and beneath api/ what it asks.
///
/// GET   api/runs                        overviews (RunState.h), newest first
///       api/run?id=                     details
///       api/frame?id=&frame=&field=&orRadius=&wallField=&bridges=&contacts=&droplets=&origin=x,y,z
///                                       a frame (FramePack.h)
///       api/map?id=&name=&frame=&field=&normal=&slice=                 a field (FieldMaps.h)
///       api/row?id=&frame=&of=grains|contacts&row=                     fields of a grain or a contact
///       api/table?id=&name=&from=       rows of a table
///       api/drivers                     descriptions of the drivers' options
/// POST  api/start, api/check, api/stop, api/resume (RunQueue.h)
class Api {
public:
    struct Places {
        std::filesystem::path page;     // folder of the built page
        std::filesystem::path drivers;  // of programs: see DriverOptions
        std::vector<std::string> driverNames;
        std::string frameAncestors;  // of the content policy: who may show the page in a frame
        std::size_t memory = std::size_t{2000} << 20;  // bytes, for reading the files of a run
    };

    Api(Gate guard, const RunFolder& runFolder, Places where, std::size_t runsAtOnce)
        : gate(std::move(guard)),
          runs(runFolder),
          places(std::move(where)),
          drivers(places.drivers, places.driverNames),
          queue(runs, drivers, runsAtOnce) {}

    /// Never throws but for want of memory. May be called by several threads.
    [[nodiscard]] Reply answer(const Request& request);
    void tend() { queue.tend(); }
    /// The ids of the runs that wait to be started.
    [[nodiscard]] std::vector<std::string> waiting() { return queue.waiting(); }

private:
    [[nodiscard]] Reply route(const Request& request);
    [[nodiscard]] Reply change(const Request& request);
    [[nodiscard]] Reply ofRun(const Request& request, const RunFiles& run);
    // In a child process:
    [[nodiscard]] static Reply contentOf(const Request& request, const RunFiles& run);
    [[nodiscard]] static Reply frame(const Request& request, const RunFiles& run);
    [[nodiscard]] static Reply map(const Request& request, const RunFiles& run);

    [[nodiscard]] Reply list();
    [[nodiscard]] Reply pageFile(const std::string& path) const;
    void addQueue(DriverOptions::Json& overview, const RunFiles& run);

    Gate gate;
    const RunFolder& runs;
    Places places;
    DriverOptions drivers;
    RunQueue queue;
    std::mutex oneFrame;  // a frame is large: one at a time is in memory twice
};

}  // namespace pendular::view
