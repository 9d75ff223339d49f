# What `cmake --install` puts below the prefix, whichever that is: the program finds its libraries and
# assets from its own place.  CPack makes a Debian package of it (debian.cmake).
#
# Other targets that are installed have their rules where they are made.

set(data ${CMAKE_INSTALL_DATADIR}/domefall)
install(TARGETS domefall RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# ---- The manual, made of --help, and bash's completion ----------------------------------------------

# The day of this version, which manual and changelog bear, in seconds since 1970.
set(released_seconds 1795305600)
# string(TIMESTAMP) tells the time that this variable holds, where it is set.
set(own_epoch "$ENV{SOURCE_DATE_EPOCH}")
set(ENV{SOURCE_DATE_EPOCH} ${released_seconds})
string(TIMESTAMP released_words "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(ENV{SOURCE_DATE_EPOCH} ${own_epoch})
find_program(HELP2MAN help2man)
if(HELP2MAN)
  set(here ${PROJECT_SOURCE_DIR}/pipeline/program/install)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/man1
    COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${released_seconds}
      sh ${here}/make_manual.sh $<TARGET_FILE:domefall> ${PROJECT_BINARY_DIR}/man1
    DEPENDS domefall ${here}/make_manual.sh ${here}/sections.h2m
    COMMENT "Writing the manual pages")
  add_custom_target(domefall_manual ALL DEPENDS ${PROJECT_BINARY_DIR}/man1)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} OPTIONAL)
endif()
install(FILES pipeline/program/install/domefall.bash RENAME domefall
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# ---- Shows and what they need --------------------------------------------------------------------

set(assets_source ${PROJECT_SOURCE_DIR}/shows/assets)
install(FILES ${maps}
  ${assets_source}/dome.ocio ${assets_source}/figures.csv ${assets_source}/sky_places.csv ${assets_source}/star_corrections.csv
  ${assets_source}/stars_to_8.csv ${assets_source}/stars_to_9.stars
  ${assets_source}/milky_way.exr ${assets_source}/milky_way_deep.exr
  ${assets_source}/far_sky.exr ${assets_source}/far_stars.stars
  DESTINATION ${data}/assets)
install(PROGRAMS ${assets_source}/fetch_stars DESTINATION ${data}/assets)
install(DIRECTORY shows/ DESTINATION ${data}/shows FILES_MATCHING
  PATTERN "*.yaml" PATTERN assets EXCLUDE)
# Shows name assets/far_sky.exr and ../assets/stars_to_8.csv, as in the source tree.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/installed)
file(CREATE_LINK ../assets ${PROJECT_BINARY_DIR}/installed/assets SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/installed/assets DESTINATION ${data}/shows)

# ---- What other queue managers read --------------------------------------------------------------

install(DIRECTORY farm/flamenco DESTINATION ${data}/farm)

# ---- Documents and licences ----------------------------------------------------------------------

install(FILES README.md LICENSE THIRD_PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "*.sh" EXCLUDE)
install(FILES ${assets_source}/PROVENANCE.md ${assets_source}/LICENSE.d3-celestial
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/shows/assets)

include(pipeline/program/install/debian.cmake)
