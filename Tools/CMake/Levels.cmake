# A build for any x86-64 machine (PENDULAR_ALL_LEVELS): programs and Python module for x86-64-v2, -v3 and -v4, each in a
# folder of its level, of which the best is taken at start (Tools/pendular, Tools/Python/Package/_choose.py). This build is
# that of v2, which any machine can run; the others are builds in folders of it, of the same options.

option(PENDULAR_ALL_LEVELS "For any x86-64: programs and Python module for x86-64-v2, -v3 and -v4; the best is taken at start" OFF)
set(PENDULAR_LEVEL_OF "" CACHE PATH "Set by a build for all levels: its folder")
mark_as_advanced(PENDULAR_LEVEL_OF)

set(furtherLevels x86-64-v3 x86-64-v4)
set(levelFolder "")
set(buildOfAllLevels "${PROJECT_BINARY_DIR}")
if(PENDULAR_ALL_LEVELS)
    set(PENDULAR_INSTRUCTION_SET x86-64-v2)
    set(levelFolder x86-64-v2)
elseif(PENDULAR_LEVEL_OF)
    set(levelFolder "${PENDULAR_INSTRUCTION_SET}")
    set(buildOfAllLevels "${PENDULAR_LEVEL_OF}")
endif()

# All programs of a level have the kernel in one library beside them: forty programs with a kernel each would take 140 MB.
function(share_kernel_of_programs)
    add_library(PendularPrograms SHARED ${kernelObjects} $<TARGET_OBJECTS:PendularKernel> $<TARGET_OBJECTS:PendularCommandLine>
                $<TARGET_OBJECTS:PendularDrivers>)
    target_link_libraries(PendularPrograms PRIVATE PendularDrivers)
    install(TARGETS PendularPrograms LIBRARY DESTINATION "${programFolder}" COMPONENT programs OPTIONAL EXCLUDE_FROM_ALL)
endfunction()

# The targets PendularPythonLevels (the module alone) and, in all, PendularLevels (and the programs).
function(add_further_levels)
    add_custom_target(PendularLevels ALL)
    add_custom_target(PendularPythonLevels)
    if(TARGET PendularPython)
        add_dependencies(PendularPythonLevels PendularPython)
    endif()
    foreach(level IN LISTS furtherLevels)
        set(folder "${PROJECT_BINARY_DIR}/${level}")
        set(options "-DPENDULAR_LEVEL_OF=${PROJECT_BINARY_DIR}" -DPENDULAR_INSTRUCTION_SET=${level}
            -DPENDULAR_BUILD_TESTS=OFF -DPENDULAR_MPI=OFF)
        foreach(option CMAKE_BUILD_TYPE CMAKE_CXX_COMPILER CMAKE_CXX_COMPILER_LAUNCHER CMAKE_CXX_FLAGS Python_EXECUTABLE
                PENDULAR_PYTHON PENDULAR_PYTHON_SPECIES PENDULAR_PYTHON_SHAPED_SPECIES PENDULAR_VIEW
                PENDULAR_PRECOMPILED_HEADERS PENDULAR_FILES_AT_A_TIME PENDULAR_WARNINGS_AS_ERRORS)
            if(DEFINED ${option})
                string(REPLACE ";" "$<SEMICOLON>" value "${${option}}")
                list(APPEND options "-D${option}=${value}")
            endif()
        endforeach()
        set(configure "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}" -B "${folder}" -G "${CMAKE_GENERATOR}" ${options})
        set(build "${CMAKE_COMMAND}" --build "${folder}" --target)
        add_custom_target(Level-${level} COMMAND ${configure} COMMAND ${build} all USES_TERMINAL VERBATIM)
        add_custom_target(PendularPython-${level} COMMAND ${configure} COMMAND ${build} PendularPython USES_TERMINAL VERBATIM)
        add_dependencies(PendularLevels Level-${level})
        add_dependencies(PendularPythonLevels PendularPython-${level})
    endforeach()
endfunction()
