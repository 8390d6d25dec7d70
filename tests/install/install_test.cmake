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

file(STRINGS ${prefix}/share/man/man1/whittle.1 sections REGEX "^(Synopsis|Exit codes|Files)$")
list(LENGTH sections count)
if(count LESS 2)
  message(FATAL_ERROR "the manual page has the sections ${sections}")
endif()

# What a file manager does for a small picture; %i, %o and %s are its own.
file(STRINGS ${prefix}/share/thumbnailers/whittle.thumbnailer entry)
list(GET entry 0 heading)
set(keys "")
foreach(line IN LISTS entry)
  if(line MATCHES "^(TryExec|Exec|MimeType)=(.+)$")
    list(APPEND keys ${CMAKE_MATCH_1})
    set(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
  endif()
endforeach()
if(NOT heading STREQUAL "[Thumbnailer Entry]" OR NOT keys STREQUAL "TryExec;Exec;MimeType")
  message(FATAL_ERROR "the thumbnailer has ${heading} and ${keys}")
endif()
string(REPLACE "%i" "${model}" Exec "${Exec}")
string(REPLACE "%o" "${folder}/thumbnail" Exec "${Exec}")
string(REPLACE "%s" "96" Exec "${Exec}")
separate_arguments(command UNIX_COMMAND "${Exec}")
must_work(${CMAKE_COMMAND} -E env "PATH=${prefix}/bin:$ENV{PATH}" ${command})
# The mark of a PNG, and its width and height.
file(READ ${folder}/thumbnail start LIMIT 24 HEX)
if(NOT start STREQUAL "89504e470d0a1a0a0000000d494844520000006000000060")
  message(FATAL_ERROR "the thumbnailer wrote ${start}")
endif()
find_program(update_mime update-mime-database)
if(update_mime)
  must_work(${update_mime} ${prefix}/share/mime)
  file(STRINGS ${prefix}/share/mime/globs globs REGEX "^(model/x-openscad-csg:\\*\\.csg|application/x-openscad:\\*\\.scad)$")
  list(LENGTH globs count)
  if(NOT count EQUAL 2)
    message(FATAL_ERROR "the kinds of files are ${globs}")
  endif()
endif()

must_work(${CMAKE_COMMAND} -G ${generator} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B consumer
          -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${compiler} -D example=${example})
must_work(${CMAKE_COMMAND} --build consumer)
function(must_see program)
  must_work(${program} ${model})
  if(NOT output MATCHES "seen: primitive [1-9][0-9]*, line [1-9][0-9]*\nstopped")
    message(FATAL_ERROR "the example said: ${output}")
  endif()
endfunction()
must_see(consumer/consumer)

# Without CMake.
file(GLOB_RECURSE package ${prefix}/*/whittle.pc)
cmake_path(GET package PARENT_PATH package_dir)
set(ENV{PKG_CONFIG_PATH} ${package_dir})
must_work(sh -c "'${compiler}' -std=c++20 '${example}' -o plain $(pkg-config --cflags --libs whittle)")
must_see(./plain)

# As a part of another project: without the program and what only that needs.
must_work(${CMAKE_COMMAND} -G ${generator} -S ${CMAKE_CURRENT_LIST_DIR}/part -B part
          -D CMAKE_CXX_COMPILER=${compiler} -D whittle=${source} -D WHITTLE_VULKAN=${vulkan}
          -D CMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -D CMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
