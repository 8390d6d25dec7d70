# Every outside library, its Debian package, and why it is here.

# A project that has whittle as a part of itself must see them, too.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
find_package(Threads REQUIRED)
# libhwy-dev: vector lanes. Headers alone: src/base/instruction_set.h says why. Only what checks them
# is in its library.
find_package(hwy REQUIRED)
if(WHITTLE_SANITIZE)
  link_libraries(hwy::hwy)
else()
  add_compile_definitions(HWY_IS_DEBUG_BUILD=0)
endif()
find_package(fmt REQUIRED)             # libfmt-dev: text
find_package(PNG REQUIRED)             # libpng-dev: pictures
find_package(ZLIB REQUIRED)            # zlib1g-dev: files in archives; libpng needs it too
find_package(GIF REQUIRED)             # libgif-dev: animated pictures
find_package(OpenEXR REQUIRED)         # libopenexr-dev: facts as pictures; opened when the first one is met
# libqhull-dev: convex hulls. Its own CMake package wants Qhull's programs too. Linked whole, so that it
# costs nothing when the program starts.
find_path(QHULL_INCLUDE libqhull_r/libqhull_r.h REQUIRED)
find_library(QHULL_ARCHIVE libqhullstatic_r.a REQUIRED)
# The archive cannot be a part of a shared library, so those who use whittle's get the shared one.
find_library(QHULL_SHARED qhull_r REQUIRED)
set(QHULL_LIBRARY ${QHULL_SHARED})
if(PROJECT_IS_TOP_LEVEL)
  set(QHULL_LIBRARY $<BUILD_INTERFACE:${QHULL_ARCHIVE}> $<INSTALL_INTERFACE:${QHULL_SHARED}>)
endif()
find_package(PkgConfig REQUIRED)       # pkgconf: finds what ships no CMake package:
# libpolyclipping-dev: Booleans and offsets of flat shapes, the ones that OpenSCAD uses
pkg_check_modules(polyclipping REQUIRED IMPORTED_TARGET GLOBAL polyclipping)
# libfreetype-dev, libharfbuzz-dev, libfontconfig-dev: text; opened when the first one is met
pkg_check_modules(fonts REQUIRED freetype2 harfbuzz fontconfig)
if(WHITTLE_PROGRAM)
  find_package(CLI11 REQUIRED)         # libcli11-dev: the command line
  find_package(nlohmann_json REQUIRED) # nlohmann-json3-dev: machine-readable output
endif()
if(WHITTLE_PROGRAM AND WHITTLE_VIEWER)
  # libglfw3-dev, libx11-dev, libxext-dev: windows. Headers alone: they are opened when the first window is.
  find_path(GLFW_INCLUDE GLFW/glfw3.h REQUIRED)
  find_package(X11 REQUIRED)
  # libimgui-dev, libstb-dev: what is written over a picture. Linked whole, so that it costs nothing when
  # the program starts; of it only what draws nothing by itself.
  find_path(IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED)
  find_library(IMGUI_ARCHIVE libimgui.a REQUIRED)
  find_library(STB_ARCHIVE libstb.a REQUIRED)
endif()
if(WHITTLE_VULKAN)
  # libvulkan-dev: headers; glslc: compiles the shaders; libvulkan-volk-dev: finds the loader when the
  # program runs.
  find_package(Vulkan REQUIRED COMPONENTS glslc)
  find_path(VOLK_INCLUDE volk.h REQUIRED)
endif()
if(WHITTLE_TESTS)
  find_package(GTest REQUIRED)         # libgtest-dev
  include(GoogleTest)
  # librapidcheck-dev: property tests; it ships no CMake package.
  find_path(RAPIDCHECK_INCLUDE rapidcheck.h REQUIRED)
  find_library(RAPIDCHECK_LIBRARY rapidcheck REQUIRED)
  add_library(rapidcheck INTERFACE)
  target_include_directories(rapidcheck SYSTEM INTERFACE ${RAPIDCHECK_INCLUDE})
  target_link_libraries(rapidcheck INTERFACE ${RAPIDCHECK_LIBRARY})
endif()
if(WHITTLE_BENCHMARKS)
  find_package(benchmark REQUIRED)     # libbenchmark-dev
endif()
