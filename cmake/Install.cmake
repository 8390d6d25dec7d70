# cmake --install: the program, and the library with its one header, a CMake package, so that
# find_package(whittle) finds whittle::whittle, and the same for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

if(WHITTLE_PROGRAM)
  install(TARGETS whittle)
  # File managers draw small pictures by it, and know what .csg is.
  install(FILES apps/whittle/desktop/whittle.thumbnailer
          DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
  install(FILES apps/whittle/desktop/whittle.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
endif()
install(FILES docs/whittle.1.md LICENSE TYPE DOC)

# The manual page is the document, translated where lowdown is there to do it.
find_program(LOWDOWN lowdown)
mark_as_advanced(LOWDOWN)
if(LOWDOWN)
  set(document ${PROJECT_SOURCE_DIR}/docs/whittle.1.md)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${document})
  file(READ ${document} text)
  # The title is the page's; what is linked to is not there.
  string(REGEX REPLACE "^# [^\n]*\n" "" text "${text}")
  string(REGEX REPLACE "\n#(#+ )" "\n\\1" text "${text}")
  string(REGEX REPLACE "[ \n]\\(\\[[^]]*\\]\\([^)]*\\)\\)" "" text "${text}")
  string(REGEX REPLACE "\\[([^]\n]*)\\]\\([^)]*\\)" "\\1" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/whittle.1.md "${text}")
  execute_process(COMMAND ${LOWDOWN} -s -tman -M title=WHITTLE -M section=1 -M date=
                          -M source=whittle\ ${PROJECT_VERSION} ${PROJECT_BINARY_DIR}/whittle.1.md
                  OUTPUT_FILE ${PROJECT_BINARY_DIR}/whittle.1 COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_BINARY_DIR}/whittle.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

# The modules are archives that only whittle::whittle uses; they go to a folder of their own.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/whittle)
get_property(modules GLOBAL PROPERTY WHITTLE_MODULES)
set_target_properties(whittle_whittle PROPERTIES EXPORT_NAME whittle)
install(TARGETS ${modules} EXPORT whittle ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/whittle
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/whittle TYPE INCLUDE)
install(EXPORT whittle FILE whittle-targets.cmake NAMESPACE whittle:: DESTINATION ${package_dir})
install(FILES cmake/whittle-config.cmake DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/whittle-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/whittle-config-version.cmake DESTINATION ${package_dir})

# The archives in the order in which they need each other.
set(archives "")
foreach(module IN LISTS modules)
  get_target_property(type ${module} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    string(PREPEND archives " -l${module}")
  endif()
endforeach()
file(RELATIVE_PATH up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/whittle.pc.in ${PROJECT_BINARY_DIR}/whittle.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/whittle.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
