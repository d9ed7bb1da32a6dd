#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ShapeFields.h"
#include "SelfTests/Fuzz/EditedState.h"
#include "SelfTests/Fuzz/Target.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fuzz {

namespace {

/// An index of four frames.
const EditedState& goodIndex(const std::string& name) {
    static const EditedState state = [&] {
        FieldFile index(Hdf5Frames::indexOf(name));
        index.column("/", {"step", 1, std::vector<double>{0, 100, 200, 300}});
        index.column("/", {"time_s", 1, std::vector<double>{0, 0.25, 0.5, 0.75}});
        index.close();
        return EditedState(Hdf5Frames::indexOf(name));
    }();
    return state;
}

/// Two grains, one of which is no sphere, that touch each other and a wall.
const EditedState& goodFrame(const std::filesystem::path& path) {
    static const EditedState state = [&] {
        using Doubles = std::vector<double>;
        using Wholes = std::vector<std::int32_t>;
        FieldFile file(path);
        file.column("particles", {"position_m", 3, Doubles{0, 0, 0, 2e-3, 0, 0}});
        file.column("particles", {"radius_m", 1, Doubles{1e-3, 1e-3}});
        file.column("particles", {"identity", 1, Wholes{4, 7}});
        file.column("particles", {"half_lengths_m", 3, Doubles{1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 2e-3}});
        file.column("particles", {"n1", 1, Wholes{2, 4}});
        file.column("particles", {"n2", 1, Wholes{2, 3}});
        file.column("particles",
                    {"orientation", 9, Doubles{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1}});
        file.column("contacts", {"branch_m", 3, Doubles{2e-3, 0, 0, 0, 0, -1e-3}});
        file.column("contacts", {"particle1", 1, Wholes{4, 7}});
        file.column("walls", {"corner_m", 3, Doubles{0, 0, 0, 1, 0, 0, 0, 1, 0}});
        file.column("walls", {"end", 1, Wholes{3}});
        file.close();
        return EditedState(path);
    }();
    return state;
}

/// Each cell has corners that are points, and each row its numbers.
void requireWhole(const PolyData& data) {
    for (const std::int32_t corner : data.corners)
        static_cast<void>(data.points.at(static_cast<std::size_t>(corner)));
    if (!data.ends.empty() && data.ends.back() != static_cast<std::int32_t>(data.corners.size()))
        throw std::logic_error("a cell has corners that are not there");
    for (const auto& [fields, rows] :
         {std::pair{&data.pointFields, data.points.size()}, std::pair{&data.cellFields, data.ends.size()}})
        for (const PolyDataField& field : *fields)
            if (field.size() != rows * field.components) throw std::logic_error("a row has not its numbers");
}

}  // namespace

/// An HDF5 frame with a content that was edited.
Target hdf5Frame() {
    return {"Hdf5Frame", [] { return EditedState::eachEdit(11, 1); },
            [](std::string_view bytes) {
                static const support::TestFolder folder = support::TestFolder::inMemory();
                const std::filesystem::path path = folder.path() / "run-fields-000000001.h5";
                EditedState state = goodFrame(path);
                state.edit(bytes);
                std::filesystem::remove(path);
                state.write(path);
                try {
                    const SceneFrame frame = readHdf5Frame(path);
                    requireWhole(frame.grains);
                    for (const auto& part : {frame.contacts, frame.walls, shapeSurfaces(frame.grains)})
                        if (part) requireWhole(*part);
                    return true;
                } catch (const InputError&) {
                    return false;
                }
            }};
}

/// The index of a series of HDF5 frames with a content that was edited, with which a run goes on from 0.5 s:
/// what that leaves can be gone on with again.
Target hdf5Index() {
    return {"Hdf5Index", [] { return EditedState::eachEdit(2, 1); },
            [](std::string_view bytes) {
                static const support::TestFolder folder = support::TestFolder::inMemory();
                const std::string name = (folder.path() / "run").string();
                EditedState state = goodIndex(name);
                state.edit(bytes);
                state.write(Hdf5Frames::indexOf(name));
                try {
                    Hdf5Frames::check(name);
                } catch (const InputError&) {
                    return false;
                }
                try {
                    const Hdf5Frames goesOn(name, 0.5);
                    Hdf5Frames::check(name);
                } catch (const InputError& refused) {
                    throw std::logic_error(refused.what());
                }
                return true;
            }};
}

}  // namespace pendular::fuzz
