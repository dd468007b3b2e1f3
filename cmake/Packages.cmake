# All third-party packages, from Debian 12; the Makefile installs them.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(Boost 1.74 REQUIRED)  # Boost.Math, headers only
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgcodecs imgproc)
find_package(CLI11 2.1 REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel FiltersCore IOXML
  IOGeometry IOImage)  # for tests alone: they read glTF and PNG
find_package(ZLIB REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(OSMESA REQUIRED IMPORTED_TARGET osmesa)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-pdf)
pkg_check_modules(FLANN REQUIRED IMPORTED_TARGET flann)
pkg_check_modules(OPENMESH REQUIRED openmesh)
set(OpenMesh_VERSION ${OPENMESH_VERSION})  # its CMake config does not say; run records do
# The viewer's pages carry it: they need no network.
find_file(THREE_SCRIPT three.min.js PATHS /usr/share/javascript/three REQUIRED)

# Third-party headers are not ours to warn about.
foreach(target nlohmann_json::nlohmann_json fmt::fmt Eigen3::Eigen PkgConfig::OSMESA PkgConfig::CAIRO PkgConfig::FLANN)
  get_target_property(includes ${target} INTERFACE_INCLUDE_DIRECTORIES)
  if(includes)
    set_target_properties(${target} PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${includes}")
  endif()
endforeach()
