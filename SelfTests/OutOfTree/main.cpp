// A driver outside Pendular's tree, which knows only the installed kernel.

#include <fmt/format.h>

#include "Kernel/Features/Laws.h"

int main() {
    using S = pendular::HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
    fmt::print("{}\n", S::name);
    return S::name == "HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies" ? 0 : 1;
}
