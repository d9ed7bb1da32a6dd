#include "Drivers/Shared/FirstState.h"

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"

namespace pendular {

void addFirstState(CLI::App& app, FirstState& o, const FirstStateTexts& texts) {
    auto* grains = app.add_option("--grains", o.grains, texts.grains)->type_name(fileName);
    auto* walls = app.add_option("--walls", o.walls, texts.walls)->type_name(fileName);
    grains->needs(walls), walls->needs(grains);
    app.add_option("--number", o.number, texts.number)->excludes(grains);
    app.add_option("--softening", o.softening,
                   "divides Young's moduli; the time step grows with its square root");
}

}  // namespace pendular
