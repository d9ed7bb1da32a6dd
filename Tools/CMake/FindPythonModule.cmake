# Whether the Python module is built (hasPython), and if not, why (whyNoPython); what it asks of all other code.

set(hasPython FALSE)
set(whyNoPython "PENDULAR_PYTHON is OFF")
if(PENDULAR_PYTHON STREQUAL AUTO AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    set(whyNoPython "a sanitizer must be in the interpreter, too (-DPENDULAR_PYTHON=ON, and LD_PRELOAD of its library)")
elseif(NOT PENDULAR_PYTHON STREQUAL OFF)
    # The system's own one, for which there are packages of numpy and pybind11, even where another one is in front of it.
    if(NOT DEFINED Python_EXECUTABLE AND NOT DEFINED Python_ROOT_DIR AND EXISTS /usr/bin/python3)
        set(Python_EXECUTABLE /usr/bin/python3)
    endif()
    find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
    if(NOT Python_FOUND)
        set(whyNoPython "Python's headers are not found (package python3-dev)")
    else()
        find_package(pybind11 2.10 QUIET CONFIG)
        set(whyNoPython "pybind11 is not found (package pybind11-dev)")
        if(pybind11_FOUND)
            set(hasPython TRUE)
        endif()
    endif()
    if(PENDULAR_PYTHON STREQUAL ON AND NOT hasPython)
        message(FATAL_ERROR "PENDULAR_PYTHON is ON, but ${whyNoPython}.")
    endif()
endif()

# A module is a shared library: all code that goes into it must run at any address. One flag for all targets, so that
# they go on sharing precompiled headers; a second library for the module alone would take as long to compile as the
# kernel. Debian's compiler makes programs of this kind anyway (-fPIE), so it costs no time
# (Tools/Python/README.md). -fno-semantic-interposition: no other library puts its functions in the place of ours, so
# calls stay direct.
if(hasPython)
    add_compile_options(-fPIC $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
endif()
