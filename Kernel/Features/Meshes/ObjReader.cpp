#include <algorithm>
#include <charconv>
#include <initializer_list>

#include "Kernel/Features/Meshes/MeshFormats.h"

namespace pendular {

namespace {

class ObjReader {
public:
    ObjReader(const InputFile& of, double scaleOf) : file(of), scale(scaleOf) {}

    PolygonMesh read() {
        std::string_view rest = file.text;
        std::string joined;
        for (std::size_t number = 1; !rest.empty(); ++number) {
            line = number;
            std::string_view text = takeLine(rest);
            if (text.ends_with('\\')) {  // it goes on in the next one
                joined.clear();
                for (; text.ends_with('\\'); ++number, text = takeLine(rest))
                    joined.append(text.substr(0, text.size() - 1)) += ' ';
                text = joined += text;
            }
            takeStatement(text.substr(0, text.find('#')));
        }
        return std::move(mesh);
    }

private:
    static std::string_view takeLine(std::string_view& rest) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        return text;
    }

    void takeStatement(std::string_view text) {
        Words words(text);
        const std::string_view word = words.next();
        if (word.empty()) return;
        if (word == "v") takeVertex(words);
        else if (word == "f" || word == "fo") takeFace(words);
        else if (isOneOf(word, {"cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",
                                "hole", "scrv", "con", "end"}))
            file.refuse(
                "line", line,
                fmt::format("'{}' is of a curved surface, and only plane faces are read; let the program "
                            "that wrote the file mesh it",
                            word));
        else if (!isOneOf(word, {"vn",         "vt",        "vp",     "g",        "o",        "s",
                                 "mg",         "usemtl",    "mtllib", "usemap",   "maplib",   "l",
                                 "p",          "sp",        "bevel",  "c_interp", "d_interp", "lod",
                                 "shadow_obj", "trace_obj", "ctech",  "stech"}))
            file.refuse("line", line, fmt::format("'{}' begins no statement of an OBJ file", shown(word)));
    }
    static bool isOneOf(std::string_view word, std::initializer_list<std::string_view> all) {
        return std::find(all.begin(), all.end(), word) != all.end();
    }

    void takeVertex(Words& words) {
        Vector<double> v;
        for (double* x : {&v.x, &v.y, &v.z}) {
            const std::string_view word = words.next();
            if (word.empty()) file.refuse("line", line, "a vertex has fewer than three coordinates");
            if (const std::string reason = parseLength(word, scale, *x); !reason.empty())
                file.refuse("line", line, reason);
        }
        mesh.vertices.push_back(v);
    }
    void takeFace(Words& words) {
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::string_view digits = word.substr(0, word.find('/'));
            std::int64_t number = 0;
            const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
            const auto count = static_cast<std::int64_t>(mesh.vertices.size());
            if (problem != std::errc{} || end != digits.data() + digits.size())
                file.refuse("line", line, fmt::format("'{}' is not the number of a vertex", shown(word)));
            if (number == 0 || number < -count)
                file.refuse(
                    "line", line,
                    fmt::format("there is no vertex {}; they are counted from 1, and from -1 back: there "
                                "are {} before this line",
                                number, count));
            mesh.corners.push_back(number > 0 ? number - 1 : count + number);
        }
        mesh.endFace(line);
    }

    const InputFile& file;
    double scale;  // m
    std::size_t line = 0;
    PolygonMesh mesh;
};

}  // namespace

PolygonMesh readObj(const InputFile& file, double scale) { return ObjReader(file, scale).read(); }

}  // namespace pendular
