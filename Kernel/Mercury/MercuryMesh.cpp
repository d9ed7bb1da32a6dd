#include "Kernel/Mercury/MercuryMesh.h"

#include <fmt/format.h>

#include "Kernel/Features/Meshes/PolygonMesh.h"

namespace pendular {
namespace {

/// VTK's old form: "The VTK User's Guide", file formats. A reader of its words, of which only these count.
class VtkReader {
public:
    VtkReader(const InputFile& of, double forUnit) : file(of), words(of.text), scale(forUnit) {}

    PolygonMesh read() {
        std::string_view word = words.next();  // behind the lines of the version and of the title
        while (!word.empty() && word != "ASCII") word = words.next();
        if (word.empty()) file.refuse("is no VTK file that says ASCII");
        PolygonMesh mesh;
        for (word = words.next(); !word.empty(); word = words.next()) {
            if (word == "POINTS") readPoints(mesh);
            else if (word == "CELLS" || word == "POLYGONS") readFaces(mesh);
        }
        if (mesh.faces.empty()) file.refuse("has no CELLS and no POLYGONS");
        return mesh;
    }

private:
    std::size_t readCount() {
        double number = 0;
        const std::string_view word = words.next();
        if (!parseNumber(word, number)) file.refuse("line", words.line(), whyNoNumber(word));
        if (!(number >= 0 && number < 4e9 && number == static_cast<double>(static_cast<std::size_t>(number))))
            file.refuse("line", words.line(), fmt::format("{} is no whole number, at least 0", number));
        return static_cast<std::size_t>(number);
    }
    void readPoints(PolygonMesh& mesh) {
        const std::size_t count = readCount();
        words.next();  // the type of number
        for (std::size_t k = 0; k < count; ++k) {
            Vector<double> point;
            for (double* x : {&point.x, &point.y, &point.z})
                if (const std::string reason = parseLength(words.next(), scale, *x); !reason.empty())
                    file.refuse("line", words.line(), reason);
            mesh.vertices.push_back(point);
        }
    }
    void readFaces(PolygonMesh& mesh) {
        const std::size_t count = readCount();
        readCount();  // of all numbers
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t corners = readCount(); corners > 0; --corners)
                mesh.corners.push_back(static_cast<std::int64_t>(readCount()));
            mesh.endFace(words.line());
        }
    }

    const InputFile& file;
    Words words;
    double scale;
};

}  // namespace

std::vector<Triangle> readMercuryMesh(const std::filesystem::path& path, double scale, const Vec3D& shift) {
    std::vector<Triangle> triangles;
    if (path.extension() == ".vtk") {
        const InputFile file = loadTextFile("mesh", path);
        triangles = trianglesOf(VtkReader(file, scale).read(), file);
    } else {
        triangles = readTriangles(path, scale);
    }
    for (Triangle& triangle : triangles)
        for (Vector<double>& corner : triangle) corner += toVector(shift);
    return triangles;
}

}  // namespace pendular
