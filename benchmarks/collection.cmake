# Makes a small collection in FOLDER, runs PROGRAM on it and looks for every verdict.
file(REMOVE_RECURSE ${FOLDER})
file(WRITE ${FOLDER}/lcp/solved.dat "2\n0\n2\n2\n2\t2\n2 1\n1 2\n-5 -6\n")
file(WRITE ${FOLDER}/lcp/never.dat "1\n0\n1\n1\n1\t1\n-1\n-1\n")
file(WRITE ${FOLDER}/lcp/broken.dat "2\n0\n2\n2\n2\t2\n2 nan\n1 2\n-5 -6\n")
file(WRITE ${FOLDER}/mlcp/solved.dat "1 1 1 1\n0 1 2\n0 1\n0 2 2 2 2\n0 1\n-1 1\n1 2\n")
file(WRITE ${FOLDER}/fc3d/one.dat "3 1 0 3 3 3 3\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0.5\n")
file(WRITE ${FOLDER}/fc3d/pull.dat "3 1 0 3 3 3 3\n-1 0 0\n0 -1 0\n0 0 -1\n-1 0 0\n0.5\n")
file(WRITE ${FOLDER}/fc3d/three.dat "3 3 0 9 9 9 9\n1 0 0 0 0 0 0 0 0\n0 1 0 0 0 0 0 0 0
0 0 1 0 0 0 0 0 0\n0 0 0 1 0 0 0 0 0\n0 0 0 0 1 0 0 0 0\n0 0 0 0 0 1 0 0 0\n0 0 0 0 0 0 1 0 0
0 0 0 0 0 0 0 1 0\n0 0 0 0 0 0 0 0 1\n-1 0 0 -1 0 0 -1 0 0\n0.5 0.5 0.5\n")
file(WRITE ${FOLDER}/fc3d/torn.dat "3 1 0 3 3 3 3\n0 1 0\n0 0 0\n0 0 0\n-1 0 0\n0.5\n")
file(WRITE ${FOLDER}/fc3d/wedge.dat "3 2 0 6 6 6 6\n1 0 0 -1 0 0\n0 1 0 0 -1 0\n0 0 1 0 0 -1
-1 0 0 1 0 0\n0 -1 0 0 1 0\n0 0 -1 0 0 1\n-1 0 0 -1 0 0\n0.5 0.5\n")
file(WRITE ${FOLDER}/other/file.dat "1\n")
execute_process(COMMAND ${PROGRAM} ${FOLDER} -o ${FOLDER}/runs.csv
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE summary)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${result}:\n${summary}")
endif()
file(STRINGS ${FOLDER}/runs.csv lines)
set(expected
  "kind,file" "fc3d,one.dat,3,1,solved"
  "fc3d,pull.dat,3,1,refused" "fc3d,three.dat,9,3,out of scope" "fc3d,torn.dat,3,1,refused"
  "fc3d,wedge.dat,6,2,refused" "lcp,broken.dat,0,0,not read"
  "lcp,never.dat,1,0,refused" "lcp,solved.dat,2,0,solved" "mlcp,solved.dat,2,0,solved"
  "other,other,0,0,out of scope")
foreach(line beginning IN ZIP_LISTS lines expected)
  string(FIND "${line}" "${beginning}" at)
  if(NOT at EQUAL 0)
    message(FATAL_ERROR "expected ${beginning}..., found:\n${line}\n${summary}")
  endif()
endforeach()
message("${summary}")

# Without a folder it ends with 2 and writes nothing.
execute_process(COMMAND ${PROGRAM} ${FOLDER}/absent
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE message)
if(NOT result EQUAL 2 OR NOT output STREQUAL "")
  message(FATAL_ERROR "no folder: ended with ${result}, printed:\n${output}")
endif()
