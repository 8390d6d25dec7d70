# Installs `build` into `folder`, runs what is there, and builds and runs `example` with it.
file(REMOVE_RECURSE ${folder})
set(prefix ${folder}/prefix)

function(must_work)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output
                  RESULT_VARIABLE result WORKING_DIRECTORY ${folder})
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}\nended with ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${folder})
must_work(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})

must_work(${prefix}/bin/whittle ${model} -o picture.png --imgsize 32,32)
file(READ ${folder}/picture.png start LIMIT 8 HEX)
if(NOT start STREQUAL "89504e470d0a1a0a")
  message(FATAL_ERROR "the installed program wrote no PNG")
endif()

must_work(${CMAKE_COMMAND} -G ${generator} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B consumer
          -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D example=${example})
must_work(${CMAKE_COMMAND} --build consumer)
must_work(consumer/consumer ${model})
if(NOT output MATCHES "seen: primitive [1-9][0-9]*, line [1-9][0-9]*\nstopped")
  message(FATAL_ERROR "the example said: ${output}")
endif()
