# What `cmake --install` copies, and `cpack -G DEB` packs: the program with all that it needs
# (component program: package twinarm), and the libraries (development: package libtwinarm-dev).
# Nothing in it names the folder that it was built or installed in: it can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(PACKAGING ${CMAKE_CURRENT_LIST_DIR})
set(MADE ${CMAKE_BINARY_DIR}/packaging)

# The libraries. Includes are written from the root of the project, and likewise by users.
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/twinarm)
# Every folder is a library; twinarm::solver, twinarm::collision and twinarm::coupling are all of each.
get_property(layers GLOBAL PROPERTY TWINARM_LAYERS)
set(libraries twinarm_solver twinarm_collision twinarm_coupling)
foreach(layer IN LISTS layers)
  if(layer MATCHES "^((solver|collision|coupling)/[^:]*):")
    string(REPLACE / _ library twinarm_${CMAKE_MATCH_1})
    list(APPEND libraries ${library})
  endif()
endforeach()
foreach(library IN LISTS libraries)
  string(REPLACE twinarm_ "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
add_custom_target(twinarm_development)  # all that libtwinarm-dev holds
add_dependencies(twinarm_development ${libraries})
target_include_directories(twinarm_solver_spatial
  INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/twinarm>)
target_compile_features(twinarm_solver_spatial INTERFACE $<INSTALL_INTERFACE:cxx_std_20>)
install(TARGETS ${libraries} EXPORT twinarm
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT twinarm NAMESPACE twinarm:: FILE twinarm-targets.cmake
  DESTINATION ${cmake_folder} COMPONENT development)
install(DIRECTORY solver collision coupling
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/twinarm COMPONENT development
  FILES_MATCHING PATTERN "*.h")
configure_package_config_file(${PACKAGING}/twinarm-config.cmake.in ${MADE}/twinarm-config.cmake
  INSTALL_DESTINATION ${cmake_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${MADE}/twinarm-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${MADE}/twinarm-config.cmake ${MADE}/twinarm-config-version.cmake
  DESTINATION ${cmake_folder} COMPONENT development)

# The program, and what it writes about itself.
find_program(GZIP gzip REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_custom_command(OUTPUT ${MADE}/twinarm.1.gz ${MADE}/twinarm ${MADE}/_twinarm ${MADE}/twinarm.fish
  COMMAND twinarm help --man > ${MADE}/twinarm.1
  COMMAND ${GZIP} -9nf ${MADE}/twinarm.1
  COMMAND twinarm help --completion bash > ${MADE}/twinarm
  COMMAND twinarm help --completion zsh > ${MADE}/_twinarm
  COMMAND twinarm help --completion fish > ${MADE}/twinarm.fish
  DEPENDS twinarm)
set(changelog ${CMAKE_SOURCE_DIR}/docs/develop/changelog.md)
add_custom_command(OUTPUT ${MADE}/changelog.gz
  COMMAND Python3::Interpreter ${PACKAGING}/debian_changelog.py ${changelog} ${MADE}/changelog
  COMMAND ${GZIP} -9nf ${MADE}/changelog
  DEPENDS ${changelog} ${PACKAGING}/debian_changelog.py)
add_custom_target(twinarm_packaging ALL
  DEPENDS ${MADE}/twinarm.1.gz ${MADE}/twinarm ${MADE}/changelog.gz)
if(TARGET twinarm_assimp)
  set(modules ${CMAKE_INSTALL_LIBDIR}/twinarm/modules)  # CPack calls ldconfig for libraries a level higher
  set_target_properties(twinarm PROPERTIES INSTALL_RPATH "$ORIGIN/../${modules}")
  install(TARGETS twinarm_assimp twinarm_fcl LIBRARY DESTINATION ${modules} COMPONENT program)
endif()
install(TARGETS twinarm RUNTIME COMPONENT program)
install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/twinarm COMPONENT program
  PATTERN cad EXCLUDE PATTERN "*.py" EXCLUDE)  # what assets are made from stays with the sources
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN docs/site EXCLUDE)  # what makes the pages for a browser
install(DIRECTORY ${CMAKE_BINARY_DIR}/site/  # by scripts/generate/package
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/twinarm-doc/html COMPONENT documentation OPTIONAL)
install(FILES ${MADE}/twinarm.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${MADE}/twinarm
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${MADE}/_twinarm
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${MADE}/twinarm.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)

# Each package says whose it is, and what has changed.
foreach(pair program:twinarm development:libtwinarm-dev python:python3-twinarm documentation:twinarm-doc)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${PACKAGING}/copyright ${MADE}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

# What lintian need not say: the site has its own styles, fonts and search, to be read from any folder;
# Python searches the module's folder below /usr and /usr/local alike.
file(CONFIGURE OUTPUT ${MADE}/overrides/twinarm-doc
  CONTENT "twinarm-doc: duplicate-font-file\ntwinarm-doc: embedded-javascript-library\n")
file(CONFIGURE OUTPUT ${MADE}/overrides/python3-twinarm
  CONTENT "python3-twinarm: python-module-in-wrong-location\n")
install(FILES ${MADE}/overrides/twinarm-doc
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT documentation)
install(FILES ${MADE}/overrides/python3-twinarm
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT python)

include(${PACKAGING}/deb.cmake)
