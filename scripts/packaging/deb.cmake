# The Debian packages: `scripts/generate/package`, or `cpack -G DEB` in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME twinarm)
set(CPACK_PACKAGE_CONTACT "The twinarm authors <twinarm@packages.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS  # whatever the umask
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development documentation)
if(TARGET twinarm_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
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
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "spacenavd, libtwinarm-dev, python3-twinarm, twinarm-doc")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtwinarm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "multibody dynamics, contacts and couplings (development files)
Headers and static libraries of twinarm for C++20: the articulated-body solver,
collision shapes and contacts, robots from URDF files, and spring-dampers
between a kinematic and a dynamic robot. For find_package(twinarm) of CMake.")
# zlib: the CMake files of libassimp-dev name its library, the package does not depend on it.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libfcl-dev, libassimp-dev, zlib1g-dev, libqhull-dev, libtinyxml2-dev, libtomlplusplus-dev, libfmt-dev")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-twinarm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "multibody dynamics with every pass inspectable (Python 3)
The Python module twinarm: dynamics of robots from URDF files on numpy arrays,
simulation of scenes step by step, recordings, and the theory of couplings
between a kinematic and a dynamic robot.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# The program has the robots and scenes. A module is for one version of Python.
string(REGEX MATCH "python3\\.([0-9]+)" version "${TWINARM_PYTHON_FOLDER}")
set(minor ${CMAKE_MATCH_1})
math(EXPR next "0${minor} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "twinarm (= ${PROJECT_VERSION}), python3-numpy, \
python3 (>= 3.${minor}), python3 (<< 3.${next})")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME twinarm-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_DESCRIPTION "multibody laboratory twinarm (documentation)
The pages of twinarm for a browser, without network: lessons, how-to pages,
reference of commands, files and C++ headers.
They begin at /usr/share/doc/twinarm-doc/html/index.html.")
include(CPack)
