# Configures and builds the project with some options off, and runs the default tests of the
# core. SOURCE, BINARY, OFF (options, separated by commas), RUN_TESTS.
string(REPLACE "," ";" options "${OFF}")
set(arguments -DPREHENSILE_BENCHMARKS=OFF -DPREHENSILE_WARNINGS_AS_ERRORS=ON)
foreach(option ${options})
  list(APPEND arguments -D${option}=OFF)
endforeach()
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja -DCMAKE_BUILD_TYPE=Release ${arguments})
run(${CMAKE_COMMAND} --build ${BINARY})
if(RUN_TESTS)
  run(${CMAKE_CTEST_COMMAND} --test-dir ${BINARY} -L default --output-on-failure
      --no-tests=error)
endif()
