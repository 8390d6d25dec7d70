# whittle_module(NAME SOURCES ... DEPENDS ... TESTS ...)
#
# One folder of src/, one library whittle_NAME. TESTS become one program NAME_test whose cases CTest
# knows one by one, labelled `unit`. DEPENDS names libraries; only those to the left in the data path.
function(whittle_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;TESTS;TEST_DEPENDS;TEST_ENVIRONMENT" ${ARGN})
  if(arg_SOURCES)
    add_library(whittle_${name} STATIC ${arg_SOURCES})
    target_include_directories(whittle_${name}
                               PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
    target_link_libraries(whittle_${name} PUBLIC ${arg_DEPENDS})
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
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}/" DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS unit TIMEOUT 60 ENVIRONMENT "${arg_TEST_ENVIRONMENT}")
  endif()
endfunction()
