# whittle_discover_tests(PROGRAM PREFIX LABEL TIMEOUT [LONG FILTER] [RACES FILTER] [WITHOUT FILTER]
#                        [ENVIRONMENT VARIABLE=VALUE])
#
# CTest knows the cases of a GoogleTest program one by one, as PREFIX/NAME, with that label. Those that
# the filter LONG chooses are LABEL-long instead: what takes too long with a sanitizer. Those that RACES
# chooses are LABEL-races: what the thread sanitizer is to see. (`ctest -L LABEL` runs all three: it looks
# for a part of the name.) WITHOUT leaves some out.
function(whittle_discover_tests program prefix label timeout)
  cmake_parse_arguments(arg "" "LONG;RACES;WITHOUT;ENVIRONMENT" "" ${ARGN})
  set(out "${arg_WITHOUT}")
  foreach(kind long races rest)
    string(TOUPPER ${kind} option)
    set(filter "${arg_${option}}")
    set(full_label ${label}-${kind})
    if(kind STREQUAL "rest")
      set(filter "*")
      set(full_label ${label})
    endif()
    if(filter)
      set(without "")
      if(out)
        set(without "-${out}")
      endif()
      gtest_discover_tests(${program} TEST_PREFIX "${prefix}/" TEST_FILTER "${filter}${without}"
                           TEST_LIST ${program}_${kind} DISCOVERY_TIMEOUT 60
                           PROPERTIES LABELS ${full_label} TIMEOUT ${timeout}
                                      ENVIRONMENT "${arg_ENVIRONMENT}")
      string(APPEND out ":${filter}")
    endif()
  endforeach()
endfunction()

# whittle_module(NAME SOURCES ... DEPENDS ... TESTS ...)
#
# One folder of src/, one library whittle_NAME. TESTS become one program NAME_test whose cases CTest
# knows one by one, labelled `unit`; TEST_RACES is for the thread sanitizer, as above. DEPENDS names
# libraries; only those to the left in the data path.
function(whittle_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;TESTS;TEST_DEPENDS;TEST_ENVIRONMENT;TEST_RACES" ${ARGN})
  if(arg_SOURCES)
    add_library(whittle_${name} STATIC ${arg_SOURCES})
    target_include_directories(whittle_${name}
                               PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
    target_link_libraries(whittle_${name} PUBLIC ${arg_DEPENDS})
    # For whoever makes a shared library of them. Nobody is to put other functions in their place, so
    # calls within them are as direct as before.
    set_target_properties(whittle_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(whittle_${name} PRIVATE -fno-semantic-interposition)
  else()
    add_library(whittle_${name} INTERFACE)
    target_include_directories(whittle_${name}
                               INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                         $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
    target_link_libraries(whittle_${name} INTERFACE ${arg_DEPENDS})
  endif()
  set_property(GLOBAL APPEND PROPERTY WHITTLE_MODULES whittle_${name})  # for Install.cmake
  if(WHITTLE_TESTS AND arg_TESTS)
    add_executable(${name}_test ${arg_TESTS})
    set_target_properties(${name}_test PROPERTIES UNITY_BUILD ${WHITTLE_JOIN_TESTS}
                                                  UNITY_BUILD_BATCH_SIZE 0)
    target_link_libraries(${name}_test PRIVATE whittle_${name} ${arg_TEST_DEPENDS} rapidcheck
                          GTest::gtest GTest::gtest_main)
    whittle_discover_tests(${name}_test ${name} unit 60 RACES "${arg_TEST_RACES}"
                           ENVIRONMENT "${arg_TEST_ENVIRONMENT}")
  endif()
endfunction()
