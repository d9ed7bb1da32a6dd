#include "Tools/View/Api.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Tools/View/FieldMaps.h"
#include "Tools/View/FramePack.h"
#include "Tools/View/NameText.h"
#include "Tools/View/ReadApart.h"
#include "Tools/View/ReadJson.h"
#include "Tools/View/RunState.h"

namespace pendular::view {

using Json = DriverOptions::Json;

namespace {

/// Files of the page and their types; no others are read.
const std::map<std::string, std::pair<std::string, std::string>> pageFiles{
    {"/", {"index.html", "text/html; charset=utf-8"}},
    {"/main.js", {"main.js", "text/javascript; charset=utf-8"}},
    {"/main.css", {"main.css", "text/css; charset=utf-8"}},
    {"/icon.svg", {"icon.svg", "image/svg+xml"}}};

Reply json(const Json& content) {
    return {200, "application/json", content.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

/// Throws InputError unless the word is a whole number.
std::size_t wholeOf(const Request& request, const std::string& word) {
    const std::string text = request.asked(word);
    std::size_t value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size())
        throw InputError(fmt::format("view: '{}' must be a whole number.", word));
    return value;
}

std::optional<Vector<double>> originOf(const std::string& text) {
    if (text.empty()) return {};
    std::istringstream words(text);
    std::array<double, 3> parts{};
    std::string word;
    for (double& part : parts)
        if (!std::getline(words, word, ',') || !parseNumber(word, part))
            throw InputError("view: 'origin' must be three numbers with commas between.");
    return Vector<double>{parts[0], parts[1], parts[2]};
}

void secure(Reply& reply, const std::string& frameAncestors) {
    reply.headers.emplace_back("X-Content-Type-Options", "nosniff");
    reply.headers.emplace_back("Referrer-Policy", "no-referrer");
    reply.headers.emplace_back("Cache-Control", "no-store");
    reply.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
    reply.headers.emplace_back(
        "Content-Security-Policy",
        fmt::format("default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
                    "media-src blob:; "
                    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors {}",
                    frameAncestors));
}

}  // namespace

Reply Api::answer(const Request& request) {
    Reply reply = replyOf([&] {
        const auto refused = gate.answer(request);
        return refused ? *refused : route(request);
    });
    secure(reply, places.frameAncestors);
    return reply;
}

Reply Api::route(const Request& request) {
    if (request.method == "POST") return change(request);
    if (request.path == "/api/runs") return list();
    if (request.path == "/api/drivers") return json(drivers.all());
    if (request.path.starts_with("/api/")) {
        const auto run = runs.find(request.asked("id"));
        return run ? ofRun(request, *run) : sentence(404, "There is no such run.");
    }
    return pageFile(request.path);
}

Reply Api::change(const Request& request) {
    const Json wish = parseJson(request.body);
    if (!wish.is_object()) return sentence(400, "The content is not a JSON object, or is nested too deeply.");
    if (request.path == "/api/start") return json({{"id", queue.start(wish)}});
    if (request.path == "/api/check") return queue.check(wish), json({{"told", "It can start."}});
    if (request.path == "/api/resume") return queue.resume(wish), json({{"told", "It goes on."}});
    if (request.path == "/api/stop") {
        if (!wish.contains("id") || !wish["id"].is_string())
            return sentence(400, "The id of the run is missing.");
        return json({{"told", queue.stop(wish["id"])}});
    }
    return sentence(404, "There is nothing here.");
}

Reply Api::ofRun(const Request& request, const RunFiles& run) {
    if (request.path == "/api/run") {
        const Reply read = readApart(places.memory, [&] { return json(details(run)); });
        if (read.status != 200) return read;
        Json all = Json::parse(read.body);
        addSize(all, run);
        addQueue(all, run);
        return json(all);
    }
    std::unique_lock<std::mutex> one(oneFrame, std::defer_lock);
    if (request.path != "/api/table") one.lock();  // here, and not in the child, which has a copy of the lock
    return readApart(places.memory, [&] { return contentOf(request, run); });
}

Reply Api::contentOf(const Request& request, const RunFiles& run) {
    if (request.path == "/api/table") {
        const std::string from = request.asked("from");
        return {200, "application/json",
                tableRows(run, request.asked("name"), from.empty() ? 0 : wholeOf(request, "from"))};
    }
    if (request.path == "/api/map") return map(request, run);
    if (request.path == "/api/frame" || request.path == "/api/row") return frame(request, run);
    return sentence(404, "There is nothing here.");
}

Reply Api::frame(const Request& request, const RunFiles& run) {
    const std::vector<FrameEntry> frames = framesOf(run);
    const std::size_t number = wholeOf(request, "frame");
    if (number >= frames.size()) return sentence(404, "There is no such frame.");
    if (request.path == "/api/row")
        return {200, "application/json",
                describeRow(frames[number], request.asked("of") == "contacts", wholeOf(request, "row"))};
    FrameWish wish;
    wish.field = request.asked("field"), wish.orRadius = request.asked("orRadius") == "1";
    wish.wallField = request.asked("wallField");
    wish.contacts = request.asked("contacts") == "1", wish.bridges = request.asked("bridges") != "0";
    wish.droplets = request.asked("droplets") != "0", wish.origin = originOf(request.asked("origin"));
    return {200, "application/octet-stream", packFrame(frames[number], wish)};
}

Reply Api::map(const Request& request, const RunFiles& run) {
    const std::vector<FieldSeries> all = fieldSeriesOf(run);
    const auto found = std::ranges::find(all, nameOfText(request.asked("name")), &FieldSeries::name);
    const std::size_t number = wholeOf(request, "frame");
    if (found == all.end() || number >= found->entries.size()) return sentence(404, "There is no such map.");
    const auto optional = [&](const char* word) {
        return request.asked(word).empty() ? std::optional<std::size_t>() : wholeOf(request, word);
    };
    return {200, "application/octet-stream",
            packMap(found->entries[number], {request.asked("field"), optional("normal"), optional("slice")})};
}

/// What this server knows of a run that it has in its queue, or has started. The locks of a run that
/// computes, by whomever it was started, are above that.
void Api::addQueue(Json& overview, const RunFiles& run) {
    const auto [state, reason, when] = queue.stateOf(run);
    const std::string told = overview["state"];
    if (told == "running" || told == "preparing") return;
    const bool isUnderWay = state == "waiting" || state == "running";
    const bool isOver = told == "silent" && (state == "ended" || state == "stopped");
    if (isUnderWay || isOver) overview["state"] = state, overview["reason"] = "";
    if (state != "failed" || told == "failed" || told == "waiting") return;
    overview["state"] = "failed";
    overview["reason"] = reason.empty() ? errorOf(run) : reason;
    overview["healthy"] = false;
}

Reply Api::list() {
    std::vector<Json> all;
    for (const std::string& text : overviewsApart(places.memory, runs, runs.list())) {
        if (text.empty()) continue;
        Json one = Json::parse(text);
        const auto run = runs.find(one["id"]);  // of a thousand, one folder is open at a time
        if (!run) continue;
        addSize(one, *run);
        addQueue(one, *run);
        all.push_back(std::move(one));
    }
    std::stable_sort(all.begin(), all.end(), [](const Json& a, const Json& b) {
        return a["changed"].get<double>() > b["changed"].get<double>();
    });
    return json({{"root", runs.root().path().string()}, {"runs", all}});
}

Reply Api::pageFile(const std::string& path) const {
    const auto known = pageFiles.find(path);
    if (known == pageFiles.end()) return sentence(404, "There is nothing here.");
    return {200, known->second.second,
            loadInputFile("file of the page", places.page / known->second.first).text};
}

}  // namespace pendular::view
