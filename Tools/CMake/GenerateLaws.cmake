# Writes a header that lists all laws and names all species composed of them. A law is a header in the folder of
# its kind (Kernel/Laws/KIND or Kernel/Features/NAME/KIND), named after the struct it defines, or a line
# "using Name = ..." of the header CombinedLaws.h in that folder: no list has to be edited.

# In `headers`: those of the laws of one kind; in `names`: its laws, the one that is no law ("NoFriction") first.
function(pendular_find_laws kind headers names)
    file(GLOB found CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/Kernel/Laws/${kind}/*.h" "${PROJECT_SOURCE_DIR}/Kernel/Features/*/${kind}/*.h")
    list(SORT found)
    set(${headers} "${found}" PARENT_SCOPE)
    set(combined "")
    set(combining ${found})
    list(FILTER combining INCLUDE REGEX "/CombinedLaws\\.h$")
    list(FILTER found EXCLUDE REGEX "/CombinedLaws\\.h$")
    foreach(file IN LISTS combining)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${file}")
        file(STRINGS "${PROJECT_SOURCE_DIR}/${file}" named REGEX "^using [A-Za-z]+ = ")
        list(TRANSFORM named REPLACE "^using ([A-Za-z]+) = .*$" "\\1")
        list(APPEND combined ${named})
    endforeach()
    list(TRANSFORM found REPLACE "^.*/([^/]*)\\.h$" "\\1")
    list(APPEND found ${combined})
    list(SORT found)
    if("No${kind}" IN_LIST found)
        list(REMOVE_ITEM found "No${kind}")
        list(PREPEND found "No${kind}")
    endif()
    set(${names} "${found}" PARENT_SCOPE)
endfunction()

# In `result`: an alias for each species with this normal law.
function(pendular_name_species normal frictions adhesions result)
    set(text "")
    foreach(friction IN LISTS frictions)
        foreach(adhesion IN LISTS adhesions)
            set(name "${normal}${friction}${adhesion}Species")
            string(REGEX REPLACE "NoFriction|NoAdhesion" "" name "${name}")
            string(APPEND text "using ${name} = Species<${normal}, ${friction}, ${adhesion}>;\n")
            if(adhesion MATCHES "Willett")
                string(REPLACE "Willett" "Willet" otherName "${name}")
                string(APPEND text "using ${otherName} = ${name};\n")
            endif()
        endforeach()
    endforeach()
    set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(pendular_generate_laws header)
    set(includes "")
    set(lists "")
    foreach(kind IN ITEMS Normal Friction Adhesion)
        pendular_find_laws(${kind} headers laws${kind})
        foreach(lawHeader IN LISTS headers)
            string(APPEND includes "#include \"${lawHeader}\"\n")
        endforeach()
        list(JOIN laws${kind} ", " joined)
        string(APPEND lists "using ${kind}Laws = TypeList<${joined}>;\n")
    endforeach()

    set(aliases "")
    foreach(normal IN LISTS lawsNormal)
        pendular_name_species(${normal} "${lawsFriction}" "${lawsAdhesion}" named)
        string(APPEND aliases "${named}")
    endforeach()
    foreach(adhesion IN LISTS lawsAdhesion)
        if(adhesion MATCHES "Willett")
            string(REPLACE "Willett" "Willet" otherName "${adhesion}")
            string(PREPEND aliases "using ${otherName} = ${adhesion};\n")
        endif()
    endforeach()

    # Left alone if nothing has changed, so that nothing is compiled again.
    file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT [[
#pragma once

// Written by CMake from the headers in the folders Normal, Friction and Adhesion of Kernel/Laws and Kernel/Features.

@includes@#include "Kernel/Laws/Species/Species.h"
#include "Kernel/Laws/Concepts/TypeList.h"

namespace pendular {

@lists@
@aliases@
}  // namespace pendular
]])
endfunction()

# The species that most drivers take: their contact kernels are compiled once, into the library. A driver of
# another species compiles its own.
set(PENDULAR_POPULAR_SPECIES
    HertzianViscoelasticSpecies
    HertzianViscoelasticMindlinSpecies
    HertzianViscoelasticMindlinRollingTorsionSpecies
    HertzianViscoelasticMindlinIncrementalSpecies
    HertzianViscoelasticMindlinIncrementalLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinIncrementalLiquidBridgeYoungLaplaceSpecies
    HertzianViscoelasticLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies
    HertzianViscoelasticLiquidBridgeWillettSpecies
    HertzianViscoelasticMindlinLiquidBridgeWillettSpecies
    HertzianViscoelasticMindlinLiquidBridgeYoungLaplaceSpecies
    HertzianViscoelasticMindlinLiquidMigrationWillettSpecies
    HertzianViscoelasticMindlinLiquidMigrationLSSpecies
    HertzianViscoelasticMindlinViscousLiquidBridgeWillettSpecies
    HertzianViscoelasticMindlinViscousLiquidMigrationLSSpecies
    HertzianViscoelasticMindlinJKRSpecies
    LinearViscoelasticSpecies
    LinearViscoelasticSlidingFrictionSpecies
    LinearViscoelasticFrictionSpecies
    LinearViscoelasticLiquidBridgeWillettSpecies
    LinearViscoelasticSlidingFrictionLiquidMigrationWillettSpecies)

if(PENDULAR_QUICK_TEST_BUILD AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")  # CI: those of the tests of threads
    set(PENDULAR_POPULAR_SPECIES LinearViscoelasticSpecies HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies)
endif()

# Those of several programs (SpeciesOfPrograms) and of several tests (SpeciesOfTests), compiled once for them.
set(PENDULAR_SPECIES_OF_PROGRAMS "")
foreach(model Chen ClassicalWillett Lambert Lian LianSeville MegiasAlguacil Mikami PietschRumpf Rabinovich Soulie Weigert)
    list(APPEND PENDULAR_SPECIES_OF_PROGRAMS HertzianViscoelasticMindlinLiquidBridge${model}Species)
endforeach()
set(PENDULAR_SPECIES_OF_TESTS
    LinearViscoelasticMindlinSpecies
    HertzianBSHPViscoelasticMindlinSpecies
    LinearPlasticViscoelasticMindlinSpecies
    HertzianPlasticViscoelasticMindlinSpecies
    SinterMindlinSpecies
    HertzianSinterMindlinSpecies
    SinterSpecies
    HertzianViscoelasticParhamiMcMeekingSinterSpecies
    HertzianViscoelasticMindlinIncrementalRollingTorsionLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinPartialSlipRollingTorsionLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinPartialSlipLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinRollingTorsionLiquidBridgeBagheriSpecies
    HertzianViscoelasticMindlinSecantLiquidBridgeBagheriSpecies
    HertzianViscoelasticSlidingFrictionLiquidBridgeBagheriSpecies
    HertzianViscoelasticSlidingRollingTorsionLiquidBridgeBagheriSpecies
    HertzianViscoelasticFrictionLiquidBridgeBagheriSpecies
    HertzianViscoelasticDMTSpecies
    HertzianViscoelasticIrreversibleAdhesiveSpecies
    HertzianViscoelasticJKRSpecies
    HertzianViscoelasticReversibleAdhesiveSpecies
    HertzianBSHPViscoelasticSpecies
    HertzianPlasticViscoelasticSpecies
    LinearPlasticViscoelasticSpecies
    LinearViscoelasticSlidingRollingTorsionSpecies
    LinearViscoelasticLiquidMigrationWillettSpecies
    LinearViscoelasticViscousLiquidBridgeWillettSpecies
    LinearViscoelasticViscousLiquidMigrationWillettSpecies
    HertzianViscoelasticMindlinLiquidMigrationBagheriSpecies)

# Writes a header <type>.h, which declares the species of a list as the TypeList `type`, and in `sources` files that
# compile so many of them each.
function(pendular_instantiate_species folder type species speciesInFile sources)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${PROJECT_BINARY_DIR}/Generated" OUTPUT_VARIABLE include)
    set(declared "")
    set(listed "")
    foreach(name IN LISTS species)
        string(APPEND declared "extern template class SpeciesLaws<${name}>;\n"
               "extern template std::unique_ptr<ContactLaws> makeSpeciesLaws(SpeciesHandler<${name}>&);\n")
    endforeach()
    list(JOIN species ", " listed)
    file(CONFIGURE OUTPUT "${folder}/${type}.h" @ONLY CONTENT [[
#pragma once

// Written by CMake from the list in Tools/CMake/GenerateLaws.cmake.

#include "Kernel/Core/Contacts/SpeciesLaws.h"
#include "Kernel/Features/Laws.h"

namespace pendular {

using @type@ = TypeList<@listed@>;

@declared@
}  // namespace pendular
]])
    set(written "")
    set(remaining ${species})
    while(remaining)
        list(SUBLIST remaining 0 ${speciesInFile} part)
        list(REMOVE_ITEM remaining ${part})
        list(LENGTH written number)
        set(compiled "")
        foreach(name IN LISTS part)
            string(APPEND compiled "template class SpeciesLaws<${name}>;\n"
                   "template std::unique_ptr<ContactLaws> makeSpeciesLaws(SpeciesHandler<${name}>&);\n")
        endforeach()
        set(file "${folder}/${type}${number}.cpp")
        file(CONFIGURE OUTPUT "${file}" @ONLY CONTENT [[
// Written by CMake from the list in Tools/CMake/GenerateLaws.cmake.

#include "@include@/@type@.h"

namespace pendular {

@compiled@
}  // namespace pendular
]])
        list(APPEND written "${file}")
    endwhile()
    set(${sources} "${written}" PARENT_SCOPE)
endfunction()
