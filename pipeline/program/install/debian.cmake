# The Debian package: `cpack -G DEB` in the build tree makes domefall_VERSION_ARCHITECTURE.deb.  The same
# build gives the same bytes each time.

set(DOMEFALL_MAINTAINER "The Domefall authors <domefall@example.org>" CACHE STRING
    "Who answers for the Debian package that is made here: name and address")

# ---- What a Debian package says of itself --------------------------------------------------------

# Sets OUT to the terms of a licence's file, without the title and the holders above them.  Each line is
# indented by a space, and an empty one is a dot.
function(domefall_licence_text out file)
  file(READ ${file} text)
  string(REGEX REPLACE "^(MIT License\n|Copyright[^\n]*\n|All rights reserved\\.\n|\n)+" "" text "${text}")
  string(STRIP "${text}" text)
  string(REGEX REPLACE "\n\n+" "\n.\n" text "${text}")
  string(REPLACE "\n" "\n " text " ${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()
domefall_licence_text(MIT ${PROJECT_SOURCE_DIR}/LICENSE)
domefall_licence_text(BSD3 ${assets_source}/LICENSE.d3-celestial)
file(STRINGS ${PROJECT_SOURCE_DIR}/LICENSE HOLDER REGEX "^Copyright")
string(REGEX REPLACE "^Copyright \\(c\\) " "" HOLDER "${HOLDER}")
configure_file(pipeline/program/install/copyright.in installed/copyright @ONLY)

# Lower than what Debian itself would give, so that its own package would take the place of this one.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0.1)
cmake_host_system_information(RESULT codename QUERY DISTRIB_VERSION_CODENAME)  # such as bookworm
file(CONFIGURE OUTPUT installed/changelog CONTENT
"domefall (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) @codename@; urgency=medium

  * Version @PROJECT_VERSION@.

 -- @DOMEFALL_MAINTAINER@  @released_words@
" @ONLY)

# ---- CPack ---------------------------------------------------------------------------------------

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME domefall)
set(CPACK_PACKAGE_VENDOR "The Domefall authors")
set(CPACK_PACKAGE_CONTACT "${DOMEFALL_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_VERBATIM_VARIABLES YES)
set(CPACK_THREADS 0)  # all processors
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/pipeline/program/install/debian_tree.cmake)
set(CPACK_DOMEFALL_RELEASED ${released_seconds})
set(CPACK_DOMEFALL_STRIP ${CMAKE_STRIP})
set(CPACK_DOMEFALL_FILES ${PROJECT_BINARY_DIR}/installed)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Titles are written in the letters of fonts-dejavu-core; the launchers are Python.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, python3:any")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, mkvtoolnix, xdg-utils")
if(TARGET domefall_python)
  # The module is for one version of Python.
  get_target_property(minor domefall_python INTERPRETER_MINOR)
  math(EXPR next "${minor} + 1")
  string(REPLACE "python3:any" "python3 (>= 3.${minor}~), python3 (<< 3.${next}~)"
    CPACK_DEBIAN_PACKAGE_DEPENDS "${CPACK_DEBIAN_PACKAGE_DEPENDS}")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, slurm-client, npm")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"A YAML timeline becomes numbered Domemaster frames, as scene-linear EXR and
graded for the dome, on one machine or on a farm.
.
Light paths around and inside a Schwarzschild black hole are exact, with
aberration and redshift for any observer. The sky is the Milky Way with 131,085
real stars, of each of which every lensed image is drawn. A live preview in the
browser follows the show's file as it is edited. Three productions, the figures
of the paper 'Seeing relativity I' and the manual are included.")
include(CPack)
