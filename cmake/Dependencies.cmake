# The libraries that quasilux is made of: for its build, and, installed beside quasiluxConfig.cmake, for programs that use its own.
find_package(embree 3 REQUIRED)
# By pkg-config: OpenImageIO's CMake package asks for Imath's, which on Debian names a Python library that is not installed.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)
find_package(glm REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(pugixml REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(OpenCL REQUIRED)
find_package(Threads REQUIRED)
if(QUASILUX_MPI)
    set(MPI_CXX_SKIP_MPICXX ON) # the functions of C alone
    find_package(MPI REQUIRED COMPONENTS CXX)
endif()
