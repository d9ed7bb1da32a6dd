# A folder below SelfTests/ with a *Test.cpp in it is a test program, made of all .cpp files in the folder. One more has
# the tests of all studies, Tools/Studies/*/Tests/*.cpp (PENDULAR_BUILD_STUDIES), but those of LatticeBoltzmann, which have
# their own (PENDULAR_LATTICE_BOLTZMANN).
#   SelfTests/CompileFail/*.cpp  must not compile, with the message they expect (CheckCompileFailure.cmake)
#   SelfTests/Hosts/Library/     a library of species, loaded by the test program of SelfTests/Hosts/
#   SelfTests/Python/            tests of the Python module (AddPythonTests.cmake)
#   SelfTests/View/              tests of the program view: also with a browser, in Python (AddViewTests.cmake)
#   SelfTests/OutOfTree/         a driver outside the tree, built against the installed kernel (CheckOutOfTree.cmake)
# Labels, by the beginning of the suite's name:
#   fast   all that are not named otherwise
#   heavy  Heavy...: seconds of computing; not run under the sanitizers, which make them ten times as long
#   long   Long...: minutes; run only by ctest --preset long
# PENDULAR_SHARE_SMALL_WORK: threads share also what is not worth a thread, so that tests of them can be small.
#   build  (with fast) those that only run a compiler; not run under the sanitizers

enable_testing()
include(GoogleTest)
find_package(GTest QUIET)
if(NOT TARGET GTest::gtest_main)
    message(FATAL_ERROR "The self-tests need GoogleTest: install libgtest-dev, or build without them "
                        "(-DPENDULAR_BUILD_TESTS=OFF).")
endif()

set(selfTests "${PROJECT_SOURCE_DIR}/SelfTests")

# The kernel, the species of the lists and the programs keep -O3; the tests themselves take no longer with -O1. With it
# g++ 12 follows the lengths of strings and arrays only half, and warns of what cannot be.
set(quickTests $<AND:$<BOOL:${PENDULAR_QUICK_TEST_BUILD}>,$<CONFIG:Release>>)
set(testOptimisation $<${quickTests}:-O1>)
foreach(warning array-bounds restrict stringop-overflow stringop-overread)
    list(APPEND testOptimisation $<$<AND:${quickTests},$<CXX_COMPILER_ID:GNU>>:-Wno-${warning}>)
endforeach()

function(pendular_add_self_test folder sources)
    string(REPLACE "/" "" joined "${folder}")
    set(name "SelfTest${joined}")
    file(GLOB sources CONFIGURE_DEPENDS "${sources}")
    if(folder STREQUAL Studies)
        list(FILTER sources EXCLUDE REGEX "/LatticeBoltzmann/")
    endif()
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE SpeciesOfTests PendularReference $<TARGET_NAME_IF_EXISTS:PendularDrivers> Pendular::Kernel
                          GTest::gtest_main)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
    # Many small files with the same includes and species: together they compile in a sixth of the time.
    if(folder STREQUAL HowDoI OR folder STREQUAL Fuzz/RandomScenes)
        set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 14)
        set_source_files_properties("${selfTests}/HowDoI/FirstDriver.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    elseif(NOT folder STREQUAL Fuzz)  # its readers are one file each, and another test compiles them alone
        set_target_properties(${name} PROPERTIES UNITY_BUILD ${PENDULAR_QUICK_TEST_BUILD} UNITY_BUILD_BATCH_SIZE 12)
    endif()
    # It tests that its one header is enough.
    set_source_files_properties("${selfTests}/Species/MercuryBlockTest.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    target_compile_options(${name} PRIVATE ${testOptimisation})
    add_warnings(${name})
    precompile_headers(${name} PrecompiledTests)

    # The suite's name may follow that of an instantiation: "Materials/LongCollision.Restitution/3".
    set(long "Long*:*/Long*.*")
    set(heavy "Heavy*:*/Heavy*.*")
    set(options TEST_PREFIX "${folder}/" DISCOVERY_TIMEOUT 60)
    gtest_discover_tests(${name} ${options} TEST_FILTER "-${long}:${heavy}" TEST_LIST ${name}Fast
        PROPERTIES LABELS fast ENVIRONMENT PENDULAR_SHARE_SMALL_WORK=1)
    gtest_discover_tests(${name} ${options} TEST_FILTER "${heavy}" TEST_LIST ${name}Heavy
        PROPERTIES LABELS heavy ENVIRONMENT PENDULAR_SHARE_SMALL_WORK=1)
    gtest_discover_tests(${name} ${options} TEST_FILTER "${long}" TEST_LIST ${name}Long
        PROPERTIES LABELS long ENVIRONMENT PENDULAR_SHARE_SMALL_WORK=1)
endfunction()

# Species that several tests take, compiled once; under CI's sanitizers those of random scenes.
set(testedSpecies "${PENDULAR_SPECIES_OF_TESTS}")
if(isQuickSanitizer)
    set(testedSpecies HertzianViscoelasticDMTSpecies HertzianViscoelasticIrreversibleAdhesiveSpecies
        HertzianViscoelasticReversibleAdhesiveSpecies)
endif()
pendular_instantiate_species("${PROJECT_BINARY_DIR}/Generated/SelfTests" SpeciesOfTests "${testedSpecies}" 3 testedSources)
add_library(SpeciesOfTests STATIC ${testedSources})
target_link_libraries(SpeciesOfTests PRIVATE Pendular::Kernel)
add_warnings(SpeciesOfTests)
precompile_headers(SpeciesOfTests PendularCore)

file(GLOB_RECURSE testFolders CONFIGURE_DEPENDS RELATIVE "${selfTests}" "${selfTests}/*/*Test.cpp")
list(TRANSFORM testFolders REPLACE "/[^/]*$" "")
list(REMOVE_DUPLICATES testFolders)
list(REMOVE_ITEM testFolders CompileFail OutOfTree)
if(NOT PENDULAR_BUILD_STUDIES)
    list(REMOVE_ITEM testFolders Species/Composition)
endif()
if(NOT TARGET PendularView)
    list(REMOVE_ITEM testFolders View)
endif()
# Under a sanitizer, formulas and published figures are left out: a fifth of the build, no memory of its own. With
# PENDULAR_QUICK_TEST_BUILD, as CI has it, so is all that random scenes do as well (Fuzz/RandomScenes).
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(REMOVE_ITEM testFolders Capillary HowDoI Papers PartialSlip Species Species/Adhesion Species/Friction
         Species/Normal Stability WetCollisions)
    if(isQuickSanitizer)
        list(REMOVE_ITEM testFolders Benchmark CoarseGraining Contacts Drivers Energy Fluid Hosts InFlow Insertion Liquid
             Membranes Mercury Motion Output Periodic Programs Ranks Restart SeveralSpecies Simulation Superquadrics Walls Walls/Bodies)
    endif()
endif()
# The precompiled header of all tests, in a target of its own: a test program depends on no other one.
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/Generated/PrecompiledTests.cpp" CONTENT "")
add_library(PrecompiledTests OBJECT "${PROJECT_BINARY_DIR}/Generated/PrecompiledTests.cpp")
target_link_libraries(PrecompiledTests PRIVATE $<TARGET_NAME_IF_EXISTS:PendularDrivers> Pendular::Kernel
                      GTest::gtest_main)
target_compile_options(PrecompiledTests PRIVATE ${testOptimisation})
add_warnings(PrecompiledTests)
precompile_headers(PrecompiledTests PrecompiledTests ${precompiledHeaders} <gtest/gtest.h>
                   "Kernel/Scene/Simulation.h" "${PROJECT_BINARY_DIR}/Generated/SelfTests/SpeciesOfTests.h")
foreach(folder IN LISTS testFolders)
    pendular_add_self_test(${folder} "${selfTests}/${folder}/*.cpp")
endforeach()
if(TARGET SelfTestMercury)
    target_link_libraries(SelfTestMercury PRIVATE Pendular::MercuryHeaders)
endif()
if(PENDULAR_BUILD_STUDIES AND TARGET PendularDrivers)
    pendular_add_self_test(Studies "${PROJECT_SOURCE_DIR}/Tools/Studies/*/Tests/*.cpp")
endif()

if(TARGET StudyLatticeBoltzmann)
    pendular_add_self_test(LatticeBoltzmann "${PROJECT_SOURCE_DIR}/Tools/Studies/LatticeBoltzmann/Tests/*.cpp")
    target_link_libraries(SelfTestLatticeBoltzmann PRIVATE StudyLatticeBoltzmann)
endif()

# A library of species that a test loads: compiled as a driver is, and not linked to the kernel, which is in the
# program, whole and with its symbols shown, so that nothing is there twice.
if(TARGET SelfTestHosts)
    add_library(QuadraticSpring MODULE "${selfTests}/Hosts/Library/QuadraticSpring.cpp")
    target_compile_features(QuadraticSpring PRIVATE cxx_std_20)
    target_include_directories(QuadraticSpring PRIVATE $<TARGET_PROPERTY:PendularKernel,INTERFACE_INCLUDE_DIRECTORIES>)
    target_compile_options(QuadraticSpring PRIVATE $<TARGET_PROPERTY:PendularKernel,INTERFACE_COMPILE_OPTIONS>)
    target_link_libraries(QuadraticSpring PRIVATE Eigen3::Eigen fmt::fmt)
    set_target_properties(QuadraticSpring PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
    add_warnings(QuadraticSpring)
    set_target_properties(SelfTestHosts PROPERTIES ENABLE_EXPORTS ON DEFINE_SYMBOL ""
                          LINK_LIBRARY_OVERRIDE "WHOLE_ARCHIVE,PendularKernel,Pendular::Kernel")
    add_dependencies(SelfTestHosts QuadraticSpring)
endif()

if(TARGET SelfTestView)
    target_link_libraries(SelfTestView PRIVATE PendularView)
endif()
if(TARGET PendularView AND TARGET SelfTestFuzz)
    target_link_libraries(SelfTestFuzz PRIVATE PendularView)
    target_compile_definitions(SelfTestFuzz PRIVATE PENDULAR_HAS_VIEW)
endif()
if(hasPython)
    include(AddPythonTests)
endif()
if(TARGET view)
    include(AddViewTests)
endif()

# What must not compile: the flags of a driver, in a file for the compiler.
string(TOUPPER "${CMAKE_BUILD_TYPE}" configuration)
set(compilerFlags "${PROJECT_BINARY_DIR}/SelfTests/CompileFail/flags.txt")
set(kernelProperty "$<TARGET_PROPERTY:PendularKernel,INTERFACE")
set(driverOptions "${kernelProperty}_COMPILE_OPTIONS>")
set(kernelDefinitions "${kernelProperty}_COMPILE_DEFINITIONS>")
set(kernelIncludes "$<FILTER:${kernelProperty}_INCLUDE_DIRECTORIES>,EXCLUDE,^/usr/include$>")
file(GENERATE OUTPUT "${compilerFlags}" CONTENT
"${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${configuration}} ${CMAKE_CXX20_STANDARD_COMPILE_OPTION}
$<JOIN:${driverOptions},\n>
$<$<BOOL:${kernelDefinitions}>:-D$<JOIN:${kernelDefinitions},\n-D>>
-I\"$<JOIN:${kernelIncludes},\"\n-I\">\"
" TARGET PendularKernel)
file(GLOB failures CONFIGURE_DEPENDS "${selfTests}/CompileFail/*.cpp")
foreach(source IN LISTS failures)
    cmake_path(GET source STEM name)
    add_test(NAME CompileFail/${name}
             COMMAND "${CMAKE_COMMAND}" -D "compiler=${CMAKE_CXX_COMPILER}" -D "flags=${compilerFlags}"
                     -D "source=${source}" -P "${PROJECT_SOURCE_DIR}/Tools/CMake/CheckCompileFailure.cmake")
    set_tests_properties(CompileFail/${name} PROPERTIES LABELS "fast;build")
endforeach()

# A header compiles alone (its .cpp does not show it: a precompiled header comes before). Those that drivers include are
# compiled here, each by itself, which takes some seconds: those of folders behind the label long.
file(GLOB headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/Kernel/*.h" "${PROJECT_SOURCE_DIR}/Kernel/Foundation/Base/*.h"
     "${PROJECT_SOURCE_DIR}/Kernel/Foundation/Files/*.h" "${PROJECT_SOURCE_DIR}/Kernel/Core/Walls/*.h")
foreach(header IN LISTS headers)
    cmake_path(REPLACE_EXTENSION header .cpp OUTPUT_VARIABLE source)
    if(EXISTS "${PROJECT_SOURCE_DIR}/${source}")
        file(STRINGS "${PROJECT_SOURCE_DIR}/${source}" firstInclude REGEX "^#include" LIMIT_COUNT 1)
        if(NOT firstInclude STREQUAL "#include \"${header}\"")
            message(FATAL_ERROR "${source} does not include its own header first.")
        endif()
    endif()
    add_test(NAME Header/${header}
             COMMAND "${CMAKE_CXX_COMPILER}" "@${compilerFlags}" -O0 -fsyntax-only -x c++ -include "${header}" /dev/null
             WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
    set(label long)
    if(header MATCHES "^Kernel/[^/]*$")
        set(label fast)
    endif()
    set_tests_properties(Header/${header} PROPERTIES LABELS "${label};build")
endforeach()

# A driver compiles without precompiled headers, which would hide an include that it lacks.
if(TARGET PendularDrivers)
    foreach(source IN LISTS driverSources)
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE name)
        add_test(NAME Alone/${name} COMMAND "${CMAKE_CXX_COMPILER}" "@${compilerFlags}" -O0 -fsyntax-only "${source}")
        set_tests_properties(Alone/${name} PROPERTIES LABELS "long;build")
    endforeach()
endif()

# Files that are compiled together (compile_together) compile in any grouping: as one, no name is given twice.
function(add_one_unit_test name)
    set(unit "${PROJECT_BINARY_DIR}/SelfTests/OneUnit/${name}.cpp")
    set(files ${ARGN})
    list(FILTER files EXCLUDE REGEX "/(Hdf5File|FieldFile|ProgramRanks|DescribeOptions)\\.cpp$")  # always apart
    list(JOIN files "\"\n#include \"" included)
    file(CONFIGURE OUTPUT "${unit}" @ONLY CONTENT "#include \"@included@\"\n")
    add_test(NAME OneUnit/${name} COMMAND "${CMAKE_CXX_COMPILER}" "@${compilerFlags}" -O0 -fsyntax-only -Wall -Wextra "${unit}")
    set_tests_properties(OneUnit/${name} PROPERTIES LABELS "long;build")
endfunction()
add_one_unit_test(Kernel ${kernelSources})
if(TARGET PendularDrivers)
    add_one_unit_test(DriversLibrary ${sharedSources} ${sharedCore})
endif()

add_test(NAME OutOfTree
         COMMAND "${CMAKE_COMMAND}" -D "source=${selfTests}/OutOfTree" -D "pendular=${PROJECT_BINARY_DIR}"
                 -D "generator=${CMAKE_GENERATOR}" -D "compiler=${CMAKE_CXX_COMPILER}" -D "flags=${CMAKE_CXX_FLAGS}"
                 -D "configuration=$<CONFIG>" -P "${PROJECT_SOURCE_DIR}/Tools/CMake/CheckOutOfTree.cmake")
set_tests_properties(OutOfTree PROPERTIES LABELS "fast;build")

# The kernel of grain with grain keeps its packs in registers (Kernel/Foundation/Math/Pack.h): the block function of the most used
# species, with its three geometries, has at most this many stores of 64 bytes to the stack before its first return.
# g++ 12 makes 6 and 9; a const pack adds 3 or 4. Skipped where the registers are narrower.
find_program(PYTHON3 python3)
if(PYTHON3 AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_BUILD_TYPE STREQUAL Release)
    add_test(NAME Contacts/PacksInRegisters
             COMMAND "${PYTHON3}" "${PROJECT_SOURCE_DIR}/Tools/count-stack-stores.py" --at-most 12
                     "$<TARGET_FILE:PendularKernel>" "ContactKernel<" "computeBlock<"
                     "HertzianViscoelastic, pendular::Mindlin, pendular::NoAdhesion")
    set_tests_properties(Contacts/PacksInRegisters PROPERTIES LABELS "fast;build" SKIP_RETURN_CODE 77)
endif()

if(hasMpi AND NOT isQuickSanitizer)
    add_executable(rank-program "${selfTests}/Ranks/Program/RankProgram.cpp")
    add_executable(shared-run "${selfTests}/Ranks/Program/SharedRunProgram.cpp")
    foreach(program rank-program shared-run)
        target_link_libraries(${program} PRIVATE SpeciesOfTests Pendular::Kernel GTest::gtest)
        target_compile_options(${program} PRIVATE ${testOptimisation})
        set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
        add_warnings(${program})
    endforeach()
    add_library(CountMessages MODULE "${selfTests}/Ranks/Program/CountMessages.cpp")
    target_compile_features(CountMessages PRIVATE cxx_std_20)
    target_link_libraries(CountMessages PRIVATE MPI::MPI_CXX)
    set_target_properties(CountMessages PROPERTIES PREFIX "" SUFFIX .so
                          LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/SelfTests")
    add_warnings(CountMessages)
endif()

# The core (Core.cmake) needs nothing of the rest of the kernel: a program with all of it links.
if(TARGET PendularCommandLine AND NOT PENDULAR_FUZZ)  # whose readers are a library of their own
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/SelfTests/CoreAlone.cpp" CONTENT "int main() {}\n")
    add_executable(CoreAlone "${PROJECT_BINARY_DIR}/SelfTests/CoreAlone.cpp")
    target_link_libraries(CoreAlone PRIVATE
        "-Wl,--whole-archive,$<TARGET_FILE:PendularCommandLine>,$<TARGET_FILE:PendularCore>,--no-whole-archive")
    target_link_libraries(CoreAlone PRIVATE PendularCommandLine)  # and what they need, behind them
    add_test(NAME CoreAlone COMMAND CoreAlone)
    add_test(NAME CoreDrivers COMMAND "${CMAKE_COMMAND}" -D "source=${PROJECT_SOURCE_DIR}" -D "build=${PROJECT_BINARY_DIR}"
             -P "${PROJECT_SOURCE_DIR}/Tools/CMake/CheckCoreDrivers.cmake")
    set_tests_properties(CoreAlone CoreDrivers PROPERTIES LABELS "fast;build")
endif()
