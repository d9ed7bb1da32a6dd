# The module with which programs run on several processes (PENDULAR_MPI). The kernel and the programs are not linked
# with MPI: they load the module where mpirun or srun has started them, so that all others pay nothing for it.
set(hasMpi FALSE)
set(whyNoMpi "PENDULAR_MPI is OFF")
if(PENDULAR_MPI)
    find_package(MPI 3.1 QUIET COMPONENTS CXX)
    set(hasMpi ${MPI_CXX_FOUND})
    set(whyNoMpi "no MPI-3.1 was found; runs are on one process (Tools/install-dependencies.sh --mpi)")
    if(NOT hasMpi AND NOT PENDULAR_MPI STREQUAL AUTO)
        message(FATAL_ERROR "PENDULAR_MPI is ON, and ${whyNoMpi}.")
    endif()
endif()

set(moduleFolder "${CMAKE_INSTALL_LIBDIR}/pendular")
set_source_files_properties(Kernel/Core/Ranks/ProgramRanks.cpp PROPERTIES COMPILE_DEFINITIONS
    "PENDULAR_MPI_MODULE=\"${PROJECT_BINARY_DIR}/PendularMpi.so\";PENDULAR_INSTALLED_MPI_MODULE=\"${CMAKE_INSTALL_PREFIX}/${moduleFolder}/PendularMpi.so\"")
if(hasMpi)
    add_library(PendularMpi MODULE Kernel/Features/DomainDecomposition/Mpi/MpiRanks.cpp)
    set_target_properties(PendularMpi PROPERTIES PREFIX "" SUFFIX .so
                          LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
    target_compile_features(PendularMpi PRIVATE cxx_std_20)
    target_include_directories(PendularMpi PRIVATE "${PROJECT_SOURCE_DIR}")
    target_link_libraries(PendularMpi PRIVATE MPI::MPI_CXX fmt::fmt)
    add_warnings(PendularMpi)
    add_dependencies(PendularCore PendularMpi)
    add_dependencies(PendularKernel PendularMpi)  # who builds one program alone can start it with mpirun
    install(TARGETS PendularMpi DESTINATION "${moduleFolder}" COMPONENT mpi OPTIONAL)  # not in the Debian package
endif()
