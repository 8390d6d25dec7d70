# shellcheck shell=bash disable=SC2034
# Every Debian package whittle needs, and why: the only such list. To be sourced.
# What is found by CMake is found in cmake/Dependencies.cmake.

build_packages=(
  g++                 # a C++20 compiler
  cmake               # configures
  ninja-build         # builds
  libhwy-dev          # vector lanes, chosen at run time
  libcli11-dev        # the command line
  libfmt-dev          # text
  nlohmann-json3-dev  # machine-readable output
  libpng-dev          # pictures
  zlib1g-dev          # files in archives; libpng needs it too
  libgif-dev          # animated pictures
  libopenexr-dev      # facts as pictures
  libqhull-dev        # convex hulls
  pkgconf             # finds what ships no CMake package
  libpolyclipping-dev # Booleans and offsets of flat shapes, the ones that OpenSCAD uses
  libfreetype-dev     # text: outlines of glyphs,
  libharfbuzz-dev     # where they stand,
  libfontconfig-dev   # and which fonts there are
  fonts-liberation    # OpenSCAD's default font
  libvulkan-dev       # the Vulkan backend: headers,
  libvulkan-volk-dev  # the way to its functions when the program runs,
  libvulkan1          # and what that finds there
  glslc               # compiles shaders
  libglfw3-dev        # the window: what opens it,
  libx11-dev          # puts pixels into it,
  libxext-dev         # and shares memory with the screen;
  libimgui-dev        # what is written over the picture,
  libstb-dev          # and its letters
)

test_packages=(
  mesa-vulkan-drivers      # a Vulkan device that needs no GPU
  vulkan-validationlayers  # what watches over its use
  libgtest-dev        # unit tests
  librapidcheck-dev   # property tests
  libbenchmark-dev    # kernel benchmarks
  python3             # the benchmarks' page says what their results say
  povray              # an independent renderer to agree with
  openscad            # flattens .scad files; a picture to agree with
  xvfb                # a display for it, and for the window
  xdotool             # the hand before the window
  make                # reads the dependencies that -d writes
  ffmpeg              # makes films, and says what is in them
  lowdown             # makes the manual page
  nodejs              # runs Manifold, an independent judge of meshes,
  curl                # which scripts/fetch_manifold brings
  ca-certificates     # from a place that can be trusted
)

report_packages=(
  mesa-vulkan-drivers  # a Vulkan device that needs no GPU
  povray               # what the paper compares with
  python3-pil          # pictures of pictures
  gnuplot-nox          # charts
  fonts-dejavu-core    # letters in them
)

lint_packages=(
  clang-format        # scripts/format.sh
  clang-tidy          # scripts/tidy.sh
)

sanitizer_packages=(
  clang               # presets asan and tsan: twice as fast as g++ with sanitizers,
  libclang-rt-dev     # its sanitizers, and libFuzzer
)
