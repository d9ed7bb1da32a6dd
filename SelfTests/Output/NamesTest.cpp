// Names and units that a driver gives: they become parts of names of files, of XML and of HDF5.
#include <gtest/gtest.h>

#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::namesTest {
namespace {

using support::contains;
using support::refusal;
using Scene = scenes::SettlingBox<Species<LinearViscoelastic>>;
using namespace std::string_literals;

/// One line that ends with a full stop; there may be others in the name.
bool isSentence(const std::string& text) {
    return text.ends_with('.') && text.find('\n') == std::string::npos &&
           text.find('\0') == std::string::npos;
}

TEST(Names, ofFilesEndWithAName) {
    for (const std::string& name :
         {"run"s, "a/b/run"s, "./run"s, "../run"s, "..run"s, "a b;c&<d>"s, "..."s, "\xC3\xA4"s}) {
        EXPECT_EQ(refusal([&] { requireFileName("Simulation", name); }), "") << name;
        EXPECT_EQ(refusal([&] { Scene(1).setName(name); }), "") << name;
    }
    const FieldOutput fields(FieldGrid("X", {0, 0, 0}, {1, 1, 1}, 0.1), KernelShape::Gauss, 0.1);
    for (const std::string& name :
         {"/"s, "a/"s, "."s, ".."s, "a/.."s, "a/."s, "run\0x"s, "a\0/run"s, "run\n"s, "\x7Frun"s}) {
        for (const std::string& text :
             {refusal([&] { Scene(1).setName(name); }), refusal([&] { ParaViewOutput output(name); }),
              refusal([&] { MercuryOutput output(name); }), refusal([&] { Hdf5Output output(name); }),
              refusal([&] { FieldOutput(fields).withName(name); })}) {
            EXPECT_TRUE(isSentence(text)) << text;
            EXPECT_TRUE(contains(text, "name = '")) << text;
        }
    }
    EXPECT_NE(refusal([&] { Scene(1).setName(""); }), "");
    // That of fields is put behind that of the run.
    EXPECT_TRUE(contains(refusal([&] { FieldOutput(fields).withName("../q"); }), "it must have no /"));
    EXPECT_NE(refusal([&] { FieldOutput(fields).withName(""); }), "");
}

TEST(Names, ofColumnsAndFieldsAreWordsAndSoAreTheirUnits) {
    for (const std::string& unit : {"m3"s, "m_per_s"s, "1"s, ""s, "K"s}) {
        Scene scene(1);
        EXPECT_EQ(refusal([&] { scene.particleHandler.addColumn("a", unit); }), "") << unit;
        EXPECT_EQ(refusal([&] { scene.addContactColumn("a", unit); }), "") << unit;
        EXPECT_EQ(refusal([&] { ParaViewOutput().addField("a_" + unit, [](std::size_t) { return 1.0; }); }),
                  "");
    }
    for (const std::string& text : {"<&\">"s, "../q"s, "m/s"s, "m 3"s, "m\0"s, "\n"s, "m^3"s, "\xC2\xB5m"s}) {
        Scene scene(1);
        const std::string ofUnit = refusal([&] { scene.particleHandler.addColumn("a", text); });
        EXPECT_TRUE(isSentence(ofUnit)) << ofUnit;
        EXPECT_TRUE(contains(ofUnit, "of the column 'a' of the grains must have letters, digits and _ only"))
            << ofUnit;
        for (const std::string& other :
             {refusal([&] { scene.addContactColumn("a", text); }),
              refusal([&] { scene.addContactColumn(text, "m"); }),
              refusal([&] { scene.particleHandler.addColumn(text, "m"); }),
              refusal([&] { ParaViewOutput().addField(text, [](std::size_t) { return 1.0; }); }),
              refusal([&] { Hdf5Output().addField("a_" + text, [](std::size_t) { return 1.0; }); })})
            EXPECT_TRUE(isSentence(other)) << other;
    }
}

}  // namespace
}  // namespace pendular::namesTest
