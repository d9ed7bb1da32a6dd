# Writes a header that lists all laws and names all species composed of them. A law is a header in the folder of
# its kind below Kernel/Species/ (not in a sub-folder), named after the struct it defines: no list has to be
# edited.

# In `names`: the laws of one kind, the one that is no law ("NoFriction") first.
function(pendular_find_laws kind names)
    file(GLOB found CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Kernel/Species/${kind}/*.h")
    list(TRANSFORM found REPLACE "^.*/([^/]*)\\.h$" "\\1")
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
        pendular_find_laws(${kind} laws${kind})
        foreach(law IN LISTS laws${kind})
            string(APPEND includes "#include \"Kernel/Species/${kind}/${law}.h\"\n")
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

// Written by CMake from the headers in Kernel/Species/Normal, Friction and Adhesion.

@includes@#include "Kernel/Species/Species.h"
#include "Kernel/Species/TypeList.h"

namespace pendular {

@lists@
/// Calls function.template operator()<S>() for the species of every combination of the laws.
template <class Function>
void forEachSpecies(Function&& function) {
    NormalLaws::forEach([&]<class N>() {
        FrictionLaws::forEach([&]<class F>() {
            AdhesionLaws::forEach([&]<class A>() { function.template operator()<Species<N, F, A>>(); });
        });
    });
}

@aliases@
}  // namespace pendular
]])
endfunction()
