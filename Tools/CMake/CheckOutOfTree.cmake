# Installs the build in `pendular` to a temporary prefix, then configures, builds and runs the project in
# `source` against it.

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
