# A Debian package of what is built: `cpack --config build/release/CPackConfig.cmake` writes pendular_VERSION_amd64.deb.
# Tools/make-package.sh makes one for any x86-64 machine.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pendular)
set(CPACK_PACKAGE_VENDOR Pendular)
set(CPACK_PACKAGE_CONTACT "the authors of Pendular")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(hasPython)  # a module is for one version of the interpreter
    math(EXPR nextMinor "${Python_VERSION_MINOR} + 1")
    set(major ${Python_VERSION_MAJOR})
    set(CPACK_DEBIAN_PACKAGE_DEPENDS
        "python3 (>= ${major}.${Python_VERSION_MINOR}), python3 (<< ${major}.${nextMinor}), python3-numpy")
    set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-h5py, python3-pandas, python3-matplotlib, python3-scipy")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, libeigen3-dev, libfmt-dev, zlib1g-dev, cmake, gnuplot-nox, povray, paraview")
# All in one file, also the programs, which a plain `cmake --install` leaves out.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENTS_ALL Unspecified programs python)
# Of the further levels, programs and module alone. (A project's components are those of CPACK_COMPONENTS_ and its third word.)
if(PENDULAR_ALL_LEVELS)
    set(CPACK_COMPONENTS_FURTHERLEVEL programs python)
    set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};Pendular;ALL;/")
    foreach(level IN LISTS furtherLevels)
        list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR}/${level};Pendular;FurtherLevel;/")
    endforeach()
endif()
include(CPack)
