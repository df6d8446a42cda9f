# The Python package: the module quasilux._core beside the files of python/quasilux. In the build folder it is python/quasilux, for tests; in a
# wheel, which scikit-build-core makes of what is installed, the program goes along, to where commands are found.
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 2.10 REQUIRED)

file(GLOB sources CONFIGURE_DEPENDS host/python/*.cpp)
pybind11_add_module(quasilux_python MODULE NO_EXTRAS ${sources})
set_target_properties(quasilux_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/quasilux)
target_link_libraries(quasilux_python PRIVATE quasilux_cli)
target_compile_options(quasilux_python PRIVATE $<$<CONFIG:Release>:-O1>) # as layers that hardly compute
# Names of static libraries are nobody else's business in a process that loads other modules too.
target_link_options(quasilux_python PRIVATE -Wl,--exclude-libs,ALL)

file(GLOB package CONFIGURE_DEPENDS python/quasilux/*.py python/quasilux/*.pyi python/quasilux/py.typed)
foreach(file IN LISTS package)
    get_filename_component(name ${file} NAME)
    configure_file(${file} ${CMAKE_BINARY_DIR}/python/quasilux/${name} COPYONLY)
endforeach()

if(SKBUILD)
    install(TARGETS quasilux_python LIBRARY DESTINATION quasilux)
    install(TARGETS quasilux RUNTIME DESTINATION ${SKBUILD_SCRIPTS_DIR})
endif()
