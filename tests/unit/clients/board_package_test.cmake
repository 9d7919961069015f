# Installs the clients into a folder of their own and builds the board's C example against it, once
# by find_package and once by pkg-config, as the maker of a plotter would.
# Needs BUILD, SOURCE, WORK, CC, PKG_CONFIG.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

# Whether the example runs: it loads the installed library, and says so of a place that is none.
function(expect_refusal program)
  execute_process(COMMAND ${program} nowhere RESULT_VARIABLE result ERROR_VARIABLE said)
  if(NOT result EQUAL 1 OR NOT said MATCHES "azimuths: nowhere: ARGUMENT: .*tcp://host:port/radar")
    message(FATAL_ERROR "${program} ended with ${result}: ${said}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component clients --prefix ${WORK}/built)
file(RENAME ${WORK}/built ${WORK}/moved)  # an installed tree may be moved
set(prefix ${WORK}/moved)

run(${CMAKE_COMMAND} -S ${SOURCE}/clients/board/examples -B ${WORK}/build
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${CC})
run(${CMAKE_COMMAND} --build ${WORK}/build)
expect_refusal(${WORK}/build/azimuths)

file(GLOB_RECURSE pc ${prefix}/*/skerry_board.pc)
get_filename_component(pc_folder ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs "skerry_board >= 1.0" OUTPUT_VARIABLE options
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(options)
run(${CC} -std=c99 ${SOURCE}/clients/board/examples/azimuths.c -o ${WORK}/azimuths
    ${options})
get_filename_component(library_folder ${pc_folder} DIRECTORY)
set(ENV{LD_LIBRARY_PATH} ${library_folder})
expect_refusal(${WORK}/azimuths)
