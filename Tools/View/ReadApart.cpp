#include "Tools/View/ReadApart.h"

#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/ReadingProcess.h"
#include "Tools/View/RunState.h"

namespace pendular::view {

using Json = nlohmann::ordered_json;

namespace {

constexpr unsigned mostSeconds = 100;                        // of CPU time, for one answer
constexpr std::size_t longestAnswer = std::size_t{4} << 30;  // bytes

std::string unreadable(ReadingProcess& process) {
    return fmt::format("the process that read its files {}: one of them is damaged, or too large",
                       process.howItEnded());
}

/// Of a run of which no more can be told.
std::string unreadableOverview(const std::string& id, const std::string& reason) {
    return Json{{"id", id},         {"state", "silent"},  {"reason", reason},  {"driver", nullptr},
                {"time", nullptr},  {"endTime", nullptr}, {"grains", nullptr}, {"healthy", false},
                {"bytes", nullptr}, {"changed", 0.0}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string overviewText(const RunFolder& runs, const std::string& id, const Locks& locks) {
    const auto run = runs.find(id);  // of a thousand, one folder is open at a time
    return run ? overview(*run, locks).dump(-1, ' ', false, Json::error_handler_t::replace) : std::string();
}

}  // namespace

Reply replyOf(const std::function<Reply()>& compute) {
    try {
        return compute();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const InputError& problem) {
        return sentence(400, problem.what());
    } catch (const std::exception& problem) {
        return sentence(500,
                        fmt::format("The server has met a fault: {}.", withoutFullStop(sentenceOf(problem))));
    }
}

Reply readApart(std::size_t memory, const std::function<Reply()>& compute) {
    ReadingProcess process({memory, mostSeconds}, [&](const ReadingProcess::Channel& to) {
        const Reply reply = replyOf(compute);
        if (to.send(&reply.status, sizeof reply.status) && to.sendText(reply.type))
            static_cast<void>(to.sendText(reply.body));
    });
    const ReadingProcess::Channel& from = process.channel();
    Reply reply;
    if (from.receive(&reply.status, sizeof reply.status) && from.receiveText(reply.type, longestAnswer) &&
        from.receiveText(reply.body, longestAnswer))
        return reply;
    return sentence(400, fmt::format("This run cannot be shown: {}.", unreadable(process)));
}

std::vector<std::string> overviewsApart(std::size_t memory, const RunFolder& runs,
                                        const std::vector<std::string>& ids) {
    const Locks locks;
    std::vector<std::string> all;
    while (all.size() < ids.size()) {
        ReadingProcess process({memory, mostSeconds}, [&](const ReadingProcess::Channel& to) {
            for (std::size_t k = all.size(); k < ids.size(); ++k)
                if (!to.sendText(overviewText(runs, ids[k], locks))) return;
        });
        std::string text;
        while (all.size() < ids.size() && process.channel().receiveText(text, longestAnswer))
            all.push_back(text);
        if (all.size() < ids.size()) all.push_back(unreadableOverview(ids[all.size()], unreadable(process)));
    }
    return all;
}

}  // namespace pendular::view
