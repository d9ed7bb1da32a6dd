# The tests of `view`, SelfTests/View/*_test.py, each file as one test, by pytest. Those that need a browser have the label
# long: Chromium takes minutes to install. They are skipped where there is none.

find_program(PYTHON3 python3)
set(viewPython "${PYTHON3}")
if(EXISTS /usr/bin/python3)  # the system's own one, for which there are packages
    set(viewPython /usr/bin/python3)
endif()
execute_process(COMMAND "${viewPython}" -c "import pytest" RESULT_VARIABLE noPytest ERROR_QUIET OUTPUT_QUIET)
if(noPytest)
    if("$ENV{PENDULAR_REQUIRE_DEPENDENCIES}")
        message(FATAL_ERROR "The tests of view need pytest (Tools/install-dependencies.sh --view).")
    endif()
    message(STATUS "The tests of view are left out: pytest is not found (python3-pytest)")
    return()
endif()

add_executable(ViewFrames "${selfTests}/View/Frames/WriteFrames.cpp")
target_link_libraries(ViewFrames PRIVATE Pendular::Kernel)
set_target_properties(ViewFrames PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
target_compile_options(ViewFrames PRIVATE ${testOptimisation})
add_warnings(ViewFrames)

file(GLOB viewTests CONFIGURE_DEPENDS "${selfTests}/View/*_test.py")
foreach(file IN LISTS viewTests)
    cmake_path(GET file STEM name)
    set(label fast)
    if(name MATCHES "^(page|picture)_")
        set(label long)
    endif()
    add_test(NAME View/${name} COMMAND "${viewPython}" -m pytest -q -p no:cacheprovider "${file}")
    set_tests_properties(View/${name} PROPERTIES LABELS ${label} ENVIRONMENT
        "PYTHONDONTWRITEBYTECODE=1;PENDULAR_SHARE_SMALL_WORK=1;PENDULAR_VIEW=$<TARGET_FILE:view>;PENDULAR_VIEW_FRAMES=$<TARGET_FILE:ViewFrames>;PENDULAR_DRIVERS=${PROJECT_BINARY_DIR}/Drivers;PENDULAR_VIEW_PAGE=${PROJECT_BINARY_DIR}/Tools/ViewPage;PENDULAR_SHARED_DIR=${PENDULAR_SHARED_DIR};PENDULAR_AXE=${PROJECT_BINARY_DIR}/ViewPage/node_modules/axe-core/axe.min.js")
endforeach()
