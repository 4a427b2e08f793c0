include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

target_include_directories(axistokes INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# Headers only, the same for every architecture: share/, not lib/.
set(axistokes_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/axistokes)
set(axistokes_generated ${PROJECT_BINARY_DIR}/package)

configure_package_config_file(${PROJECT_SOURCE_DIR}/.cmake/axistokesConfig.cmake.in
                              ${axistokes_generated}/axistokesConfig.cmake
                              INSTALL_DESTINATION ${axistokes_package_dir})
# Before 1.0 a minor release may break the interface.
write_basic_package_version_file(${axistokes_generated}/axistokesConfigVersion.cmake COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)

install(TARGETS axistokes EXPORT axistokesTargets)
install(EXPORT axistokesTargets NAMESPACE axistokes:: DESTINATION ${axistokes_package_dir})
install(FILES ${axistokes_generated}/axistokesConfig.cmake ${axistokes_generated}/axistokesConfigVersion.cmake
        DESTINATION ${axistokes_package_dir})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/axistokes DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "compiled.hpp" EXCLUDE PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
