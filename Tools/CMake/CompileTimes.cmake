# What makes the build short: files that are compiled together, precompiled headers, and the memory of the compilers.

set(PENDULAR_FILES_AT_A_TIME 16 CACHE STRING
    "How many files of the kernel, of the drivers' library and of the Python module are compiled as one; 0: each by itself, so that an edit of one compiles no other")
if(NOT PENDULAR_FILES_AT_A_TIME MATCHES "^[0-9]+$")
    message(FATAL_ERROR "PENDULAR_FILES_AT_A_TIME is '${PENDULAR_FILES_AT_A_TIME}'; it must be a number of files, 16 for "
                        "example, or 0 to compile each file by itself.")
endif()

# Memory (MB) for one compiler: the largest takes 1.6 GB.
set(memoryOfCompiler 1800)

# In `result`: the memory of this machine in MB, or that of the container where it is less.
function(find_memory result)
    cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
    foreach(file IN ITEMS memory.max memory/memory.limit_in_bytes)  # control groups, versions 2 and 1
        if(EXISTS "/sys/fs/cgroup/${file}")
            file(READ "/sys/fs/cgroup/${file}" limit)
            string(STRIP "${limit}" limit)
            if(limit MATCHES "^[0-9]+$")
                math(EXPR limit "${limit} / 1048576")
                if(limit LESS memory)
                    set(memory ${limit})
                endif()
            endif()
        endif()
    endforeach()
    set(${result} ${memory} PARENT_SCOPE)
endfunction()

# Fewer compilers at the same time where there is not memory for one on each processor (generator Ninja).
find_memory(memory)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
math(EXPR compilers "${memory} / ${memoryOfCompiler}")
if(compilers LESS 1)
    set(compilers 1)
endif()
if(PROJECT_IS_TOP_LEVEL AND compilers LESS processors AND NOT DEFINED CMAKE_JOB_POOL_COMPILE)
    set_property(GLOBAL APPEND PROPERTY JOB_POOLS compilers=${compilers})
    set(CMAKE_JOB_POOL_COMPILE compilers)
    message(STATUS "This machine has ${memory} MB of memory, and a compiler takes up to ${memoryOfCompiler}: at most ${compilers} at the same time.")
endif()

# g++ collects garbage whenever its heap has grown to some 128 MB, which a precompiled header alone exceeds. With 1.5 GB
# allowed before, files compile in 0.8 to 0.95 of the time, with a tenth to a fifth more memory. The code is the same.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND memory GREATER 3000)
    add_compile_options(--param=ggc-min-heapsize=1500000)
endif()

# All code runs at any address, as that of a Python module must: who adds Python later compiles no file of the kernel
# again. Debian's compiler makes programs of this kind anyway (-fPIE), so it costs no time. One flag for all targets, so
# that they share precompiled headers. -fno-semantic-interposition: no other library puts its functions in the place of
# ours, so calls stay direct.
add_compile_options(-fPIC $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)

# What most files of a target include is compiled once, for all targets that have the same flags; the first one keeps
# it. (g++ compiles a file with the -O of its precompiled header, whatever the file's own is.)
function(precompile_headers target keeper)
    if(NOT PENDULAR_PRECOMPILED_HEADERS)
        return()
    elseif(target STREQUAL keeper)
        target_precompile_headers(${target} PRIVATE ${ARGN})
    else()
        target_precompile_headers(${target} REUSE_FROM ${keeper})
    endif()
endfunction()

# The files of a target are compiled together, so that headers are read and templates instantiated once for all of
# them. No two of them may give one name to two things (in unnamed namespaces), nor a name that a header has: the
# tests OneUnit/... look for that. Files with definitions of their own stay apart, and so do those that follow.
function(compile_together target)
    if(PENDULAR_FILES_AT_A_TIME)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PENDULAR_FILES_AT_A_TIME})
        set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
endfunction()
