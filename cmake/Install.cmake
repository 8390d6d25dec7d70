# cmake --install: the program, and the library with its one header and a CMake package, so that
# find_package(whittle) finds whittle::whittle.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS whittle)
install(FILES docs/whittle.1.md LICENSE TYPE DOC)

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
