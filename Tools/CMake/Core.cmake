# The core (more than the folder Kernel/Core): what a driver needs that includes no more than Kernel/MercuryNames.h and Drivers/Shared/CommandLine.h, two
# thirds of the kernel's files. Who builds such a driver compiles no other file. There is no list of it. A file is needed if its
# header is (that of the same name; for a file without one, the first that it includes), and so is all that it includes,
# but for what notInCore names. That the core needs nothing else, the test CoreAlone shows: it links as a whole by itself.
# Read when CMake runs: after a new #include in a file of the core, run CMake again.

set(coreRoots Kernel/MercuryNames.h Drivers/Shared/CommandLine.h)
# Files that files of the core include or share a header with, and do not call: species of several types; meshes,
# superquadrics and files of other programs, which scenes add by headers of their own; and laws of bridges by tables or
# fits, with the solver of their equations, which only a driver that names such a law calls.
set(notInCore "SpeciesRegistry|SeveralSpecies|/TriangleWall|/TriangleReader|/MeshParts\\.cpp|/SuperquadricHandler"
    "/BlockGeometry\\.cpp|/PolyDataReader|/YoungLaplace/.*\\.cpp|YoungLaplace\\.cpp|/FittedBridge\\.cpp|/ExactBridge\\.cpp"
    "/BridgeSurface\\.cpp")
list(JOIN notInCore "|" notInCore)
# Headers of the core that also declare, or call, what the core has not.
set(headersOfMore "/Membrane\\.h|/MembraneNet\\.h|/FaceSurface\\.h|/PolyData\\.h")
set(lawsOfCore "LiquidBridge(Bagheri|Willett?|Volume)")
set(lawsOfOthers "LiquidBridge|LiquidMigration|YoungLaplace|[Bb]ridgeArea|olveBridgeSurface")

# In `result`: the files of ours that a file includes, as paths in the repository.
function(pendular_includes_of file result)
    set(found "")
    foreach(folder "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/Generated")
        if(EXISTS "${folder}/${file}")
            file(STRINGS "${folder}/${file}" found REGEX "^[ \t]*#[ \t]*include[ \t]*[\"<](Kernel|Drivers|[^>]*\")")
            break()
        endif()
    endforeach()
    list(TRANSFORM found REPLACE "^[ \t]*#[ \t]*include[ \t]*[\"<]([^\">]*)[\">].*$" "\\1")
    set(${result} "${found}" PARENT_SCOPE)
endfunction()

# In coreHeaders (in the repository) and coreSources (full paths): what coreRoots need of `sources` (full paths).
function(pendular_find_core sources)
    foreach(source IN LISTS sources)
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
        string(REGEX REPLACE "\\.cpp$" ".h" header "${source}")
        if(NOT EXISTS "${PROJECT_SOURCE_DIR}/${header}")
            pendular_includes_of("${source}" included)
            list(GET included 0 header)
        endif()
        list(APPEND "sourcesOf/${header}" "${source}")
    endforeach()
    set(open ${coreRoots})
    set(core "")
    while(open)
        list(POP_BACK open file)
        if(NOT DEFINED "seen/${file}" AND NOT file MATCHES "${notInCore}")
            set("seen/${file}" TRUE)
            list(APPEND core "${file}")
            pendular_includes_of("${file}" included)
            list(APPEND open ${included} ${sourcesOf/${file}})
        endif()
    endwhile()
    set(headers ${core})
    list(FILTER headers INCLUDE REGEX "\\.h$")
    foreach(header IN LISTS headers)
        string(REGEX REPLACE "\\.h$" ".cpp" source "${header}")
        if(source MATCHES "${notInCore}" OR header MATCHES "${headersOfMore}")  # a driver that includes it needs the whole kernel
            list(REMOVE_ITEM headers "${header}")
        endif()
    endforeach()
    list(FILTER core INCLUDE REGEX "\\.cpp$")
    list(SORT core)
    list(TRANSFORM core PREPEND "${PROJECT_SOURCE_DIR}/")
    set(coreHeaders "${headers}" PARENT_SCOPE)
    set(coreSources "${core}" PARENT_SCOPE)
endfunction()

# In `result`: the text of a file without comments and blanks, with species by the names that they have in the lists.
function(pendular_plain_text file result)
    file(READ "${file}" text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX REPLACE "[ \t\r\n]|pendular::" "" text "${text}")
    string(REGEX REPLACE "Species<([A-Za-z]+),([A-Za-z]+),([A-Za-z]+)>" "\\1\\2\\3Species" text "${text}")
    string(REGEX REPLACE "(NoFriction|NoAdhesion)" "" text "${text}")
    string(REGEX REPLACE "Willett?" "Willett" text "${text}")
    set(${result} "${text}" PARENT_SCOPE)
endfunction()

# In `isCore`: whether the core and popular species are all that a driver needs; in `species`: the libraries of those
# that it names. Not where a scene has species of several types, which know all popular ones, or where its text does not
# tell its species.
function(pendular_is_core_driver sources isCore species)
    set(is TRUE)
    set(libraries "")
    foreach(source IN LISTS sources)
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE relative)
        pendular_includes_of("${relative}" included)
        list(REMOVE_ITEM included ${coreHeaders})
        pendular_plain_text("${source}" text)
        string(REGEX REPLACE "${lawsOfCore}" "" otherLaws "${text}")
        string(REGEX REPLACE "Simulation<([A-Za-z0-9_]+|decltype\\([A-Za-z0-9_]+\\))>" "" otherScenes "${text}")
        if(included OR otherScenes MATCHES "Simulation<" OR otherLaws MATCHES "${lawsOfOthers}")
            set(is FALSE)
        endif()
        string(REGEX MATCHALL "[A-Za-z]+Species" names "${text}")
        foreach(name IN LISTS names)
            list(FIND PENDULAR_POPULAR_SPECIES "${name}" at)
            if(at GREATER_EQUAL 0)
                list(APPEND libraries PendularSpecies${at})
            endif()
        endforeach()
    endforeach()
    list(REMOVE_DUPLICATES libraries)
    set(${isCore} ${is} PARENT_SCOPE)
    set(${species} "${libraries}" PARENT_SCOPE)
endfunction()
