# The program `view` (Tools/View): a library of all but what knows the HTTP library, so that tests and fuzz targets need no
# socket; the program; and its page, by npm and esbuild, as a target of its own, `view-page`, into Tools/ViewPage.

file(GLOB viewSources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/Tools/View/*.cpp")
list(FILTER viewSources EXCLUDE REGEX "/(view|Server)\\.cpp$")
add_library(PendularView STATIC ${viewSources})
target_link_libraries(PendularView PUBLIC Pendular::Kernel)
target_include_directories(PendularView SYSTEM PUBLIC "${JSON_INCLUDE_FOLDER}")
add_warnings(PendularView)
precompile_headers(PendularView PendularCore)

if(TARGET CLI11::CLI11 AND NOT isQuickSanitizer)
    add_program(view Tools "${PROJECT_SOURCE_DIR}/Tools/View/view.cpp" "${PROJECT_SOURCE_DIR}/Tools/View/Server.cpp")
    target_include_directories(view PRIVATE "${MICROHTTPD_INCLUDE_FOLDER}")
    target_link_libraries(view PRIVATE PendularView "${MICROHTTPD_LIBRARY}")
    # A package has drivers and other programs in one folder: which are which.
    set(driverNames ${driverFolders})
    list(TRANSFORM driverNames REPLACE ".*/" "")
    list(JOIN driverNames "\n" driverList)
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/Generated/drivers.txt" CONTENT "@driverList@\n" @ONLY)
    if(NOT PENDULAR_LEVEL_OF)
        install(FILES "${PROJECT_BINARY_DIR}/Generated/drivers.txt" DESTINATION share/pendular COMPONENT programs EXCLUDE_FROM_ALL)
    endif()
endif()

# Where npm is found. `npm ci` takes exactly what package-lock.json names, with its checksums.
find_program(NPM npm)
mark_as_advanced(NPM)
if(NPM)
    set(viewPage "${PROJECT_BINARY_DIR}/Tools/ViewPage")
    set(viewPageSource "${PROJECT_SOURCE_DIR}/Tools/View/Page")
    set(viewPageWork "${PROJECT_BINARY_DIR}/ViewPage")
    file(GLOB_RECURSE viewPageFiles CONFIGURE_DEPENDS "${viewPageSource}/src/*")
    set(viewPagePackages "${viewPageSource}/package.json" "${viewPageSource}/package-lock.json")
    add_custom_command(OUTPUT "${viewPageWork}/installed"
        COMMAND "${CMAKE_COMMAND}" -E make_directory "${viewPageWork}"
        COMMAND "${CMAKE_COMMAND}" -E copy ${viewPagePackages} "${viewPageWork}"
        COMMAND "${NPM}" ci --no-audit --no-fund --ignore-scripts --loglevel=error --prefix "${viewPageWork}"
        COMMAND "${CMAKE_COMMAND}" -E touch "${viewPageWork}/installed"
        DEPENDS ${viewPagePackages}
        COMMENT "Installing what the page of view is made of (npm)" VERBATIM)
    add_custom_command(OUTPUT "${viewPage}/main.js"
        COMMAND "${CMAKE_COMMAND}" -E copy_directory "${viewPageSource}/src" "${viewPageWork}/src"
        COMMAND "${CMAKE_COMMAND}" -E chdir "${viewPageWork}" "${CMAKE_COMMAND}" -E env "VIEW_PAGE=${viewPage}"
                "${NPM}" run --silent build -- --log-level=warning
        COMMAND "${CMAKE_COMMAND}" -E copy "${viewPageSource}/index.html" "${viewPageSource}/icon.svg" "${viewPage}"
        DEPENDS "${viewPageWork}/installed" ${viewPageFiles} "${viewPageSource}/index.html" "${viewPageSource}/icon.svg"
        COMMENT "Building the page of view" VERBATIM)
    add_custom_target(view-page DEPENDS "${viewPage}/main.js")
    if(NOT PENDULAR_LEVEL_OF)
        install(DIRECTORY "${viewPage}" DESTINATION share/pendular COMPONENT programs OPTIONAL EXCLUDE_FROM_ALL)
    endif()
endif()
