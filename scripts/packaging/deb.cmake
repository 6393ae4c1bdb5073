# The two Debian packages: `scripts/generate/package`, or `cpack -G DEB` in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME twinarm)
set(CPACK_PACKAGE_CONTACT "The twinarm authors <twinarm@packages.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS  # whatever the umask
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME twinarm)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "glass-box multibody laboratory
A laboratory for mechanisms that shows why they move as they do: dynamics of
robots from URDF files and of scenes with contacts, closed loops and
spring-dampers, every force and every pass of the algorithm with its numbers,
recordings, pictures, films, a laboratory in the browser, and the study of
couplings between a kinematic and a dynamic virtual robot.")
# Linked libraries are found by themselves; these are programs, and what is opened at run time.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
  "gnuplot-nox | gnuplot, libosmesa6, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ffmpeg, xdg-utils")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "spacenavd, libtwinarm-dev")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtwinarm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "multibody dynamics, contacts and couplings (development files)
Headers and static libraries of twinarm for C++20: the articulated-body solver,
collision shapes and contacts, robots from URDF files, and spring-dampers
between a kinematic and a dynamic robot. For find_package(twinarm) of CMake.")
# zlib: the CMake files of libassimp-dev name its library, the package does not depend on it.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libfcl-dev, libassimp-dev, zlib1g-dev, libqhull-dev, libtinyxml2-dev, libtomlplusplus-dev, libfmt-dev")
include(CPack)
