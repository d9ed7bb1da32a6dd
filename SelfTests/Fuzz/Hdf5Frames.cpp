#include "Kernel/Output/FieldFile.h"
#include "Kernel/Output/Hdf5Output.h"
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

}  // namespace

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
