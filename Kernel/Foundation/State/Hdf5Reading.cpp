#include "Kernel/Foundation/State/Hdf5Reading.h"

#include <fmt/format.h>

#include <sstream>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

/// Beside the table that is read. The library takes memory by sizes that a file claims.
constexpr std::size_t memoryOfLibrary = std::size_t{128} << 20;       // bytes
constexpr std::size_t longestName = 1 << 16, longestText = 64 << 20;  // bytes
constexpr unsigned bytesPerSecond = 10'000'000;                       // at least: those of a slow disk

constexpr std::size_t bytesOf(NumberKind kind) {
    switch (kind) {
        case NumberKind::Float64:
        case NumberKind::UInt64:
            return 8;
        case NumberKind::Float32:
        case NumberKind::UInt32:
        case NumberKind::Int32:
            return 4;
        case NumberKind::UInt16:
            return 2;
        case NumberKind::UInt8:
            return 1;
    }
    return 0;
}

/// One message, which wakes the other process once.
template <class Head>
bool sendTogether(const ReadingProcess::Channel& to, const Head& head, std::string_view text) {
    std::string message(reinterpret_cast<const char*>(&head), sizeof head);
    constexpr std::size_t longestMessage = 1 << 16;
    if (text.size() > longestMessage) return to.send(&head, sizeof head) && to.send(text.data(), text.size());
    message += text;
    return to.send(message.data(), message.size());
}

std::size_t bytesOfNumbers(const TableShape& shape) {
    return shape.rows * shape.columns * bytesOf(shape.kind);
}

ReadingProcess::Limits limitsFor(const std::filesystem::path& file) {
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(file, ignored);
    return {memoryOfLibrary, 20 + static_cast<unsigned>((ignored ? 0 : bytes) / bytesPerSecond)};
}

}  // namespace

Hdf5Reading::Hdf5Reading(const std::function<void()>& open, const Hdf5File& file)
    : place(file.path()),
      process(limitsFor(place), [&](const ReadingProcess::Channel& channel) { serve(channel, open, file); }) {
    Answer opened{};
    requireTaken(opened, process.channel().receive(&opened, sizeof opened));
}

/// In the child: answers until the other end is closed.
void Hdf5Reading::serve(const ReadingProcess::Channel& channel, const std::function<void()>& open,
                        const Hdf5File& file) {
    Request request{};
    std::string name;
    bool isOpen = false;
    do {
        Answer answer{};
        std::string content;
        try {
            if (isOpen) answer = answerTo(request, name, file, content);
            else open();
        } catch (const InputError& problem) {
            answer.isRefused = 1;
            content = problem.what();
        }
        answer.bytes = content.size();
        if (!sendTogether(channel, answer, content) || (answer.isRefused && !isOpen)) return;
        isOpen = true;
        if (!channel.receive(&request, sizeof request) || request.nameLength > longestName) return;
        name.resize(request.nameLength);
    } while (channel.receive(name.data(), name.size()));
}

Hdf5Reading::Answer Hdf5Reading::answerTo(const Request& request, const std::string& name,
                                          const Hdf5File& file, std::string& content) {
    Answer answer{};
    const TableShape wanted{request.kind, request.rows, request.columns};
    switch (request.what) {
        case What::Names:
            for (const std::string& one : file.names()) content.append(one).push_back('\0');
            break;
        case What::Holds:
            answer.isThere = file.holds(name) ? 1 : 0;
            break;
        case What::Shape:
            if (const auto shape = file.shapeOf(name)) {
                answer.isThere = 1;
                answer.kind = shape->kind, answer.rows = shape->rows, answer.columns = shape->columns;
            }
            break;
        case What::Table:
            ReadingProcess::allowMemory(memoryOfLibrary + bytesOfNumbers(wanted));
            content.resize(bytesOfNumbers(wanted));
            file.read(name, wanted, content.data());
            break;
        case What::Text:
            content = file.readText(name);
            break;
    }
    return answer;
}

void Hdf5Reading::requireTaken(const Answer& answer, bool received) {
    if (received && !answer.isRefused) return;
    if (received) throw InputError(contentOf(answer));
    throw InputError(fmt::format(
        "The file {} cannot be read: the process that read it with the HDF5 library {}; the file is "
        "damaged, or of a form that Pendular does not write.",
        place.string(), process.howItEnded()));
}

std::string Hdf5Reading::contentOf(const Answer& answer) {
    std::string content;
    const bool isShort = answer.bytes <= longestText;
    content.resize(isShort ? answer.bytes : 0);
    requireTaken({}, isShort && process.channel().receive(content.data(), content.size()));
    return content;
}

Hdf5Reading::Answer Hdf5Reading::ask(Request request, const std::string& name) {
    const ReadingProcess::Channel& channel = process.channel();
    Answer answer{};
    request.nameLength = name.size();
    requireTaken(answer, sendTogether(channel, request, name) && channel.receive(&answer, sizeof answer));
    return answer;
}

std::vector<std::string> Hdf5Reading::names() {
    std::istringstream list(contentOf(ask({.what = What::Names}, {})));
    std::vector<std::string> found;
    for (std::string name; std::getline(list, name, '\0');) found.push_back(name);
    return found;
}

bool Hdf5Reading::holds(const std::string& name) { return ask({.what = What::Holds}, name).isThere != 0; }

std::optional<TableShape> Hdf5Reading::shapeOf(const std::string& name) {
    const Answer answer = ask({.what = What::Shape}, name);
    if (!answer.isThere) return {};
    return TableShape{answer.kind, answer.rows, answer.columns};
}

void Hdf5Reading::read(const std::string& name, const TableShape& shape, void* numbers) {
    if (shape.rows == 0) return;
    const Answer answer = ask({What::Table, shape.kind, shape.rows, shape.columns}, name);
    const bool isWhole = answer.bytes == bytesOfNumbers(shape);
    requireTaken(answer, isWhole && process.channel().receive(numbers, bytesOfNumbers(shape)));
}

std::string Hdf5Reading::readText(const std::string& name) {
    return contentOf(ask({.what = What::Text}, name));
}

}  // namespace pendular
