# Passes if `source` does not compile and the compiler's messages match the regular expression in the source's line
#   // expect: <regular expression of CMake>
# or, with "// expect: success", if it compiles.

file(STRINGS "${source}" expectation REGEX "^// expect: ." LIMIT_COUNT 1)
if(NOT expectation)
    message(FATAL_ERROR "${source} has no line '// expect: <regular expression>'.")
endif()
string(REGEX REPLACE "^// expect: *" "" expected "${expectation}")

set(ENV{LC_ALL} C)  # messages in English, with plain quotation marks
execute_process(COMMAND "${compiler}" "@${flags}" -fsyntax-only "${source}"
                RESULT_VARIABLE result OUTPUT_VARIABLE messages ERROR_VARIABLE messages)

if(expected STREQUAL "success")
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${source} must compile, but:\n${messages}")
    endif()
elseif(result EQUAL 0)
    message(FATAL_ERROR "${source} must not compile, but it does.")
elseif(NOT messages MATCHES "${expected}")
    message(FATAL_ERROR "${source} does not compile, as it must, but no message matches '${expected}':\n${messages}")
endif()
