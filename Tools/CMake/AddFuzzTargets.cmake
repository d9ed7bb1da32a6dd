# One program, FuzzReaders, made of what is in SelfTests/Fuzz/ but its test, and a run of some seconds for each of
# its targets (ctest --preset fuzz; label fuzz). What a run finds and learns stays in the folder Fuzz/TARGET.

set(PENDULAR_FUZZ_SECONDS 20 CACHE STRING "How long ctest runs each fuzz target, s")

if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
    message(FATAL_ERROR "PENDULAR_FUZZ needs clang++, which has libFuzzer (package clang): take --preset fuzz.")
endif()

enable_testing()
file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/SelfTests/Fuzz/*.cpp")
list(FILTER sources EXCLUDE REGEX "Test\\.cpp$")
add_executable(FuzzReaders ${sources})
target_link_libraries(FuzzReaders PRIVATE PendularKernel)
target_link_options(FuzzReaders PRIVATE -fsanitize=fuzzer)
add_warnings(FuzzReaders)
if(TARGET PendularView)
    target_link_libraries(FuzzReaders PRIVATE PendularView)
    target_compile_definitions(FuzzReaders PRIVATE PENDULAR_HAS_VIEW)
endif()

target_compile_options(FuzzReaders PRIVATE ${coverage})

# Per input: 5 s, 256 MiB in one piece and 2 GiB in all. max_len: no more than a few times the largest seed.
function(pendular_add_fuzz_run target maxLength)
    set(corpus "${PROJECT_BINARY_DIR}/Fuzz/${target}")
    add_test(NAME Fuzz/${target}
             COMMAND FuzzReaders --target=${target} "--seeds=${corpus}" "${corpus}" "-artifact_prefix=${corpus}-"
                     -max_total_time=${PENDULAR_FUZZ_SECONDS} -max_len=${maxLength} -timeout=5
                     -malloc_limit_mb=256 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 ${ARGN})
    set_tests_properties(Fuzz/${target} PROPERTIES LABELS fuzz)
endfunction()

set(dictionaries "${PROJECT_SOURCE_DIR}/SelfTests/Fuzz")
pendular_add_fuzz_run(GrainFile 1024)
pendular_add_fuzz_run(LammpsFile 2048 "-dict=${dictionaries}/lammps.dict")
pendular_add_fuzz_run(TriangleRows 1024)
pendular_add_fuzz_run(StlFile 2048 "-dict=${dictionaries}/stl.dict")
pendular_add_fuzz_run(ObjFile 2048 "-dict=${dictionaries}/obj.dict")
pendular_add_fuzz_run(PlyFile 2048 "-dict=${dictionaries}/ply.dict")
pendular_add_fuzz_run(PolyData 8192 "-dict=${dictionaries}/paraview.dict")
pendular_add_fuzz_run(ParaViewSeries 2048 "-dict=${dictionaries}/paraview.dict")
pendular_add_fuzz_run(FieldImage 8192 "-dict=${dictionaries}/paraview.dict")
pendular_add_fuzz_run(SummaryTable 2048)
if(TARGET PendularView)
    pendular_add_fuzz_run(Request 2048)
endif()
if(hdf5Found)
    pendular_add_fuzz_run(Hdf5Index 128)
    pendular_add_fuzz_run(Hdf5Frame 256)
    pendular_add_fuzz_run(Hdf5Bytes 32768)
    pendular_add_fuzz_run(RestartBytes 32768)
    pendular_add_fuzz_run(RestartFile 16384 "-dict=${dictionaries}/restart.dict")
    pendular_add_fuzz_run(RestartContent 256)
endif()
