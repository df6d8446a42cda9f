# `cmake --install` has two components. program: quasilux with its man pages and completions, which it writes itself. development: the
# libraries with their headers, for find_package(quasilux). `cpack -G DEB` makes a Debian package of the first.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS quasilux RUNTIME COMPONENT program)
install(CODE "execute_process(COMMAND \"$<TARGET_FILE:quasilux>\" manual \"${CMAKE_CURRENT_BINARY_DIR}/share\" COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT program)
install(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program)
install(FILES README.md LICENSE CHANGELOG.md TYPE DOC COMPONENT program)

# Each layer is a target quasilux::<folder of host/>.
get_property(layers GLOBAL PROPERTY QUASILUX_LAYERS)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/quasilux)
set(layer_targets quasilux_flags)
foreach(layer IN LISTS layers)
    set_target_properties(quasilux_${layer} PROPERTIES EXPORT_NAME ${layer})
    list(APPEND layer_targets quasilux_${layer})
endforeach()
set_target_properties(quasilux_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS ${layer_targets} EXPORT quasiluxTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT quasiluxTargets NAMESPACE quasilux:: DESTINATION ${package_folder} COMPONENT development)
foreach(folder IN ITEMS host kernels)
    install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/quasilux COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN "*.clh")
endforeach()
configure_package_config_file(cmake/quasiluxConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/quasiluxConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/quasiluxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/quasiluxConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/quasiluxConfigVersion.cmake cmake/Dependencies.cmake
    DESTINATION ${package_folder} COMPONENT development)

set(CPACK_PACKAGE_NAME quasilux)
set(CPACK_PACKAGE_CONTACT "The founders of quasilux <quasilux@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "photon-mapping renderer with quasi-specular elements")
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME quasilux)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Libraries as the program was linked; the device's runtime is loaded when it runs, and texts in pictures need a font.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd, fonts-dejavu-core")
include(CPack)
