#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Mercury/MercuryOutput.h"

namespace pendular {

/// How MercuryDPM writes a file of frames: one with all, or NAME.data.0, NAME.data.1, ..., padded to five
/// digits if asked for. Pictures for ParaView are always many, and a restart file is the last one.
enum class FileType { NO_FILE, ONE_FILE, MULTIPLE_FILES, MULTIPLE_FILES_PADDED };

/// A file of a scene: scene.dataFile.setFileType(FileType::NO_FILE).
class MercuryFile {
public:
    MercuryFile(std::string_view ofName, FileType given) : name(ofName), type(given) {}
    void setFileType(FileType asked) { type = asked; }
    /// Steps from one frame to the next; 0, as it is at first: those of the scene's setSaveCount().
    void setSaveCount(std::size_t steps) { saveCount = steps; }
    /// One frame at the start and one at the end.
    void writeFirstAndLastTimeStep() { saveCount = std::size_t{1} << 52; }
    [[nodiscard]] std::size_t getSaveCount() const { return saveCount; }
    [[nodiscard]] FileType getFileType() const { return type; }
    [[nodiscard]] bool isWritten() const { return type != FileType::NO_FILE; }
    [[nodiscard]] std::string_view getName() const { return name; }

private:
    std::string_view name;
    FileType type;
    std::size_t saveCount = 0;
};

/// A file that is not written here: all that is set of it is without effect, and a run whose driver asks for
/// one says so in its log.
class MercuryNoFile {
public:
    explicit MercuryNoFile(FileType given) : type(given) {}
    void setFileType(FileType asked) { type = asked; }
    void setSaveCount(std::size_t /*steps*/) {}
    void setName(const std::string& /*name*/) {}
    [[nodiscard]] FileType getFileType() const { return type; }
    [[nodiscard]] bool isWritten() const { return type != FileType::NO_FILE; }

private:
    FileType type;
};

/// Numbers as MercuryDPM's `random` gives them; the same in each run, and other numbers than there.
class MercuryRandom {
public:
    void setRandomSeed(unsigned long seed) { numbers = UniformRandom(seed); }
    /// Evenly in [lowest, highest).
    double getRandomNumber(double lowest, double highest) { return numbers.uniform(lowest, highest); }
    double getRandomNumber() { return numbers.uniform(0, 1); }
    void visitState(StateArchive& archive) { numbers.visitState(archive); }

private:
    UniformRandom numbers{0};
};

/// What a MercuryScene writes by itself and remembers.
struct MercurySettings {
    MercuryFile data{"dataFile", FileType::ONE_FILE}, fStat{"fStatFile", FileType::ONE_FILE},
        energies{"eneFile", FileType::ONE_FILE}, restart{"restartFile", FileType::NO_FILE};
    bool picturesOfGrains = false, picturesOfWalls = false, picturesOfContacts = false;  // any: of all
    bool readsLedger = false;  // the program does, beside its file of energies
    MercuryRandom random;
    std::function<void()> atSetUp;  // called when the driver has set all that it will
};

/// The output of a MercuryScene: what its settings ask for when the scene has been set up. The files
/// NAME.data, NAME.fstat and NAME.ene of a scene without setName() are not written.
class MercuryFiles {
public:
    /// The name of a scene that was given none.
    static constexpr std::string_view nameOfUnnamed = "pendular";

    explicit MercuryFiles(std::shared_ptr<MercurySettings> of) : settings(std::move(of)) {}

    void prepare(Scene& scene);
    void write(const Scene& /*scene*/) {}  // the outputs that it has added do
    void visitState(StateArchive& archive, const Scene& scene);

private:
    void addPictures(Scene& scene) const;
    void addFrames(Scene& scene) const;

    std::shared_ptr<MercurySettings> settings;
    bool isAdded = false;  // to the scene, which is then set up
    bool isDone = false;
};

}  // namespace pendular
