# Installs the client library into a folder of its own and builds the example against it, as a
# display maker would.  Needs BUILD, SOURCE, WORK.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component clients --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/clients/examples -B ${WORK}/build
    -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/prefix/bin/skerry --version)
