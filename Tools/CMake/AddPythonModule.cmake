# The Python package pendular, of Tools/Python/: in the build folder it is Python/pendular, so that
# PYTHONPATH=build/release/Python finds it.

# Besides the popular ones.
set(pythonSpecies SinterMindlinSpecies HertzianSinterMindlinSpecies LinearViscoelasticSlidingRollingTorsionSpecies
    LinearPlasticViscoelasticSlidingRollingTorsionSpecies HertzianViscoelasticMindlinIncrementalRollingTorsionSpecies)
set(PENDULAR_PYTHON_SPECIES "" CACHE STRING
    "Further species of the Python module, by their names (a list): 10 s each to compile")
set(PENDULAR_PYTHON_SHAPED_SPECIES HertzianViscoelasticMindlinSpecies LinearViscoelasticSlidingFrictionSpecies CACHE STRING
    "Species of superquadrics and blocks in the Python module (a list): 10 s each to compile")

set(pythonFolder "${PROJECT_SOURCE_DIR}/Tools/Python")
set(pythonPackage "${buildOfAllLevels}/Python/pendular")
set(pythonKernelFolder "${pythonPackage}/${levelFolder}")
set(pythonGenerated "${PROJECT_BINARY_DIR}/Generated/Python")
foreach(list IN ITEMS PENDULAR_PYTHON_SPECIES PENDULAR_PYTHON_SHAPED_SPECIES)  # their names are as those in Python, too
    list(TRANSFORM ${list} REPLACE "Species$" "" OUTPUT_VARIABLE ${list}Named)
    list(TRANSFORM ${list}Named APPEND "Species")
endforeach()
list(APPEND pythonSpecies ${PENDULAR_PYTHON_SPECIESNamed})
list(REMOVE_DUPLICATES pythonSpecies)
list(REMOVE_ITEM pythonSpecies ${PENDULAR_POPULAR_SPECIES})
pendular_instantiate_species("${pythonGenerated}" PythonSpecies "${pythonSpecies}" 3 pythonSpeciesSources)
list(JOIN PENDULAR_PYTHON_SHAPED_SPECIESNamed ", " shapedSpecies)
file(CONFIGURE OUTPUT "${pythonGenerated}/ShapedSpecies.h" @ONLY CONTENT [[
#pragma once

// Written by CMake from PENDULAR_PYTHON_SHAPED_SPECIES.

#include "Kernel/Features/Laws.h"

namespace pendular {

using ShapedSpecies = TypeList<@shapedSpecies@>;

}  // namespace pendular
]])

file(CONFIGURE OUTPUT "${pythonGenerated}/Version.h" @ONLY CONTENT [[
#pragma once

// Written by CMake.

namespace pendular::python {

inline constexpr const char* version = "@PROJECT_VERSION@";

}  // namespace pendular::python
]])

file(GLOB pythonSources CONFIGURE_DEPENDS "${pythonFolder}/*.cpp")
file(GLOB_RECURSE kernelHeaders CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Kernel/*.h")
add_custom_command(OUTPUT "${pythonGenerated}/Comments.cpp"
    COMMAND "${Python_EXECUTABLE}" "${pythonFolder}/make-comments.py" "${pythonGenerated}/Comments.cpp"
            "${PROJECT_SOURCE_DIR}/Kernel" ${pythonSources}
    DEPENDS "${pythonFolder}/make-comments.py" ${pythonSources} ${kernelHeaders}
    COMMENT "Taking what help() says from the kernel's comments" VERBATIM)

# What computes contacts, with -O3: also for the program SameBits of the tests.
list(REMOVE_ITEM pythonSources "${pythonFolder}/MoreSpecies.cpp")
add_library(PendularPythonSpecies OBJECT "${pythonFolder}/MoreSpecies.cpp" ${pythonSpeciesSources})
target_link_libraries(PendularPythonSpecies PRIVATE PendularKernel)
add_warnings(PendularPythonSpecies)
precompile_headers(PendularPythonSpecies PendularCore)

pybind11_add_module(PendularPython MODULE NO_EXTRAS ${pythonSources} "${pythonGenerated}/Comments.cpp"
                    $<TARGET_OBJECTS:PendularPythonSpecies>)
# Whole: a library of species that is loaded calls functions which the module itself does not.
target_link_libraries(PendularPython PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,PendularKernel>")
set_target_properties(PendularPython PROPERTIES OUTPUT_NAME _kernel LIBRARY_OUTPUT_DIRECTORY "${pythonKernelFolder}")
# Of the bindings alone, which compute nothing: half of the time of -O3.
target_compile_options(PendularPython PRIVATE $<$<CONFIG:Release>:-O1>)
# What computes contacts keeps -O3.
set_source_files_properties("${pythonFolder}/ShapedScene.cpp" PROPERTIES
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O3> SKIP_PRECOMPILE_HEADERS ON)
add_warnings(PendularPython)
precompile_headers(PendularPython PendularPython "${pythonFolder}/Bindings.h" <fmt/format.h>)
set_source_files_properties("${pythonGenerated}/Comments.cpp" PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
compile_together(PendularPython "${pythonGenerated}/Comments.cpp")

# Its types, from the module itself.
if(NOT PENDULAR_LEVEL_OF)  # this machine may not run it
    add_custom_command(TARGET PendularPython POST_BUILD
        COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${pythonKernelFolder}" PYTHONDONTWRITEBYTECODE=1
                "${Python_EXECUTABLE}" "${pythonFolder}/make-stubs.py" "${pythonPackage}/_kernel.pyi"
        COMMENT "Writing the types of the Python module" VERBATIM)
endif()

# The examples as notebooks.
file(GLOB pythonExamples CONFIGURE_DEPENDS "${pythonFolder}/Examples/*.py")
set(notebooks "${PROJECT_BINARY_DIR}/Python/Notebooks")
add_custom_command(OUTPUT "${notebooks}/collision.ipynb"
    COMMAND "${Python_EXECUTABLE}" "${pythonFolder}/make-notebooks.py" "${notebooks}"
    DEPENDS "${pythonFolder}/make-notebooks.py" ${pythonExamples}
    COMMENT "Making notebooks of the examples in Python" VERBATIM)
add_custom_target(PendularNotebooks DEPENDS "${notebooks}/collision.ipynb")
add_dependencies(PendularPython PendularNotebooks)

# The files in Python: links, so that an edit is there at once.
file(GLOB pythonFiles CONFIGURE_DEPENDS "${pythonFolder}/Package/*")
foreach(file IN LISTS pythonFiles)
    cmake_path(GET file FILENAME name)
    file(MAKE_DIRECTORY "${pythonPackage}")
    file(CREATE_LINK "${file}" "${pythonPackage}/${name}" SYMBOLIC)
endforeach()

# Where Python finds it: below /usr in the folder of Debian's packages, else in that of the prefix. (The prefix is known as
# it is installed.)
set(ownSite "lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/site-packages")
if(Python_SITEARCH MATCHES "/dist-packages$")
    string(REPLACE site-packages dist-packages ownSite "${ownSite}")
endif()
install(CODE "
set(pythonSite \"${ownSite}\")
if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\" AND pythonSite MATCHES dist-packages)
    set(pythonSite lib/python3/dist-packages)
endif()" ALL_COMPONENTS)
set(site "\${pythonSite}/pendular")
install(TARGETS PendularPython LIBRARY DESTINATION "${site}/${levelFolder}" COMPONENT python OPTIONAL)
install(FILES ${pythonFiles} DESTINATION "${site}" COMPONENT python)
install(FILES "${pythonPackage}/_kernel.pyi" DESTINATION "${site}" COMPONENT python OPTIONAL)
install(DIRECTORY "${pythonFolder}/Examples" DESTINATION share/pendular COMPONENT python USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE)
install(DIRECTORY "${notebooks}" DESTINATION share/pendular COMPONENT python OPTIONAL)
