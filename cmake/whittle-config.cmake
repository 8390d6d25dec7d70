# What find_package(whittle) reads. The archives need these when a program is linked.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(fmt)
find_dependency(PNG)
find_dependency(ZLIB)
find_dependency(PkgConfig)
pkg_check_modules(polyclipping REQUIRED IMPORTED_TARGET polyclipping)
include(${CMAKE_CURRENT_LIST_DIR}/whittle-targets.cmake)
