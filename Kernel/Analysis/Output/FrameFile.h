#pragma once

#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// Numbers as words, with all their digits and a blank behind each.
class NumberText {
public:
    /// Numbers, and vectors part by part.
    template <class... Numbers>
    std::string_view of(const Numbers&... numbers) {
        text.clear();
        (add(numbers), ...);
        return text;
    }

private:
    void add(const Vector<double>& v) { add(v.x), add(v.y), add(v.z); }
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void add(Number number) {
        // std::to_chars takes a third of the time of fmt's {}, which counts in files of gigabytes.
        char word[32];
        const char* end = std::to_chars(word, word + sizeof word, number).ptr;
        text.append(word, static_cast<std::size_t>(end - word)).push_back(' ');
    }

    std::string text;
};

/// A text to which frames are added. A run that is restarted goes on behind the frames that there were when
/// the restart file was written, without later ones; behind all of them where the restart file does not know
/// the text. All functions throw InputError if the file cannot be written.
class FrameFile {
public:
    explicit FrameFile(std::string fileEnding, std::string firstLine = {})
        : ending(std::move(fileEnding)), header(std::move(firstLine)) {}

    /// A frame; the file is opened with the first.
    /// @param beginning of the file's name; @param goesOn of a run that is restarted
    void begin(const std::string& beginning, bool goesOn);
    void text(std::string_view words) { waiting.append(words); }
    /// A line of words with a blank behind the last.
    template <class... Words>
    void line(const Words&... words) {
        (text(words), ...);
        waiting.back() = '\n';
        if (waiting.size() > writtenAtOnce) write();
    }
    /// The frame, whole, is on its way to the disk.
    void finish();
    void visitState(StateArchive& archive, const std::string& beginning);

private:
    static constexpr std::size_t writtenAtOnce = std::size_t{1} << 20;  // bytes

    void open(bool goesOn);
    void write();
    [[noreturn]] void fail() const;

    std::string ending, header, path, waiting;
    std::shared_ptr<std::FILE> file;
    std::optional<std::uint64_t> kept;  // bytes, when the restart file was written
};

}  // namespace pendular
