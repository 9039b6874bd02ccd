# Runs PROGRAM --quick ARGUMENTS into FILE and counts its lines: a header and RUNS runs.
file(REMOVE ${FILE})
execute_process(COMMAND ${PROGRAM} --quick ${ARGUMENTS} -o ${FILE}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE summary)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${result}:\n${summary}")
endif()
file(STRINGS ${FILE} lines)
list(LENGTH lines count)
math(EXPR runs "${count} - 1")
if(NOT runs EQUAL RUNS)
  message(FATAL_ERROR "${FILE} has ${runs} runs, expected ${RUNS}:\n${summary}")
endif()
message("${summary}")

# An option it does not know ends it with 2 and writes nothing.
execute_process(COMMAND ${PROGRAM} --no-such-option
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE message)
if(NOT result EQUAL 2 OR NOT output STREQUAL "")
  message(FATAL_ERROR "unknown option: ended with ${result}, printed:\n${output}")
endif()
