# Installs the build in `pendular` to a temporary prefix, then configures, builds and runs the project in
# `source` against it. One that names no type of build is optimised, and told so.

set(work "${pendular}/SelfTests/OutOfTree")
file(REMOVE_RECURSE "${work}")

function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run("${CMAKE_COMMAND}" --install "${pendular}" --prefix "${work}/prefix" --config "${configuration}")
run("${CMAKE_COMMAND}" -S "${source}" -B "${work}/build" -G "${generator}" "-DCMAKE_BUILD_TYPE=${configuration}"
    "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_PREFIX_PATH=${work}/prefix")
run("${CMAKE_COMMAND}" --build "${work}/build" --config "${configuration}")
run("${work}/build/driver")

unset(ENV{CMAKE_BUILD_TYPE})
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${source}" -B "${work}/no-type" -G "${generator}"
                "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_PREFIX_PATH=${work}/prefix"
                -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
                OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT generator MATCHES "Multi-Config|Visual Studio|Xcode")
    file(READ "${work}/no-type/compile_commands.json" commands)
    if(NOT said MATCHES "CMAKE_BUILD_TYPE is not set and becomes Release" OR NOT commands MATCHES " -O3 ")
        message(FATAL_ERROR "A project that names no type of build is not optimised, or not told so:\n${said}\n${commands}")
    endif()
endif()
