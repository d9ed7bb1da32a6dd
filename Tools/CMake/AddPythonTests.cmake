# The tests of the Python module, SelfTests/Python/*_test.py, each file as one test, by pytest. A file long_*_test.py has
# the label long, heavy_*_test.py heavy.

execute_process(COMMAND "${Python_EXECUTABLE}" -c "import numpy, pytest" RESULT_VARIABLE noPytest ERROR_QUIET OUTPUT_QUIET)
if(noPytest)
    if("$ENV{PENDULAR_REQUIRE_DEPENDENCIES}")
        message(FATAL_ERROR "The tests of the Python module need numpy and pytest (Tools/install-dependencies.sh --python).")
    endif()
    message(STATUS "The tests of the Python module are left out: numpy or pytest is not found (python3-numpy, python3-pytest)")
    return()
endif()

add_executable(SameBits "${selfTests}/Python/SameBits/SameBits.cpp" $<TARGET_OBJECTS:PendularPythonSpecies>)
target_link_libraries(SameBits PRIVATE Pendular::Kernel)
set_target_properties(SameBits PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
target_compile_options(SameBits PRIVATE ${testOptimisation})
add_warnings(SameBits)

set(speciesLibrary "")
if(TARGET QuadraticSpring)
    set(speciesLibrary "$<TARGET_FILE:QuadraticSpring>")
endif()

set(viewProgram "")
if(TARGET view)
    set(viewProgram "$<TARGET_FILE:view>")
endif()

set(wetTower "")
if(TARGET WetTower)
    set(wetTower "$<TARGET_FILE:WetTower>")
endif()

file(GLOB pythonTests CONFIGURE_DEPENDS "${selfTests}/Python/*_test.py")
foreach(file IN LISTS pythonTests)
    cmake_path(GET file STEM name)
    set(label fast)
    if(name MATCHES "^(long|heavy)_")
        set(label ${CMAKE_MATCH_1})
    endif()
    add_test(NAME Python/${name} COMMAND "${Python_EXECUTABLE}" -m pytest -q -p no:cacheprovider "${file}")
    set_tests_properties(Python/${name} PROPERTIES LABELS ${label} ENVIRONMENT
        "PYTHONPATH=${PROJECT_BINARY_DIR}/Python;PYTHONDONTWRITEBYTECODE=1;PENDULAR_SHARE_SMALL_WORK=1;PENDULAR_SAME_BITS=$<TARGET_FILE:SameBits>;PENDULAR_SPECIES_LIBRARY=${speciesLibrary};PENDULAR_VIEW=${viewProgram};PENDULAR_WET_TOWER=${wetTower};PENDULAR_MYPY_CACHE=${PROJECT_BINARY_DIR}/SelfTests/mypy")
endforeach()
