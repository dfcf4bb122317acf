# Installs the library, its headers, the command, its man page, records to try, the licence and the CMake package lacuna::lacuna.
include(CMakePackageConfigHelpers)

install(TARGETS lacuna EXPORT lacuna-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS lacuna-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET lacuna-mpi)
  # By itself (cmake --install BUILD --component mpi): the package does not need an MPI.
  install(TARGETS lacuna-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi
    EXCLUDE_FROM_ALL)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/lacuna DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lacuna)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/schemas
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lacuna)
install(FILES ${PROJECT_SOURCE_DIR}/docs/man/lacuna.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${PROJECT_BINARY_DIR}/lacuna.bash RENAME lacuna
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${PROJECT_BINARY_DIR}/_lacuna
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)

set(lacuna_private_libraries "-lz")
if(Ceres_FOUND)
  string(APPEND lacuna_private_libraries " -lceres -lglog")
endif()
if(NLopt_FOUND)
  string(APPEND lacuna_private_libraries " -lnlopt")
endif()
if(SUNDIALS_FOUND)
  string(APPEND lacuna_private_libraries " -lsundials_cvode -lsundials_nvecserial")
endif()
foreach(library ${CHOLMOD_LIBRARY} ${MATIO_LIBRARY} ${HDF5_LIBRARY} ${EXPAT_LIBRARY})
  string(APPEND lacuna_private_libraries " ${library}")
endforeach()
file(RELATIVE_PATH lacuna_prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${PROJECT_SOURCE_DIR}/cmake/lacuna.pc.in ${PROJECT_BINARY_DIR}/lacuna.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lacuna.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lacuna)
install(EXPORT lacuna-targets NAMESPACE lacuna:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lacuna-config.cmake.in
  ${PROJECT_BINARY_DIR}/lacuna-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lacuna-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lacuna-config.cmake
  ${PROJECT_BINARY_DIR}/lacuna-config-version.cmake DESTINATION ${package_dir})
