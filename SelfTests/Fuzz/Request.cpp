#ifdef PENDULAR_HAS_VIEW
    #include <cctype>
    #include <sstream>
    #include <stdexcept>

    #include "SelfTests/Fuzz/Target.h"
    #include "Tools/View/Api.h"

namespace pendular::fuzz {

namespace {

const std::string token(32, 'a');

/// A line for each part of a request; then a line "WORD=VALUE" for each word of the query up to an empty one;
/// what is left is the body.
view::Request requestOf(std::string_view bytes) {
    view::Request request;
    std::istringstream lines{std::string(bytes)};
    for (std::string* part : {&request.method, &request.path, &request.host, &request.origin,
                              &request.contentType, &request.mark, &request.cookie})
        std::getline(lines, *part);
    for (std::string line; std::getline(lines, line) && !line.empty();)
        request.query.try_emplace(line.substr(0, line.find('=')),
                                  line.substr(std::min(line.find('='), line.size() - 1) + 1));
    request.body.assign(std::istreambuf_iterator<char>(lines), {});
    return request;
}

/// In a folder with a run that has a summary and a table, and without drivers.
view::Reply answerTo(const view::Request& request) {
    static const support::TestFolder folder = support::TestFolder::inMemory();
    static const bool isFilled = [] {
        writeBytes(folder.path() / "run-summary.csv", "quantity,value,unit\nstate,at its end,\n");
        writeBytes(folder.path() / "table.csv", "time_s,x\n0,1\n1,2\n");
        return true;
    }();
    static const view::RunFolder runs(folder.path());
    static view::Api api({token, {"localhost"}, "pendular"}, runs,
                         {folder.path() / "page", folder.path() / "drivers", {}, "'none'"}, 1);
    return isFilled ? api.answer(request) : view::Reply{};
}

/// Whoever has no token learns nothing; nothing is a fault of the server.
bool take(std::string_view bytes) {
    const view::Request request = requestOf(bytes);
    const view::Reply reply = answerTo(request);
    if (reply.status >= 500) throw std::logic_error("the server has met a fault: " + reply.body);
    const bool hasToken = request.cookie == token || request.asked("token") == token;
    std::string host = request.host;  // names of hosts are the same in capitals
    for (char& letter : host) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (reply.status == 200 && (!hasToken || !host.starts_with("localhost")))
        throw std::logic_error("a stranger was answered");
    return reply.status == 200;
}

std::string seed(const std::string& method, const std::string& path, const std::string& rest) {
    return method + "\n" + path + "\nlocalhost:8123\nhttp://localhost:8123\napplication/json\n1\n" + token +
           "\n" + rest;
}

}  // namespace

Target request() {
    return {"Request",
            [] {
                return std::vector<std::string>{
                    seed("GET", "/api/runs", "\n"), seed("GET", "/api/run", "id=run\n\n"),
                    seed("GET", "/api/map", "id=run\nname=a.pvd\nframe=0\nnormal=1\n\n"),
                    seed("GET", "/api/table", "id=run\nname=table.csv\nfrom=10\n\n")};
            },
            take};
}

}  // namespace pendular::fuzz
#endif
