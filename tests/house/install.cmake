# Installs the build, and builds and runs a project against what was installed. SOURCE, BUILD,
# PREFIX (made anew), COMPILER, GENERATOR, BUILD_TYPE.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${PREFIX})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}/installed)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/house/consumer -B ${PREFIX}/consumer -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_PREFIX_PATH=${PREFIX}/installed -DEXAMPLES=${SOURCE}/examples)
# Nothing of the clone is seen: neither headers nor libraries.
file(STRINGS ${PREFIX}/consumer/CMakeCache.txt package REGEX "^prehensile_DIR")
if(NOT package MATCHES "${PREFIX}/installed")
  message(FATAL_ERROR "another package was found: ${package}")
endif()
run(${CMAKE_COMMAND} --build ${PREFIX}/consumer)
run(${PREFIX}/consumer/instant)
file(READ ${SOURCE}/examples/01_instant.txt expected)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the instant prints\n${output}\nexpected\n${expected}")
endif()
if(EXISTS ${PREFIX}/consumer/ompl)
  run(${PREFIX}/consumer/ompl)
endif()
run(${PREFIX}/consumer/plan ${SOURCE}/problems/published/tee_21.yaml ${PREFIX}/plan.json)
